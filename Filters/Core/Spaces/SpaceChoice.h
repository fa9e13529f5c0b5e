// The choice of a finite element space on a mesh.
#ifndef GridFEM_SpaceChoice_h
#define GridFEM_SpaceChoice_h

#include "Spaces/FunctionKind.h"
#include "Spaces/GridSpace.h"

#include <memory>

namespace gridfem
{

/// The finite element space to build on given functions of a grid.
struct SpaceChoice : OperatorOptions
{
  FunctionKind kind = FunctionKind::Grid;
};

/// Clips the mesh and builds everything that the space needs. Throws InvalidInput and Aborted.
std::unique_ptr<FiniteElementSpace> BuildSpace(const TriangleMesh& mesh,
  const SpaceOptions& functions, const SpaceChoice& choice, const Progress& progress);

} // namespace gridfem

#endif
