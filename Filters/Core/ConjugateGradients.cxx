#include "ConjugateGradients.h"

#include "ColumnAlgebra.h"
#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

void CheckProblem(const Multigrid& multigrid, const MultiVector& b, const MultiVector& x,
  const SolveOptions& options)
{
  if (b.rows() != multigrid.Matrix().rows || x.rows() != b.rows() || x.cols() != b.cols())
  {
    throw InvalidInput("a system of " + std::to_string(multigrid.Matrix().rows) +
                       " unknowns got b " + std::to_string(b.rows()) + " x " +
                       std::to_string(b.cols()) + " and x " + std::to_string(x.rows()) + " x " +
                       std::to_string(x.cols()));
  }
  if (!(options.tolerance > 0.0) || options.maximumIterations < 1)
  {
    throw InvalidInput("the tolerance must be positive and at least one iteration allowed");
  }
  if (!x.allFinite())
  {
    throw InvalidInput("the start of the iteration contains values that are not finite");
  }
}

/// Growth of the energy measure that a solvable system does not show: conjugate gradients stay
/// below the root of the condition number.
constexpr double Divergence = 1e8;

void Project(const std::function<void(MultiVector&)>& projection, MultiVector& v)
{
  if (projection)
  {
    projection(v);
  }
}

/// What conjugate gradients and repeated cycles have in common: the residual r, z = B r with one
/// cycle B, their measures, and which columns still iterate. The columns of r and z that do not are
/// zero, so that they neither change x nor spread NaN.
class Iteration
{
public:
  Iteration(const Multigrid& multigrid, const MultiVector& b, MultiVector& x,
    const SolveOptions& options, const Projection& project);

  bool CanGoOn() const
  {
    return this->IsActive() && report_.iterations < options_.maximumIterations;
  }
  bool IsActive() const { return isActive_.any(); }
  bool IsActive(Id column) const { return isActive_[column]; }

  /// Counts an iteration and reports progress; throws Aborted.
  void Begin(const Progress& progress);

  /// r = b - A x in the columns that iterate.
  void ComputeResidual();

  /// z = B r and its measures; retires columns that are done.
  void Measure();

  /// Ends the iteration of a column. One that has converged by energy takes z, which is there.
  void Retire(Id column, bool isConverged);

  /// Looks at the true residual of converged columns: an updated one drifts away by rounding. Those
  /// that were wrong iterate again, from z.
  void Confirm();

  SolveReport Finish();

  MultiVector r;
  MultiVector z;
  Columns rz; // rᵀz of the columns that iterate

private:
  void MeasureZero();
  void ApplyCycle(const MultiVector& residual, MultiVector& correction, Columns& energy) const;
  void SetReference(const Columns& workOfStart);
  void Judge();
  bool IsSolved(Id column) const;
  void Record();
  int Threads() const { return multigrid_.Options().threads; }

  const Multigrid& multigrid_;
  const MultiVector& b_;
  MultiVector& x_;
  const SolveOptions& options_;
  const Projection& project_;

  Eigen::Array<bool, Eigen::Dynamic, 1> isActive_;
  Eigen::Array<bool, Eigen::Dynamic, 1> isConverged_;
  Columns reference_; // of the energy; see IterationRecord
  Columns residualOfZero_;
  Columns energy_;   // relative to the first
  Columns residual_; // relative to the second
  SolveReport report_;
};

Iteration::Iteration(const Multigrid& multigrid, const MultiVector& b, MultiVector& x,
  const SolveOptions& options, const Projection& project)
  : r(b), multigrid_(multigrid), b_(b), x_(x), options_(options), project_(project)
{
  CheckProblem(multigrid, b, x, options);
  isActive_.setConstant(b.cols(), true);
  isConverged_.setConstant(b.cols(), false);
  energy_.setOnes(b.cols());
  residual_.setOnes(b.cols());
  Project(project_.residual, r);
  this->MeasureZero();
  const bool isZero = x_.isZero(0.0);
  const Columns workOfStart = ColumnProducts(x_, r, this->Threads());
  if (!isZero)
  {
    this->ComputeResidual();
  }
  this->ApplyCycle(r, z, rz);
  reference_ = rz.sqrt();
  if (!isZero)
  {
    this->SetReference(workOfStart);
  }
  this->Judge();
}

