#include "Equations/ReactionDiffusion.h"

#include "Base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace gridfem
{
namespace
{

/// Greater numbers soon leave the range of doubles.
constexpr double LargestNumber = 1e100;

void RequireTerms(const ReactionTerms& terms, double step)
{
  if (!(step > 0.0) || std::isinf(step))
  {
    throw InvalidInput(
      "The time step is " + std::to_string(step) + "; it must be a number above 0.");
  }
  for (const double diffusion : terms.diffusion)
  {
    if (!(diffusion >= 0.0) || std::isinf(diffusion) || (terms.carry && diffusion == 0.0))
    {
      throw InvalidInput("The diffusion is " + std::to_string(diffusion) +
                         "; it must be a number " + (terms.carry ? "above 0." : "of 0 or more."));
    }
  }
}

} // namespace

ReactionDiffusion::ReactionDiffusion(std::shared_ptr<const FiniteElementSpace> space,
  ReactionTerms terms, const EquationOptions& equation, double step, const Job& job)
  : space_(std::move(space)), terms_(std::move(terms)), equation_(equation),
    stage_(2.0 / 3.0 * step)
{
  RequireTerms(terms_, step);
  smoothing_ = MassSmoothing(*space_);
  mass_ = space_->Matrix(0, 1.0, smoothing_, job.threads);
  samples_ = space_->Samples(job.Part(0.0, 0.2));
  const std::vector<double>& diffusion = terms_.diffusion;
  for (std::size_t s = 0; s < diffusion.size(); ++s)
  {
    const auto same = static_cast<std::size_t>(
      std::find(diffusion.begin(), diffusion.end(), diffusion[s]) - diffusion.begin());
    const double share = 1.0 / static_cast<double>(diffusion.size());
    const Job part = job.Part(0.2 + 0.8 * double(s) * share, 0.2 + 0.8 * double(s + 1) * share);
    multigrid_.push_back(same < s ? multigrid_[same]
                                  : std::make_shared<const Multigrid>(BuildMultigrid(*space_,
                                      1.0 / (stage_ * diffusion[s] + smoothing_), 1.0,
                                      equation_.multigrid, part.progress)));
  }
}

void ReactionDiffusion::Start(MultiVector coefficients)
{
  if (coefficients.rows() != static_cast<Id>(space_->Integrals().size()) ||
      coefficients.cols() != static_cast<Id>(terms_.diffusion.size()))
  {
    throw InvalidInput("The start does not fit the functions or the species.");
  }
  now_ = std::move(coefficients);
  before_ = {};
  twoBefore_ = {};
  explicitNow_ = {};
  explicitBefore_ = {};
  errors_ = Columns();
  largest_ = Columns();
}

ReactionDiffusion::Rates ReactionDiffusion::ExplicitPart(
  const MultiVector& coefficients, const Job& job) const
{
  MultiVector values;
  Multiply(samples_.values, coefficients, values, job.threads);
  Rates rates;
  rates.largest = values.cwiseAbs().colwise().maxCoeff().transpose().array();
  rates.load = MultiVector::Zero(coefficients.rows(), coefficients.cols());
  if (terms_.react)
  {
    MultiVector atSamples(values.rows(), values.cols());
    ParallelRanges(values.rows(), job.threads,
      [&](Id begin, Id end)
      { terms_.react(values.row(begin).data(), atSamples.row(begin).data(), end - begin); });
    MultiplyAdd(samples_.integrals, atSamples, rates.load, job.threads);
  }
  if (terms_.carry)
  {
    rates.load += terms_.carry(coefficients, job.threads);
  }
  return rates;
}

/// Solves (M + stage D L) u = M known + stage explicit for each species.
MultiVector ReactionDiffusion::SolveSpecies(const MultiVector& known,
  const MultiVector& explicitPart, const MultiVector& guess, SolveReport& report,
  const Job& job) const
{
  MultiVector load;
  Multiply(mass_, known, load, job.threads);
  load += stage_ * explicitPart;
  MultiVector result(known.rows(), known.cols());
  const Id species = known.cols();
  for (Id s = 0; s < species; ++s)
  {
    if (!(load.col(s).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() < LargestNumber))
    {
      result.col(s).setConstant(std::numeric_limits<double>::quiet_NaN());
      SolveReport lost;
      lost.end = SolveEnd::NotFinite;
      KeepWorse(std::move(lost), report);
      continue;
    }
    const double spread = stage_ * terms_.diffusion[s] + smoothing_;
    PoissonOptions options{ equation_, 1.0 / spread };
    const MultiVector start = guess.col(s);
    options.start = &start;
    PoissonSolution solution = SolvePoisson(*space_, *multigrid_[s], load.col(s), {}, options,
      job.progress.Part(double(s) / double(species), double(s + 1) / double(species)));
    result.col(s) = solution.coefficients;
    KeepWorse(std::move(solution.report), report);
  }
  return result;
}

/// Its error is of third order, and the difference of the rates is of first order in a term of
/// second order. So the square of the relative difference is the error.
MultiVector ReactionDiffusion::FirstStep(Columns& errors, SolveReport& report, const Job& job) const
{
  const MultiVector& atStart = explicitNow_.load;
  const MultiVector once = this->SolveSpecies(now_, atStart, now_, report, job.Part(0.0, 0.5));
  const MultiVector then = this->ExplicitPart(once, job).load;
  const MultiVector twice = this->SolveSpecies(once, then, once, report, job.Part(0.5, 1.0));
  const Columns differences = this->ErrorsOf(atStart, then);
  const Columns sizes = explicitNow_.largest.max(differences);
  errors = (sizes > 0.0).select(differences.square() / sizes, 0.0);
  return 0.5 * (once + twice);
}

/// A mean over each function, because rates are known as integrals.
Columns ReactionDiffusion::ErrorsOf(
  const MultiVector& extrapolated, const MultiVector& computed) const
{
  const std::vector<double>& integrals = space_->Integrals();
  const Eigen::Map<const Eigen::ArrayXd> area(integrals.data(), static_cast<Id>(integrals.size()));
  const double least = 1e-6 * area.mean(); // less area leaves rounding errors
  Columns errors(extrapolated.cols());
  for (Id s = 0; s < extrapolated.cols(); ++s)
  {
    errors[s] =
      stage_ * ((computed.col(s) - extrapolated.col(s)).array().abs() / (area + least)).maxCoeff();
  }
  return errors;
}

SolveReport ReactionDiffusion::Advance(const Job& job)
{
  SolveReport report = SolveReport::Solved();
  if (explicitNow_.load.rows() == 0)
  {
    explicitNow_ = this->ExplicitPart(now_, job);
  }
  Columns errors;
  MultiVector ahead;
  MultiVector next;
  if (before_.rows() == 0)
  {
    next = this->FirstStep(errors, report, job);
  }
  else
  {
    ahead = 2.0 * explicitNow_.load - explicitBefore_;
    const MultiVector guess = twoBefore_.rows() == 0
                                ? MultiVector(2.0 * now_ - before_)
                                : MultiVector(3.0 * (now_ - before_) + twoBefore_);
    next = this->SolveSpecies((4.0 * now_ - before_) / 3.0, ahead, guess, report, job);
  }
  Rates atNext = this->ExplicitPart(next, job);
  if (ahead.rows() > 0)
  {
    errors = this->ErrorsOf(ahead, atNext.load);
  }
  if (!atNext.load.allFinite())
  {
    next.setConstant(std::numeric_limits<double>::quiet_NaN());
    report = SolveReport();
    report.end = SolveEnd::NotFinite;
  }
  errors_ = std::move(errors);
  largest_ = explicitNow_.largest.max(atNext.largest);
  twoBefore_ = std::move(before_);
  before_ = std::move(now_);
  now_ = std::move(next);
  explicitBefore_ = std::move(explicitNow_.load);
  explicitNow_ = std::move(atNext);
  return report;
}

double ReactionDiffusion::Energy(const Job& /*job*/) const
{
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace gridfem
