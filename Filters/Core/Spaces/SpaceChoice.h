// Which finite element space is wanted on a mesh.
#ifndef GridFEM_SpaceChoice_h
#define GridFEM_SpaceChoice_h

#include "Spaces/FunctionKind.h"
#include "Spaces/GridSpace.h"

#include <memory>

namespace gridfem
{

/// Which space is wanted on a basis.
struct SpaceChoice
{
  FunctionKind kind = FunctionKind::Grid;
  int quadratureDegree = 2;
  Index coarsestSize = 256; // functions of the largest component on the coarsest level, at most
  double normalStabilization = DefaultNormalStabilization;
};

/// Clips the mesh and builds all that the space takes. Throws InvalidInput and Aborted.
std::unique_ptr<FiniteElementSpace> BuildSpace(const TriangleMesh& mesh,
  const SpaceOptions& functions, const SpaceChoice& choice, const Progress& progress);

} // namespace gridfem

#endif
