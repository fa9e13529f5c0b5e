// The screened Poisson equation of a filter's surface, with its stages: load, hierarchy, solve, and
// what is reported of them.
#ifndef GridFEM_SurfacePoisson_h
#define GridFEM_SurfacePoisson_h

#include "StageCache.h"
#include "SurfaceSolverState.h"

#include "Problems/Poisson.h"

#include <functional>
#include <memory>

class vtkTable;

namespace gridfem
{

/// Right-hand sides, as SolvePoisson takes them.
struct PoissonLoad
{
  MultiVector values;
  MultiVector gradients; // may have no columns
};

struct PoissonRequest
{
  double weight = 1.0;        // λ in parameter units
  double gradientScale = 1.0; // σ: a factor on the gradients, which are not integrated again
  /// In place of the state's space a copy of it with numbers of its own, and what they depend on;
  /// not where ranks compute together.
  const SurfaceSpace* space = nullptr;
  StageKey numbers;
  /// Start from the last solution, finished or not, whatever has changed but the functions; columns
  /// that it does not have start at zero.
  bool goesOn = false;
};

/// Every stage is repeated only when something it depends on has changed. A change of the weight or
/// of the load starts from the last solution; not where ranks compute together, which call all but
/// Report and Accuracy together. All methods throw InvalidInput and Aborted.
class SurfacePoisson
{
public:
  using Integrate = std::function<PoissonLoad(const SurfaceSpace&, const Job&)>;

  /// Integrates the load when `fields`, all that it depends on besides the space, has changed, and
  /// solves. The space has to be up to date.
  void Update(SurfaceSolverState& state, StageKey fields, const Integrate& integrate,
    const PoissonRequest& request, const Progress& progress);

  const PoissonSolution& Solution() const { return solution_; }

  /// At the points of the mesh.
  MultiVector Values(const SurfaceSolverState& state) const;

  const SolveReport& Report() const { return solution_.report; }
  const SolutionAccuracy& Accuracy() const { return solution_.accuracy; }

private:
  void UpdateHierarchy(
    SurfaceSolverState& state, const PoissonRequest& request, const Progress& progress);
  const MultiVector* Start(
    const PoissonRequest& request, bool isSameSolver, MultiVector& resized) const;
  void Solve(SurfaceSolverState& state, const PoissonRequest& request, const Progress& progress);

  PoissonLoad load_;
  std::unique_ptr<Multigrid> multigrid_;
  StageKey shape_; // what the hierarchy depends on but for the weight
  PoissonSolution solution_;
  StageKey solvedWith_; // space and solver that the solution comes from
};

} // namespace gridfem

#endif
