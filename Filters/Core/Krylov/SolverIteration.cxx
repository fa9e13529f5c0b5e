#include "Krylov/SolverIteration.h"

#include "Base/Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

void CheckProblem(
  const LinearOperator& A, const MultiVector& b, const MultiVector& x, const SolveOptions& options)
{
  if (b.rows() != A.rows || x.rows() != b.rows() || x.cols() != b.cols())
  {
    throw InvalidInput("A system of " + std::to_string(A.rows) + " unknowns got b " +
                       std::to_string(b.rows()) + " x " + std::to_string(b.cols()) + " and x " +
                       std::to_string(x.rows()) + " x " + std::to_string(x.cols()));
  }
  if (!(options.tolerance > 0.0) || options.maximumIterations < 1)
  {
    throw InvalidInput(
      "The tolerance must be positive, and the solver needs at least one iteration.");
  }
  if (!x.allFinite())
  {
    throw InvalidInput("The start of the iteration contains values that are not finite.");
  }
}

/// Growth of the energy measure that no solvable system shows. Conjugate gradients stay below the
/// square root of the condition number.
constexpr double Divergence = 1e8;

void Project(const std::function<void(MultiVector&)>& projection, MultiVector& v)
{
  if (projection)
  {
    projection(v);
  }
}

/// The largest value over the columns; NaN if any is NaN.
double Worst(const Columns& values)
{
  return values.size() == 0 ? 0.0 : values.maxCoeff<Eigen::PropagateNaN>();
}

} // namespace

SolverIteration::SolverIteration(const LinearOperator& A, const Preconditioner& B,
  const MultiVector& b, MultiVector& x, const SolveOptions& options, const Projection& project)
  : r(b), A_(A), B_(B), b_(b), x_(x), options_(options), project_(project),
    stagnation_(options.tolerance, options.maximumIterations)
{
  CheckProblem(A, b, x, options);
  isActive_.setConstant(b.cols(), true);
  slowest.setConstant(b.cols(), std::numeric_limits<double>::quiet_NaN());
  end_.assign(b.cols(), SolveEnd::IterationLimit);
  energy_.setOnes(b.cols());
  residual_.setOnes(b.cols());
  Project(project_.residual, r);
  this->MeasureZero();
  const bool isZero = (A_.products(x_, x_) == 0.0).all();
  const Columns workOfStart = A_.products(x_, r);
  if (!isZero)
  {
    this->ComputeResidual();
  }
  this->Precondition(r, z, rz);
  reference_ = rz.sqrt();
  if (!isZero)
  {
    this->SetReference(workOfStart);
  }
  this->Judge();
}

/// Measures |b|. Retires the columns without a solution and the columns with a trivial solution.
void SolverIteration::MeasureZero()
{
  residualOfZero_ = A_.products(r, r).sqrt();
  for (Id c = 0; c < r.cols(); ++c)
  {
    if (!std::isfinite(residualOfZero_[c]))
    {
      energy_[c] = residual_[c] = std::numeric_limits<double>::quiet_NaN();
      this->Retire(c, SolveEnd::NotFinite);
    }
    else if (residualOfZero_[c] == 0.0)
    {
      energy_[c] = residual_[c] = 0.0;
      x_.col(c).setZero();
      this->Retire(c, SolveEnd::Converged);
    }
  }
}

void SolverIteration::Precondition(
  const MultiVector& residual, MultiVector& correction, Columns& energy) const
{
  B_(residual, correction);
  Project(project_.solution, correction);
  energy = A_.products(residual, correction);
}

/// Sets the reference of the energy for a start other than zero. By Cauchy-Schwarz, bᵀx / |x| is at
/// most |A⁻¹b|, both in the energy norm, and close to it for a useful start.
/// If this bound is even below the energy of the error that is left, one more B gives the energy of
/// a start from zero. The iteration starts from zero if the given start would count as a
/// divergence.
/// @param workOfStart  bᵀx
void SolverIteration::SetReference(const Columns& workOfStart)
{
  const Columns energyOfStart = workOfStart - A_.products(x_, r); // xᵀAx
  const Columns bound = workOfStart.square() / energyOfStart;
  const auto isBound = energyOfStart > 0.0 && bound >= rz;
  reference_ = bound.sqrt();
  if ((isActive_ && !isBound).any())
  {
    MultiVector zeroResidual = b_;
    Project(project_.residual, zeroResidual);
    MultiVector correction;
    Columns energyOfZero;
    this->Precondition(zeroResidual, correction, energyOfZero);
    reference_ = isBound.select(reference_, energyOfZero.sqrt());
    for (Id c = 0; c < r.cols(); ++c)
    {
      if (this->IsActive(c) && !isBound[c] && rz[c] > Divergence * Divergence * energyOfZero[c])
      {
        x_.col(c).setZero();
        r.col(c) = zeroResidual.col(c);
        z.col(c) = correction.col(c);
        rz[c] = energyOfZero[c];
      }
    }
  }
}