/// |b|. Retires columns without a solution or with a trivial one.
void Iteration::MeasureZero()
{
  residualOfZero_ = ColumnProducts(r, r, this->Threads()).sqrt();
  for (Id c = 0; c < r.cols(); ++c)
  {
    if (!std::isfinite(residualOfZero_[c]))
    {
      energy_[c] = residual_[c] = std::numeric_limits<double>::quiet_NaN();
      this->Retire(c, false);
    }
    else if (residualOfZero_[c] == 0.0)
    {
      energy_[c] = residual_[c] = 0.0;
      x_.col(c).setZero();
      this->Retire(c, true);
    }
  }
}

void Iteration::ApplyCycle(
  const MultiVector& residual, MultiVector& correction, Columns& energy) const
{
  multigrid_.Precondition(residual, correction);
  Project(project_.solution, correction);
  energy = ColumnProducts(residual, correction, this->Threads());
}

/// By Cauchy and Schwarz bᵀx / |x| is at most |A⁻¹b|, both in the energy norm, and near it for a
/// start that is worth something. Where it is not even above the error that is left, the energy of
/// zero costs a cycle.
/// @param workOfStart  bᵀx
void Iteration::SetReference(const Columns& workOfStart)
{
  const Columns energyOfStart = workOfStart - ColumnProducts(x_, r, this->Threads()); // xᵀAx
  const Columns bound = workOfStart.square() / energyOfStart;
  const auto isBound = energyOfStart > 0.0 && bound >= rz;
  reference_ = bound.sqrt();
  if ((isActive_ && !isBound).any())
  {
    MultiVector zeroResidual = b_;
    Project(project_.residual, zeroResidual);
    MultiVector correction;
    Columns energyOfZero;
    this->ApplyCycle(zeroResidual, correction, energyOfZero);
    reference_ = isBound.select(reference_, energyOfZero.sqrt());
  }
}

void Iteration::Begin(const Progress& progress)
{
  const double worst = std::clamp(energy_.maxCoeff(), options_.tolerance, 1.0);
  const double byMeasure =
    options_.tolerance < 1.0 ? std::log(worst) / std::log(options_.tolerance) : 0.0;
  progress.Check(std::max(byMeasure, double(report_.iterations) / options_.maximumIterations));
  ++report_.iterations;
}

void Iteration::ComputeResidual()
{
  Residual(multigrid_.Matrix(), x_, b_, r, this->Threads());
  Project(project_.residual, r);
  for (Id c = 0; c < r.cols(); ++c)
  {
    if (!this->IsActive(c))
    {
      r.col(c).setZero();
    }
  }
}

void Iteration::Measure()
{
  this->ApplyCycle(r, z, rz);
  this->Judge();
}

void Iteration::Judge()
{
  const Columns rr = ColumnProducts(r, r, this->Threads());
  for (Id c = 0; c < r.cols(); ++c)
  {
    if (!this->IsActive(c))
    {
      continue;
    }
    energy_[c] = std::sqrt(rz[c]) / reference_[c];
    residual_[c] = std::sqrt(rr[c]) / residualOfZero_[c];
    const bool isBroken = !(energy_[c] < Divergence) || !std::isfinite(residual_[c]);
    if (isBroken || this->IsSolved(c))
    {
      this->Retire(c, !isBroken);
    }
  }
  this->Record();
}

/// A vanishing energy may be underflow or a residual that the cycle does not see; |r| tells.
bool Iteration::IsSolved(Id column) const
{
  const bool byEnergy = options_.measure == SolveOptions::Measure::Energy && energy_[column] > 0.0;
  return (byEnergy ? energy_[column] : residual_[column]) <= options_.tolerance;
}

