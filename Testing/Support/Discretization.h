// A mesh with a space and a system on it, for tests that start from both.
#ifndef GridFEM_Testing_Discretization_h
#define GridFEM_Testing_Discretization_h

#include "Spaces/GridSpace.h"

namespace gridfem::testing
{

/// Returns a space that owns nothing: its parts must outlive it. Without a mesh, it has no loads.
inline GridSpace ViewOf(
  const GridFunctions& space, const LevelOperators& system, const TriangleMesh* mesh = nullptr)
{
  const auto view = [](const auto* part)
  {
    return std::shared_ptr<std::remove_reference_t<decltype(*part)>>(std::shared_ptr<void>(), part);
  };
  return GridSpace(view(mesh), view(&space), view(&system));
}

/// Returns the mass or stiffness matrix of the finest level, in grid units.
inline SparseMatrix MassMatrix(const GridFunctions& space, const LevelOperators& system)
{
  return ViewOf(space, system).Matrix(0, 1.0, 0.0);
}

inline SparseMatrix StiffnessMatrix(const GridFunctions& space, const LevelOperators& system)
{
  return ViewOf(space, system).Matrix(0, 0.0, 1.0);
}

struct Discretization
{
  GridFunctions space;
  LevelOperators system;

  double Spacing() const { return space.GetGrid().spacing; }
};

inline Discretization Discretize(const TriangleMesh& mesh, int depth, int quadratureDegree = 2,
  bool connectivityAware = true, Index coarsestSize = 256)
{
  SpaceOptions options;
  options.depth = depth;
  options.connectivityAware = connectivityAware;
  Discretization result;
  result.space = BuildGridFunctions(mesh, options);
  result.system =
    BuildLevelOperators(result.space, TriangleRule(quadratureDegree), 0, coarsestSize);
  return result;
}

} // namespace gridfem::testing

#endif