void SolverIteration::Begin(const Progress& progress)
{
  const double worst =
    std::clamp(isActive_.select(energy_, 0.0).maxCoeff(), options_.tolerance, 1.0);
  const double byMeasure =
    options_.tolerance < 1.0 ? std::log(worst) / std::log(options_.tolerance) : 0.0;
  progress.Check(std::max(byMeasure, double(report_.iterations) / options_.maximumIterations));
  ++report_.iterations;
}

void SolverIteration::ComputeResidual()
{
  A_.residual(x_, b_, r);
  Project(project_.residual, r);
  for (Id c = 0; c < r.cols(); ++c)
  {
    if (!this->IsActive(c))
    {
      r.col(c).setZero();
    }
  }
}

void SolverIteration::Measure()
{
  this->Precondition(r, z, rz);
  this->Judge();
}

void SolverIteration::Judge()
{
  const Columns rr = A_.products(r, r);
  if (options_.measureBy && this->IsActive())
  {
    own_ = options_.measureBy({ x_, z, slowest });
  }
  for (Id c = 0; c < r.cols(); ++c)
  {
    if (!this->IsActive(c))
    {
      continue;
    }
    residual_[c] = std::sqrt(rr[c]) / residualOfZero_[c];
    // If the residual is nothing but rounding, rᵀBr is rounding too and may have either sign.
    const bool isRounding = !(rz[c] > 0.0) && residual_[c] <= options_.tolerance;
    energy_[c] = isRounding ? 0.0 : std::sqrt(rz[c]) / reference_[c];
    const bool isBroken = !(energy_[c] < Divergence) || !std::isfinite(residual_[c]);
    if (isBroken || this->IsSolved(c))
    {
      this->Retire(c, isBroken ? SolveEnd::Breakdown : SolveEnd::Converged);
    }
  }
  this->Record();
  this->EndIfStagnant();
}

/// Ends all columns at once. They share their cycles, and the slowest column decides.
void SolverIteration::EndIfStagnant()
{
  if (!this->IsActive())
  {
    return;
  }
  const bool isEnergy = options_.measure == SolveOptions::Measure::Energy;
  stagnation_.Add(isActive_.select(isEnergy ? energy_ : residual_, 0.0).maxCoeff());
  const bool givesUp =
    (options_.giveUp == SolveOptions::GiveUp::AtStandstill && stagnation_.IsAtStandstill()) ||
    (options_.giveUp == SolveOptions::GiveUp::WhenTooSlow && stagnation_.IsTooSlow());
  if (givesUp)
  {
    for (Id c = 0; c < r.cols(); ++c)
    {
      if (this->IsActive(c))
      {
        this->Retire(c, SolveEnd::Stagnation);
      }
    }
  }
}

/// A vanishing energy may be underflow, or a residual that the cycle does not see. |r| tells the
/// difference.
bool SolverIteration::IsSolved(Id column) const
{
  if (options_.measureBy && own_.value[column] <= own_.wanted[column])
  {
    return true;
  }
  const bool byEnergy = options_.measure == SolveOptions::Measure::Energy && energy_[column] > 0.0;
  return (byEnergy ? energy_[column] : residual_[column]) <= options_.tolerance;
}

void SolverIteration::Retire(Id column, SolveEnd end)
{
  isActive_[column] = false;
  end_[column] = end;
  r.col(column).setZero();
  if (z.size() > 0)
  {
    if (end == SolveEnd::Converged && options_.measure == SolveOptions::Measure::Energy &&
        takesLast_)
    {
      x_.col(column) += z.col(column);
    }
    z.col(column).setZero();
  }
}

void SolverIteration::Confirm()
{
  for (Id c = 0; c < r.cols(); ++c)
  {
    isActive_[c] = end_[c] == SolveEnd::Converged;
    end_[c] = isActive_[c] ? SolveEnd::IterationLimit : end_[c];
  }
  this->ComputeResidual();
  const Columns norm = A_.products(r, r).sqrt();
  for (Id c = 0; c < r.cols(); ++c)
  {
    if (this->IsActive(c) && norm[c] <= 2.0 * residual_[c] * residualOfZero_[c])
    {
      this->Retire(c, SolveEnd::Converged);
    }
  }
  if (this->IsActive())
  {
    // A column that is done now takes no last step, because nobody would check the residual after
    // it.
    takesLast_ = false;
    this->Measure();
    takesLast_ = true;
  }
}

void SolverIteration::Record()
{
  const IterationRecord record{ report_.iterations, Worst(energy_), Worst(residual_),
    Worst(own_.value) };
  if (!report_.history.empty() && report_.history.back().iteration == record.iteration)
  {
    report_.history.back() = record;
  }
  else
  {
    report_.history.push_back(record);
  }
}

SolveReport SolverIteration::Finish()
{
  Project(project_.solution, x_);
  report_.end = end_.empty() ? SolveEnd::Converged : *std::max_element(end_.begin(), end_.end());
  report_.converged = report_.end == SolveEnd::Converged;
  report_.convergenceFactor = MeanFactor(report_);
  report_.where = A_.where();
  return std::move(report_);
}

} // namespace gridfem
