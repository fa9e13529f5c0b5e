// A mesh with its grid and its hats, ready to solve, for tests of the hybrid hierarchy.
#ifndef GridFEM_Testing_Hybrid_h
#define GridFEM_Testing_Hybrid_h

#include "Discretization.h"
#include "Equations/Poisson.h"
#include "Spaces/HatSpace.h"

#include <cmath>

namespace gridfem::testing
{

/// A cycle of a hybrid hierarchy. The sweeps on the hats may differ from the space's own choice.
struct HybridCycle
{
  MultigridOptions grid; // options of the levels below the hats
  std::optional<LevelSmoothing> hats;
  bool relaxGroups = true;
};

/// Builds a hierarchy for λM + L, ready to cycle, with the weight λ in grid units.
inline Multigrid BuildHybridCycle(
  const FiniteElementSpace& space, double weight, const HybridCycle& options)
{
  std::vector<MultigridLevel> levels = BuildMultigridLevels(space, weight, 1.0, options.grid);
  if (options.hats)
  {
    levels[0].smoothing = options.hats;
  }
  if (!options.relaxGroups)
  {
    levels[0].groups = {};
  }
  return Multigrid(std::move(levels), options.grid);
}

struct Hybrid
{
  Hybrid(const TriangleMesh& inputMesh, int depth, HatTransfer transfer = HatTransfer::Evaluation,
    int threads = 0)
    : mesh(inputMesh), space(Build(inputMesh, depth, transfer, threads))
  {
    options.grid.threads = threads;
    solve.tolerance = 1e-8;
    solve.measure = SolveOptions::Measure::Residual;
  }

  static HatSpace Build(const TriangleMesh& mesh, int depth, HatTransfer transfer, int threads)
  {
    GridSpaceOptions spaceOptions;
    spaceOptions.functions.depth = depth;
    spaceOptions.functions.threads = threads;
    spaceOptions.coarsestSize = 64;
    return BuildHatSpace(mesh, spaceOptions, transfer);
  }

  /// Converts λ from world units to grid units.
  double Weight(double lambda) const { return lambda * std::pow(space.UnitLength(), 2); }

  Multigrid Build(double weight) const { return BuildHybridCycle(space, weight, options); }

  /// Solves (λM + L) u = λ f, with f given at points.
  PoissonSolution Solve(double lambda, const MultiVector& f) const
  {
    PoissonOptions poisson;
    poisson.screeningWeight = this->Weight(lambda);
    poisson.solve = solve;
    const MultiVector load = space.LoadOfValues({ FieldAssociation::Points, f });
    return SolvePoisson(space, this->Build(poisson.screeningWeight), load, {}, poisson);
  }

  TriangleMesh mesh;
  HatSpace space;
  HybridCycle options;
  SolveOptions solve;
};

/// Returns a smooth function with fine detail.
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