void Iteration::Retire(Id column, bool isConverged)
{
  isActive_[column] = false;
  isConverged_[column] = isConverged;
  r.col(column).setZero();
  if (z.size() > 0)
  {
    if (isConverged && options_.measure == SolveOptions::Measure::Energy)
    {
      x_.col(column) += z.col(column);
    }
    z.col(column).setZero();
  }
}

void Iteration::Confirm()
{
  isActive_ = isConverged_;
  isConverged_.setConstant(false);
  this->ComputeResidual();
  const Columns norm = ColumnProducts(r, r, this->Threads()).sqrt();
  for (Id c = 0; c < r.cols(); ++c)
  {
    if (this->IsActive(c) && norm[c] <= 2.0 * residual_[c] * residualOfZero_[c])
    {
      this->Retire(c, true);
    }
  }
  if (this->IsActive())
  {
    this->Measure();
  }
}

/// The largest over the columns; NaN if there is one.
double Worst(const Columns& values)
{
  return values.size() == 0 ? 0.0 : values.maxCoeff<Eigen::PropagateNaN>();
}

void Iteration::Record()
{
  const IterationRecord record{ report_.iterations, Worst(energy_), Worst(residual_) };
  if (!report_.history.empty() && report_.history.back().iteration == record.iteration)
  {
    report_.history.back() = record;
  }
  else
  {
    report_.history.push_back(record);
  }
}

SolveReport Iteration::Finish()
{
  Project(project_.solution, x_);
  report_.converged = isConverged_.all();
  const double first = report_.history.front().energy;
  const double last = report_.history.back().energy;
  if (report_.iterations > 0 && first > 0.0)
  {
    report_.convergenceFactor = std::pow(last / first, 1.0 / report_.iterations);
  }
  return std::move(report_);
}

/// The cycle B makes p'Ap / p'B⁻¹p at most 1 or so. Below the inverse of this, p lies in the null
/// space of A: the system has no solution.
constexpr double LongestStep = 1e12;

/// Steps to the minimum along p; 0 in columns that do not iterate. A column whose p does not have
/// positive energy breaks down, and what its q holds is forgotten.
Columns StepLengths(Iteration& iteration, MultiVector& p, MultiVector& q, int threads)
{
  const Columns pq = ColumnProducts(p, q, threads);
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
      iteration.Retire(c, false);
    }
  }
  return step;
}

} // namespace

SolveReport SolveConjugateGradients(const Multigrid& multigrid, const MultiVector& b,
  MultiVector& x, const SolveOptions& options, const Projection& project, const Progress& progress)
{
  const int threads = multigrid.Options().threads;
  Iteration iteration(multigrid, b, x, options, project);
  MultiVector p = iteration.z;
  MultiVector q;
  while (iteration.CanGoOn())
  {
    iteration.Begin(progress);
    Multiply(multigrid.Matrix(), p, q, threads);
    const Columns step = StepLengths(iteration, p, q, threads);
    AddScaled(p, step, x, threads);
    AddScaled(q, -step, iteration.r, threads);
    const Columns before = iteration.rz;
    iteration.Measure();
    Columns factor = Columns::Zero(b.cols());
    for (Id c = 0; c < b.cols(); ++c)
    {
      factor[c] = iteration.IsActive(c) ? iteration.rz[c] / before[c] : 0.0;
    }
    if (!iteration.IsActive())
    {
      iteration.Confirm();
    }
    ScaleAndAdd(iteration.z, factor, p, threads);
  }
  return iteration.Finish();
}

SolveReport SolveCycles(const Multigrid& multigrid, const MultiVector& b, MultiVector& x,
  const SolveOptions& options, const Projection& project, const Progress& progress)
{
  const int threads = multigrid.Options().threads;
  Iteration iteration(multigrid, b, x, options, project);
  while (iteration.CanGoOn())
  {
    iteration.Begin(progress);
    AddScaled(iteration.z, Columns::Ones(b.cols()), x, threads);
    iteration.ComputeResidual();
    iteration.Measure();
  }
  return iteration.Finish();
}

} // namespace gridfem
