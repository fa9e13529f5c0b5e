// A mesh with a space and a system on it, for tests that start from both.
#ifndef GridFEM_Testing_Discretisation_h
#define GridFEM_Testing_Discretisation_h

#include "Spaces/LevelOperators.h"

namespace gridfem::testing
{

struct Discretisation
{
  GridFunctions space;
  LevelOperators system;

  double Spacing() const { return space.GetGrid().spacing; }
};

inline Discretisation Discretise(const TriangleMesh& mesh, int depth, int quadratureDegree = 2,
  bool connectivityAware = true, Index coarsestSize = 256)
{
  SpaceOptions options;
  options.depth = depth;
  options.connectivityAware = connectivityAware;
  Discretisation result;
  result.space = BuildGridFunctions(mesh, options);
  result.system = BuildSystem(result.space, TriangleRule(quadratureDegree), 0, coarsestSize);
  return result;
}

} // namespace gridfem::testing

#endif
