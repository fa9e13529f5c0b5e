// Solves the screened Poisson equation of a surface in stages: load, hierarchy, solve.
#ifndef GridFEM_PoissonEquation_h
#define GridFEM_PoissonEquation_h

#include "Equations/Poisson.h"
#include "Solvers/Surface.h"

#include <functional>
#include <memory>

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
  /// Replaces the surface's space by a copy with its own numbers, and gives the key of these
  /// numbers.
  /// Not on a shared surface.
  const SurfaceSpace* space = nullptr;
  StageKey numbers;
  /// Starts from the last solution if it has a row for each function. Columns that the last
  /// solution lacks start at zero.
  bool startsFromLast = false;
};

/// Repeats a stage only if something it depends on has changed. After a change of the weight or of
/// the load, the iteration starts from the last solution, but not on a shared surface. The equation
/// builds the hierarchy with the weight it solves with. Collective.
class PoissonEquation
{
public:
  using Integrate = std::function<PoissonLoad(const SurfaceSpace&, const Job&)>;

  /// Integrates the load if `fields` or the space has changed, and solves. The load depends on
  /// nothing else. The surface has to be prepared. Throws InvalidInput and Aborted.
  void Update(const Surface& surface, StageKey fields, const Integrate& integrate,
    const PoissonRequest& request, EquationOptions options, const Progress& progress);

  const PoissonSolution& Solution() const { return solution_; }
  const SolveReport& Report() const { return solution_.report; }
  const SolutionAccuracy& Accuracy() const { return solution_.accuracy; }

private:
  void UpdateHierarchy(const Surface& surface, const PoissonRequest& request,
    const EquationOptions& options, const Progress& progress);
  const MultiVector* Start(
    const PoissonRequest& request, bool isSameSolver, MultiVector& resized) const;
  void Solve(const Surface& surface, const PoissonRequest& request, const EquationOptions& options,
    const Progress& progress);

  PoissonLoad load_;
  std::unique_ptr<Multigrid> multigrid_;
  StageKey shape_; // everything but the weight that the hierarchy depends on
  PoissonSolution solution_;
  StageKey solvedWith_; // space and solver that the solution comes from
};

} // namespace gridfem

#endif
