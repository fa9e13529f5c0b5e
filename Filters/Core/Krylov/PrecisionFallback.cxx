#include "Krylov/PrecisionFallback.h"

namespace gridfem
{
namespace
{

/// One history of both: the second begins where the first ends.
SolveReport Join(SolveReport first, const SolveReport& second)
{
  first.history.pop_back();
  for (IterationRecord record : second.history)
  {
    record.iteration += first.iterations;
    first.history.push_back(record);
  }
  first.doubleSince = first.iterations;
  first.iterations += second.iterations;
  first.converged = second.converged;
  first.end = second.end;
  first.convergenceFactor = MeanFactor(first);
  return first;
}

} // namespace

SolveReport SolveWithFallback(IterationType iteration, const Multigrid& multigrid,
  const MultiVector& b, MultiVector& x, const SolveOptions& options, const Projection& project,
  const Progress& progress)
{
  const auto solve = iteration == IterationType::Cycles ? &SolveCycles : &SolveConjugateGradients;
  if (!multigrid.HasSingleFactors())
  {
    return solve(multigrid, b, x, options, project, progress);
  }
  SolveOptions attempt = options;
  attempt.giveUp = SolveOptions::GiveUp::WhenTooSlow;
  const SolveReport report = solve(multigrid, b, x, attempt, project, progress);
  const bool isStuck = report.end == SolveEnd::Stagnation || report.end == SolveEnd::Breakdown;
  attempt.maximumIterations -= report.iterations;
  if (!isStuck || attempt.maximumIterations < 1)
  {
    return report;
  }
  if (report.end == SolveEnd::Breakdown)
  {
    x.setZero(); // steps with a cycle that was not positive may have led anywhere
  }
  attempt.giveUp = SolveOptions::GiveUp::AtStandstill;
  const double done = double(report.iterations) / options.maximumIterations;
  const Multigrid better = multigrid.InDoublePrecision();
  return Join(report, solve(better, b, x, attempt, project, progress.Part(done, 1.0)));
}

} // namespace gridfem
