// A mesh with its grid and its hats, ready to solve: what tests of the hybrid hierarchy share.
#ifndef GridFEM_Testing_Hybrid_h
#define GridFEM_Testing_Hybrid_h

#include "Problems/Poisson.h"
#include "Spaces/HatLoad.h"

#include <cmath>

namespace gridfem::testing
{

struct Hybrid
{
  Hybrid(const TriangleMesh& inputMesh, int depth, HatTransfer transfer = HatTransfer::Evaluation,
    int threads = 0)
    : mesh(inputMesh)
  {
    SpaceOptions spaceOptions;
    spaceOptions.depth = depth;
    spaceOptions.threads = threads;
    space = BuildGridFunctions(mesh, spaceOptions);
    system = BuildSystem(space, TriangleRule(2), threads, 64);
    hats = BuildHatHierarchy(mesh, space, true, transfer, threads);
    options.grid.threads = threads;
    solve.tolerance = 1e-8;
    solve.measure = SolveOptions::Measure::Residual;
  }

  /// λ in world units to grid units.
  double Weight(double lambda) const { return lambda * std::pow(space.GetGrid().spacing, 2); }

  Multigrid Build(double weight) const
  {
    return BuildHatMultigrid(hats, space, system, weight, 1.0, options);
  }

  ComponentFunctions Functions() const { return FunctionsOf(hats); }

  /// Solves (λM + L) u = λ f, f at points.
  PoissonSolution Solve(double lambda, const MultiVector& f) const
  {
    PoissonOptions poisson;
    poisson.screeningWeight = this->Weight(lambda);
    poisson.solve = solve;
    const MultiVector load = IntegrateValues(hats.functions, mesh, { FieldAssociation::Points, f });
    return SolvePoisson(this->Functions(), this->Build(poisson.screeningWeight), load, {}, poisson);
  }

  TriangleMesh mesh;
  GridFunctions space;
  LevelOperators system;
  HatHierarchy hats;
  HatMultigridOptions options;
  SolveOptions solve;
};

/// A smooth function with fine detail.
inline MultiVector Waves(const TriangleMesh& mesh)
{
  const Grid grid = EmbedInGrid(mesh.points, UsedPoints(mesh), 2);
  MultiVector f(static_cast<Id>(mesh.points.size()), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3 p = grid.ToGrid(mesh.points[i]) / grid.CellsPerSide();
    f(static_cast<Id>(i), 0) =
      std::sin(9.0 * p[0]) * std::cos(7.0 * p[1]) + std::sin(40.0 * p[2] + 3.0 * p[0]);
  }
  return f;
}

} // namespace gridfem::testing

#endif
