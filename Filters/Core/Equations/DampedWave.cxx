#include "Equations/DampedWave.h"

#include <cmath>
#include <string>
#include <utility>

namespace gridfem
{

DampedWave::DampedWave(std::shared_ptr<const SpaceLevels> space, const WaveTerms& terms,
  const EquationOptions& equation, double step, const Job& job)
  : space_(std::move(space)), terms_(terms), equation_(equation), step_(step)
{
  const auto isNumber = [](double x, bool mayBeZero)
  { return (x > 0.0 || (mayBeZero && x == 0.0)) && !std::isinf(x); };
  if (!isNumber(step, false) || !isNumber(terms.speed, false) || !isNumber(terms.damping, true))
  {
    throw InvalidInput("The time step is " + std::to_string(step) + ", the speed " +
                       std::to_string(terms.speed) + " and the damping " +
                       std::to_string(terms.damping) +
                       ". All must be finite, the first two above 0, and the last 0 or more.");
  }
  const double ofMass = 2.0 * (2.0 + step * terms.damping) / std::pow(step * terms.speed, 2);
  const double smoothing = MassSmoothing(*space_);
  share_ = 1.0 / (1.0 + ofMass * smoothing);
  weight_ = ofMass * share_;
  mass_ = space_->Matrix(0, 1.0, smoothing, job.threads);
  stiffness_ = space_->Matrix(0, 0.0, 1.0, job.threads);
  multigrid_ = std::make_unique<const Multigrid>(
    BuildMultigrid(*space_, weight_, 1.0, equation_.multigrid, job.progress));
}

void DampedWave::Start(MultiVector coefficients)
{
  if (coefficients.rows() != static_cast<Id>(space_->Integrals().size()) ||
      coefficients.cols() != 2)
  {
    throw InvalidInput("The start does not fit the functions, or has no u and u'.");
  }
  now_ = std::move(coefficients);
  mean_ = {};
  meanBefore_ = {};
}

/// Two equations hold for w: next u = u + step w, and the trapezoidal rule for u'. Together they
/// are (a M + L) w = a 2 / (2 + step d) M u' - 2 / step L u with the mass M, which has a share of
/// L.
SolveReport DampedWave::Advance(const Job& job)
{
  MultiVector load;
  MultiVector pull;
  Multiply(mass_, now_.col(1), load, job.threads);
  Multiply(stiffness_, now_.col(0), pull, job.threads);
  load *= 2.0 / (2.0 + step_ * terms_.damping);
  pull *= -2.0 / step_ * share_;
  const MultiVector guess = mean_.rows() == 0         ? MultiVector(now_.col(1))
                            : meanBefore_.rows() == 0 ? mean_
                                                      : MultiVector(2.0 * mean_ - meanBefore_);
  PoissonOptions options{ equation_, weight_ };
  options.start = &guess;
  PoissonSolution solution = SolvePoisson(*space_, *multigrid_, load, pull, options, job.progress);
  meanBefore_ = std::move(mean_);
  mean_ = std::move(solution.coefficients);
  now_.col(0) += step_ * mean_;
  now_.col(1) = 2.0 * mean_ - now_.col(1);
  return std::move(solution.report);
}

double DampedWave::Energy(const Job& job) const
{
  MultiVector ofRate;
  MultiVector ofHeight;
  Multiply(mass_, now_.col(1), ofRate, job.threads);
  Multiply(stiffness_, now_.col(0), ofHeight, job.threads);
  const double kinetic = ColumnProducts<double>(now_.col(1), ofRate, job.threads)[0];
  const double potential = ColumnProducts<double>(now_.col(0), ofHeight, job.threads)[0];
  return 0.5 * (kinetic + terms_.speed * terms_.speed * potential);
}

} // namespace gridfem
