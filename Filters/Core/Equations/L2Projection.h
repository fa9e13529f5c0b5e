// Projects given fields to the nearest functions of a space.
#ifndef GridFEM_L2Projection_h
#define GridFEM_L2Projection_h

#include "Equations/Poisson.h"

#include <utility>

namespace gridfem
{

/// Solves (M + δL) u = load for any number of columns, and keeps the worst report and the worst
/// errors. Without δ, functions that vanish on a flat surface would be undetermined. Waves ten
/// cells long lose 4 %, about the error of the space in their gradients.
class L2Projection
{
public:
  static constexpr double Smoothing = 0.1; // δ, in squared units of length

  L2Projection(const SpaceLevels& space, const EquationOptions& options, const Job& job)
    : space_(space), poisson_{ options, 1.0 / Smoothing },
      multigrid_(BuildMultigrid(space, 1.0 / Smoothing, 1.0, options.multigrid, job.progress))
  {
    poisson_.estimateErrors = true;
  }

  /// @param values, gradients  integrals of a field and of its gradient; gradients may have no rows
  MultiVector Solve(const MultiVector& values, const MultiVector& gradients, const Job& job)
  {
    PoissonSolution solution =
      SolvePoisson(space_, multigrid_, values, gradients, poisson_, job.progress);
    KeepWorse(solution.accuracy, accuracy);
    KeepWorse(std::move(solution.report), report);
    return std::move(solution.coefficients);
  }

  SolveReport report = SolveReport::Solved();
  SolutionAccuracy accuracy = SolutionAccuracy::Exact();

private:
  const SpaceLevels& space_;
  PoissonOptions poisson_;
  Multigrid multigrid_;
};

} // namespace gridfem

#endif
