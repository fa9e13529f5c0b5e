// Which finite element space is wanted on a mesh.
#ifndef GridFEM_SpaceChoice_h
#define GridFEM_SpaceChoice_h

#include "Spaces/FunctionKind.h"
#include "Spaces/GridSpace.h"

#include <memory>

namespace gridfem
{

/// Which space is wanted on a basis.
struct SpaceChoice : OperatorOptions
{
  FunctionKind kind = FunctionKind::Grid;
};

/// Clips the mesh and builds all that the space takes. Throws InvalidInput and Aborted.
std::unique_ptr<FiniteElementSpace> BuildSpace(const TriangleMesh& mesh,
  const SpaceOptions& functions, const SpaceChoice& choice, const Progress& progress);

} // namespace gridfem

#endif
