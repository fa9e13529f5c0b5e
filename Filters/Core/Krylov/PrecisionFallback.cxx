#include "Krylov/PrecisionFallback.h"

#include "Multigrid/Multigrid.h"

#include <memory>

namespace gridfem
{
namespace
{

/// Joins two histories. The second begins where the first ends.
SolveReport Join(SolveReport first, const SolveReport& second)
{
  const bool wasOnDevice = second.where.rfind("GPU", 0) == 0; // the operator is the same
  first.history.pop_back();
  first.doubleSince = first.iterations;
  Append(second, first);
  first.where = wasOnDevice ? "CPU: the solution needs double precision" : second.where;
  return first;
}

} // namespace

WithFallback<Preconditioner> CycleWithFallback(const Multigrid& multigrid)
{
  WithFallback<Preconditioner> B{ CycleOf(multigrid), {} };
  if (multigrid.HasSingleFactors())
  {
    B.makeDouble = [&multigrid]() -> Preconditioner
    {
      const auto better = std::make_shared<const Multigrid>(multigrid.InDoublePrecision());
      return [better](const MultiVector& r, MultiVector& z) { better->Precondition(r, z); };
    };
  }
  return B;
}

SolveReport SolveWithFallback(IterationType iteration, const LinearOperator& A,
  const WithFallback<Preconditioner>& B, const MultiVector& b, MultiVector& x,
  const SolveOptions& options, const Projection& project, const Progress& progress)
{
  const auto solve = iteration == IterationType::Cycles ? &SolveCycles : &SolveConjugateGradients;
  if (!B.makeDouble)
  {
    return solve(A, B.first, b, x, options, project, progress);
  }
  SolveOptions attempt = options;
  attempt.giveUp = SolveOptions::GiveUp::WhenTooSlow;
  SolveReport report = solve(A, B.first, b, x, attempt, project, progress);
  const bool isStuck = report.end == SolveEnd::Stagnation || report.end == SolveEnd::Breakdown;
  attempt.maximumIterations -= report.iterations;
  if (!isStuck || attempt.maximumIterations < 1)
  {
    return report;
  }
  if (report.end == SolveEnd::Breakdown)
  {
    x.setZero(); // a cycle that was not positive may have led x anywhere
  }
  attempt.giveUp = SolveOptions::GiveUp::AtStandstill;
  const double done = double(report.iterations) / options.maximumIterations;
  return Join(report, solve(A, B.makeDouble(), b, x, attempt, project, progress.Part(done, 1.0)));
}

} // namespace gridfem
