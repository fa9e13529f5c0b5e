#include "Equations/HeatDiffusion.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace gridfem
{
namespace
{

const double Gamma = 1.0 - std::sqrt(0.5);

/// The largest matrix that is factored: hat functions of 170,000 points, or 45,000 functions of a
/// grid. The factor takes a second or two, during which an abort waits.
constexpr Id MostFactored = 1200000;

} // namespace

HeatEquation::HeatEquation(std::shared_ptr<const SpaceLevels> space,
  const DiffusionOptions& options, HeldRows held, const Job& job)
  : space_(std::move(space)), options_(options), heldRows_(held.rows)
{
  if (!(options.timeStep > 0.0) || std::isinf(options.timeStep))
  {
    throw InvalidInput(
      "The time step is " + std::to_string(options.timeStep) + "; it must be a number above 0.");
  }
  const bool isFirstOrder = options.scheme == TimeScheme::BackwardEuler;
  stageStep_ = (isFirstOrder ? 1.0 : Gamma) * options.timeStep;
  mass_ = space_->Matrix(0, 1.0, 0.0, job.threads);
  std::array<double, 1> numberOfHeld = { static_cast<double>(heldRows_) };
  SumOverProcesses(space_->Distributed(0), numberOfHeld);
  if (numberOfHeld[0] > 0.0)
  {
    constrained_ = std::make_unique<ConstrainedHierarchy>(*space_, 1.0 / stageStep_, 1.0,
      std::move(held), ConstraintOptions().penalty, options.multigrid, job.progress);
    return;
  }
  multigrid_ = std::make_unique<Multigrid>(
    BuildMultigrid(*space_, 1.0 / stageStep_, 1.0, options.multigrid, job.progress));
  if (options.isFactored && multigrid_->Matrix().NonZeros() <= MostFactored)
  {
    auto factor = std::make_unique<const SparseCholesky>(multigrid_->Matrix());
    factor_ = factor->IsDefinite() ? std::move(factor) : nullptr;
  }
}

void HeatEquation::Require(
  const MultiVector& start, const MultiVector& sources, const MultiVector& heldValues) const
{
  if (start.rows() != static_cast<Id>(space_->Integrals().size()) ||
      (sources.rows() > 0 && (sources.rows() != start.rows() || sources.cols() != start.cols())))
  {
    throw InvalidInput("The integrals of the start or of the sources do not fit the functions.");
  }
  if (heldValues.rows() != heldRows_ || (heldRows_ > 0 && heldValues.cols() != start.cols()))
  {
    throw InvalidInput("The values that are held do not fit the points or the start.");
  }
}

PoissonSolution HeatEquation::Solve(const MultiVector& load, const MultiVector& heldValues,
  ConstrainedSolution& met, const Job& job) const
{
  if (constrained_)
  {
    PoissonSolution solution;
    ConstraintOptions constraints;
    constraints.estimateOn = space_.get();
    met = SolveConstrained(*space_, 1.0 / stageStep_, *constrained_, load / stageStep_, heldValues,
      constraints, options_.solve, job.progress);
    solution.coefficients = std::move(met.coefficients);
    solution.accuracy = met.accuracy;
    solution.report = std::move(met.report);
    return solution;
  }
  PoissonOptions options{ options_, 1.0 / stageStep_ };
  options.estimateErrors = true;
  return SolvePoisson(*space_, *multigrid_, load, {}, options, job.progress);
}

PoissonSolution HeatEquation::SolveByFactor(const MultiVector& load, const Job& job) const
{
  constexpr double LargestResidual = 1e-10; // relative; rounding leaves some 1e-14
  const MultiVector right = load / stageStep_;
  PoissonSolution solution;
  factor_->Solve(right, solution.coefficients, job.threads);
  MultiVector residual;
  Residual(multigrid_->Matrix(), solution.coefficients, right, residual, job.threads);
  const Eigen::RowVectorXd allowed = LargestResidual * right.colwise().norm();
  if (!(residual.colwise().norm().array() <= allowed.array()).all())
  {
    ConstrainedSolution none;
    return this->Solve(load, {}, none, job);
  }
  solution.report = SolveReport::Solved();
  solution.accuracy = SolutionAccuracy::Exact();
  job.Check(1.0);
  return solution;
}

MultiVector HeatEquation::IntegralsOf(const MultiVector& coefficients, const Job& job) const
{
  MultiVector integrals;
  Multiply(mass_, coefficients, integrals, job.threads);
  if (const DistributedRows* distributed = space_->Distributed(0))
  {
    distributed->Sum(integrals);
  }
  return integrals;
}

HeatDiffusion::HeatDiffusion(std::shared_ptr<const HeatEquation> equation, MultiVector start,
  MultiVector sources, MultiVector heldValues, HeatSolves solves)
  : equation_(std::move(equation)), solves_(solves), load_(std::move(start)),
    sources_(std::move(sources)), heldValues_(std::move(heldValues))
{
  equation_->Require(load_, sources_, heldValues_);
}

SolveReport HeatDiffusion::Advance(const Job& job)
{
  const MultiVector added = equation_->StageStep() * sources_;
  const bool isFirstOrder = equation_->Scheme() == TimeScheme::BackwardEuler;
  const bool isStart = !isFirstOrder && !hasStarted_;
  const int solves = isFirstOrder ? 1 : isStart ? 3 : 2;
  PoissonSolution solution;
  MultiVector before; // coefficients of the solve before the last
  MultiVector now = load_;
  auto accuracy = SolutionAccuracy::Exact();
  ConstrainedSolution met;
  std::optional<SolveReport> failed; // of the first solve that has not converged
  for (int k = 0; k < solves; ++k)
  {
    if (k > 0 && !isStart)
    {
      // M U - load is γδ times the slope of the first stage.
      now = load_ + (1.0 - Gamma) / Gamma * (now - load_);
    }
    before = std::move(solution.coefficients);
    if (added.rows() > 0)
    {
      now += added;
    }
    const Job part = job.Part(double(k) / solves, double(k + 1) / solves);
    solution = solves_ == HeatSolves::ByFactor ? equation_->SolveByFactor(now, part)
                                               : equation_->Solve(now, heldValues_, met, part);
    if (!solution.report.converged && !failed)
    {
      failed = solution.report;
    }
    KeepWorse(solution.accuracy, accuracy);
    now = equation_->IntegralsOf(solution.coefficients, job);
  }
  if (isStart)
  {
    // The last two solves are at 2γδ and 3γδ. The line through them is followed to δ.
    solution.coefficients += (1.0 / Gamma - 3.0) * (solution.coefficients - before);
    now = equation_->IntegralsOf(solution.coefficients, job);
  }
  load_ = std::move(now);
  coefficients_ = std::move(solution.coefficients);
  accuracy_ = accuracy;
  met_ = std::move(met);
  hasStarted_ = true;
  return failed ? std::move(*failed) : std::move(solution.report);
}

} // namespace gridfem
