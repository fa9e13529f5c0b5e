#include "Equations/HeatDiffusion.h"

#include <array>
#include <cmath>
#include <string>

namespace gridfem
{
namespace
{

const double Gamma = 1.0 - std::sqrt(0.5);

} // namespace

HeatDiffusion::HeatDiffusion(std::shared_ptr<const SpaceLevels> space, MultiVector start,
  MultiVector sources, DiffusionOptions options, const Job& job)
  : space_(std::move(space)), options_(std::move(options)), load_(std::move(start)),
    sources_(std::move(sources))
{
  if (!(options_.timeStep > 0.0) || std::isinf(options_.timeStep))
  {
    throw InvalidInput(
      "The time step is " + std::to_string(options_.timeStep) + "; it must be a number above 0.");
  }
  if (sources_.rows() == 0)
  {
    sources_ = MultiVector::Zero(load_.rows(), load_.cols());
  }
  if (load_.rows() != static_cast<Id>(space_->Integrals().size()) ||
      sources_.rows() != load_.rows() || sources_.cols() != load_.cols())
  {
    throw InvalidInput("The integrals of the start or of the sources do not fit the functions.");
  }
  const MultiVector& held = options_.held.values;
  if (held.rows() > 0 && (held.rows() != options_.held.rows.rows || held.cols() != load_.cols()))
  {
    throw InvalidInput("The values that are held do not fit the points or the start.");
  }
  const bool isFirstOrder = options_.scheme == TimeScheme::BackwardEuler;
  stageStep_ = (isFirstOrder ? 1.0 : Gamma) * options_.timeStep;
  mass_ = space_->Matrix(0, 1.0, 0.0, job.threads);
  std::array<double, 1> numberOfHeld = { static_cast<double>(held.rows()) };
  SumOverProcesses(space_->Distributed(0), numberOfHeld);
  if (numberOfHeld[0] > 0.0)
  {
    constrained_ = std::make_unique<ConstrainedHierarchy>(*space_, 1.0 / stageStep_, 1.0,
      std::move(options_.held.rows), ConstraintOptions().penalty, options_.multigrid, job.progress);
    return;
  }
  multigrid_ = std::make_unique<Multigrid>(
    BuildMultigrid(*space_, 1.0 / stageStep_, 1.0, options_.multigrid, job.progress));
}

/// Solves (M + γδ L) U = load, with the held values if there are any.
PoissonSolution HeatDiffusion::Solve(const MultiVector& load, const Job& job)
{
  if (constrained_)
  {
    PoissonSolution solution;
    ConstraintOptions constraints;
    constraints.estimateOn = space_.get();
    met_ = SolveConstrained(*space_, 1.0 / stageStep_, *constrained_, load / stageStep_,
      options_.held.values, constraints, options_.solve, job.progress);
    solution.coefficients = std::move(met_.coefficients);
    solution.accuracy = met_.accuracy;
    solution.report = std::move(met_.report);
    return solution;
  }
  PoissonOptions options{ options_, 1.0 / stageStep_ };
  options.estimateErrors = true;
  return SolvePoisson(*space_, *multigrid_, load, {}, options, job.progress);
}

/// ∫ u b_i for the function u with these coefficients.
MultiVector HeatDiffusion::IntegralsOf(const MultiVector& coefficients, const Job& job) const
{
  MultiVector integrals;
  Multiply(mass_, coefficients, integrals, job.threads);
  if (const DistributedRows* distributed = space_->Distributed(0))
  {
    distributed->Sum(integrals);
  }
  return integrals;
}

SolveReport HeatDiffusion::Advance(const Job& job)
{
  const MultiVector added = stageStep_ * sources_;
  const bool isFirstOrder = options_.scheme == TimeScheme::BackwardEuler;
  const bool isStart = !isFirstOrder && !hasStarted_;
  const int solves = isFirstOrder ? 1 : isStart ? 3 : 2;
  PoissonSolution solution;
  MultiVector before; // coefficients of the solve before the last
  MultiVector now = load_;
  auto accuracy = SolutionAccuracy::Exact();
  bool converged = true;
  for (int k = 0; k < solves; ++k)
  {
    if (k > 0 && !isStart)
    {
      // M U - load is γδ times the slope of the first stage.
      now = load_ + (1.0 - Gamma) / Gamma * (now - load_);
    }
    before = std::move(solution.coefficients);
    solution = this->Solve(now + added, job.Part(double(k) / solves, double(k + 1) / solves));
    converged = converged && solution.report.converged;
    KeepWorse(solution.accuracy, accuracy);
    now = this->IntegralsOf(solution.coefficients, job);
  }
  if (isStart)
  {
    // The last two solves are at 2γδ and 3γδ. The line through them is followed to δ.
    solution.coefficients += (1.0 / Gamma - 3.0) * (solution.coefficients - before);
    now = this->IntegralsOf(solution.coefficients, job);
  }
  load_ = std::move(now);
  coefficients_ = std::move(solution.coefficients);
  accuracy_ = accuracy;
  hasStarted_ = true;
  solution.report.converged = converged;
  return std::move(solution.report);
}

} // namespace gridfem
