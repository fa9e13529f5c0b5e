#include "Krylov/ConjugateGradients.h"

#include "Krylov/RitzValues.h"
#include "Krylov/SolverIteration.h"

#include <cmath>
#include <tuple>
#include <utility>

namespace gridfem
{
namespace
{

/// The preconditioner B makes p'Ap / p'B⁻¹p at most about 1. If this ratio is below the inverse of
/// LongestStep, p lies in the null space of A, and the system has no solution.
constexpr double LongestStep = 1e12;

/// Steps to the minimum along p; 0 in columns that do not iterate. A column breaks down if its p
/// does not have positive energy. Its columns of p and q become zero.
Columns StepLengths(
  const LinearOperator& A, SolverIteration& iteration, MultiVector& p, MultiVector& q)
{
  const Columns pq = A.products(p, q);
  Columns step = Columns::Zero(pq.size());
  for (Id c = 0; c < pq.size(); ++c)
  {
    if (!iteration.IsActive(c))
    {
      continue;
    }
    step[c] = iteration.rz[c] / pq[c];
    if (!(pq[c] > 0.0 && step[c] < LongestStep))
    {
      step[c] = 0.0;
      p.col(c).setZero();
      q.col(c).setZero();
      iteration.Retire(c, SolveEnd::Breakdown);
    }
  }
  return step;
}

} // namespace

double MeanFactor(const SolveReport& report)
{
  const double first = report.history.front().energy;
  const double last = report.history.back().energy;
  return report.iterations > 0 && first > 0.0 ? std::pow(last / first, 1.0 / report.iterations)
                                              : 0.0;
}

void Append(const SolveReport& step, SolveReport& report)
{
  for (IterationRecord record : step.history)
  {
    record.iteration += report.iterations;
    report.history.push_back(record);
  }
  if (report.doubleSince < 0 && step.doubleSince >= 0)
  {
    report.doubleSince = report.iterations + step.doubleSince;
  }
  report.iterations += step.iterations;
  report.converged = step.converged;
  report.end = step.end;
  report.convergenceFactor = MeanFactor(report);
  report.where = step.where;
}

void KeepWorse(SolveReport report, SolveReport& kept)
{
  const auto badness = [](const SolveReport& r)
  { return std::make_tuple(r.end == SolveEnd::NotFinite, !r.converged, r.iterations); };
  if (badness(report) >= badness(kept))
  {
    kept = std::move(report);
  }
}

SolveReport SolveConjugateGradients(const LinearOperator& A, const Preconditioner& B,
  const MultiVector& b, MultiVector& x, const SolveOptions& options, const Projection& project,
  const Progress& progress)
{
  SolverIteration iteration(A, B, b, x, options, project);
  RitzValues ritz(b.cols());
  MultiVector p = iteration.z;
  MultiVector q;
  while (iteration.CanGoOn())
  {
    iteration.Begin(progress);
    A.multiply(p, q);
    const Columns step = StepLengths(A, iteration, p, q);
    AddScaled(p, step, x, A.threads);
    AddScaled(q, -step, iteration.r, A.threads);
    ritz.AddStep(step);
    if (options.measureBy)
    {
      iteration.slowest = ritz.Smallest();
    }
    const Columns before = iteration.rz;
    iteration.Measure();
    Columns factor = Columns::Zero(b.cols());
    for (Id c = 0; c < b.cols(); ++c)
    {
      factor[c] = iteration.IsActive(c) ? iteration.rz[c] / before[c] : 0.0;
    }
    ritz.AddFactor(factor);
    if (!iteration.IsActive())
    {
      iteration.Confirm();
    }
    ScaleAndAdd(iteration.z, factor, p, A.threads);
  }
  return iteration.Finish();
}

SolveReport SolveCycles(const LinearOperator& A, const Preconditioner& B, const MultiVector& b,
  MultiVector& x, const SolveOptions& options, const Projection& project, const Progress& progress)
{
  SolverIteration iteration(A, B, b, x, options, project);
  while (iteration.CanGoOn())
  {
    iteration.Begin(progress);
    AddScaled(iteration.z, Columns::Ones(b.cols()), x, A.threads);
    iteration.ComputeResidual();
    iteration.Measure();
  }
  return iteration.Finish();
}

} // namespace gridfem
