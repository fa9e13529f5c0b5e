#include "Equations/SolutionAccuracy.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Best reduction of a cycle that is taken for real.
constexpr double LeastReduction = 0.05;

/// Corrections before an iteration may end. The first one leads from the coarser level to this one
/// and says nothing about slow components.
constexpr int FirstJudgement = 3;

/// Relative error below which no better solution is asked for, because the coarser level may
/// contain the solution.
constexpr double FinestError = 1e-8;

/// Range of the ratio of errors on neighboring levels, scaled to four times the functions. It is 4
/// at second order.
constexpr double SmallestRate = 2.0;
constexpr double LargestRate = 8.0;

/// Range of the difference of two levels over the error of the finer one, if it follows from the
/// observed rate.
constexpr double LeastObserved = 0.5;
constexpr double MostObserved = 5.0;

/// The difference of the solutions of two levels over the error of the finer one. Errors are
/// assumed to fall with the number of functions. If the finer level has few more functions, such as
/// hats over a fine grid, the difference is about its own error.
double DifferenceOverError(Index fine, Index coarse)
{
  return std::max(1.0, double(fine) / double(std::max<Index>(1, coarse)) - 1.0);
}

double Worst(const Columns& values)
{
  return values.size() == 0 ? SolutionAccuracy::Unknown : values.maxCoeff<Eigen::PropagateNaN>();
}

/// Relative errors; 0 for columns of size 0. Unknown where one of the two is NaN.
Columns Relative(const Columns& error, const Columns& size)
{
  return (size == 0.0).select(0.0 * error, error / size);
}

/// The fraction of the last correction that is left as an error. A cycle leaves 1 - θ of the
/// slowest component, with the smallest Ritz value θ. Corrections shrink as fast as the error does.
/// Both may be too small after few iterations, so the larger counts (Testing/Benchmarks/README.md).
Columns Reductions(const Columns& step, const Columns& lastStep, const Columns& slowest)
{
  Columns reduction(step.size());
  for (Id c = 0; c < reduction.size(); ++c)
  {
    const double seen = step[c] < lastStep[c] ? step[c] / lastStep[c] : 1.0;
    const double ofSlowest = std::isnan(slowest[c]) ? 0.0 : 1.0 - slowest[c];
    reduction[c] = std::max({ seen, ofSlowest, LeastReduction });
  }
  return reduction;
}

} // namespace

double LargerOrUnknown(double a, double b)
{
  return std::isnan(a) || a >= b ? a : b;
}

void KeepWorse(const SolutionAccuracy& accuracy, SolutionAccuracy& kept)
{
  kept.isTrusted = accuracy.isTrusted && kept.isTrusted;
  kept.discretization = LargerOrUnknown(kept.discretization, accuracy.discretization);
  kept.largest = LargerOrUnknown(kept.largest, accuracy.largest);
  kept.algebraic = LargerOrUnknown(kept.algebraic, accuracy.algebraic);
}

AccuracyWatch::AccuracyWatch(const SpaceLevels& space, MultiVector nested,
  const MultiVector& coarser, double accuracy, int threads)
  : space_(space), nested_(std::move(nested)), accuracy_(accuracy), threads_(threads)
{
  if (space.NumberOfLevels() > 1)
  {
    steps_ = DifferenceOverError(space.NumberOfFunctions(0), space.NumberOfFunctions(1));
  }
  if (coarser.cols() > 0 && space.NumberOfLevels() > 2)
  {
    coarserError_ = this->Norms(coarser) /
                    DifferenceOverError(space.NumberOfFunctions(1), space.NumberOfFunctions(2));
  }
  algebraic_.setConstant(nested_.cols(), SolutionAccuracy::Unknown);
  lastStep_.setZero(nested_.cols());
}

Columns AccuracyWatch::Norms(const MultiVector& u) const
{
  return space_.SquaredNorms(u, threads_).max(0.0).sqrt();
}

ColumnMeasures AccuracyWatch::operator()(const Iterate& iterate)
{
  ++calls_;
  if (calls_ <= FirstJudgement) // later corrections change the difference by less than its accuracy
  {
    const MultiVector corrected = iterate.x + iterate.correction;
    size_ = this->Norms(corrected);
    if (accuracy_ > 0.0)
    {
      discretization_ = this->Norms(corrected - nested_) / steps_;
    }
  }
  const Columns step = this->Norms(iterate.correction);
  const Columns left = step * Reductions(step, lastStep_, iterate.slowest);
  algebraic_ = (step > 0.0).select(left, algebraic_); // finished columns have no correction
  lastStep_ = step;
  const Columns none = Columns::Zero(left.size()); // no part of a correction is on the surface
  const Columns wanted =
    accuracy_ > 0.0 ? accuracy_ * Relative(discretization_, size_).max(FinestError) : none;
  return { Relative(left, size_), calls_ < FirstJudgement ? Columns(none - 1.0) : wanted };
}

/// Ratios of the errors of two levels, scaled to four times the functions. Empty if unknown.
/// @param step  the difference between the finest level and the next
Columns AccuracyWatch::Rates(const Columns& step) const
{
  if (coarserError_.size() == 0 || space_.NestedLevels())
  {
    return {};
  }
  const double functions =
    double(space_.NumberOfFunctions(0)) / double(space_.NumberOfFunctions(1));
  const Columns rate = 4.0 / functions * coarserError_ / (step / steps_);
  return (step > 0.0).select(rate, std::numeric_limits<double>::infinity());
}

SolutionAccuracy AccuracyWatch::Result(const MultiVector& solution, const Columns& size,
  const Eigen::RowVectorXd& scale, ErrorOrder order) const
{
  SolutionAccuracy result;
  if (space_.NumberOfLevels() < 2)
  {
    return result;
  }
  const MultiVector difference = solution - nested_;
  const Columns step = this->Norms(difference);
  const Columns rate = this->Rates(step);
  const Columns overError = order == ErrorOrder::Observed && rate.size() > 0
                              ? Columns((rate - 1.0).max(LeastObserved).min(MostObserved))
                              : Columns(Columns::Constant(step.size(), steps_));
  const Columns error = step / overError;
  result.discretization = Worst(Relative(error, size));
  result.algebraic = Worst(Relative(algebraic_, size));
  const MultiVector atPoints = space_.ValuesAtPoints(
    difference * (scale.transpose().array() * overError).inverse().matrix().asDiagonal(), threads_);
  // If values are near the largest number, the error may exceed it.
  const double largest =
    atPoints.size() > 0 ? atPoints.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0.0;
  result.largest = std::isinf(largest) ? SolutionAccuracy::Unknown : largest;
  if (rate.size() > 0)
  {
    result.isTrusted =
      ((error <= FinestError * size) || (rate >= SmallestRate && rate <= LargestRate)).all();
  }
  return result;
}

} // namespace gridfem
