#include "Spectrum/SpectrumAccuracy.h"

#include "Base/Errors.h"
#include "Grid/Grid.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// A relative error e of eigenvalue k takes about this number times k / e unknowns: 0.8 measured on
/// spheres, 1.1 on the rocker arm.
constexpr double FunctionsPerModeAndError = 1.0;

/// With fewer functions per mode, the error is not yet of second order.
constexpr double LeastFunctionsPerMode = 16.0;

///@{ The ratio of the differences between three levels.
constexpr double SecondOrder = 4.0;   // the best that errors are taken to fall
constexpr double LeastRatio = 1.5;    // the worst
constexpr double SmallestRatio = 1.7; // range of a trusted one
constexpr double LargestRatio = 16.0;
///@}

/// Largest change from the coarsest to the middle level, relative to the value, of a trusted ratio.
/// A level where a value is far off does not resolve its mode. Its error then has no rate: on a
/// thin plate, values that fall by half of themselves seemed to converge with order 2.
constexpr double LargestChange = 0.3;

/// Relative error that the iteration leaves on coarser levels. Smaller differences say nothing.
constexpr double IterationError = 1e-4;

void CheckAccuracy(double accuracy)
{
  if (!(accuracy > 0.0 && accuracy < 1.0))
  {
    throw InvalidInput("The wanted accuracy of the eigenvalues must lie between 0 and 1.");
  }
}

} // namespace

bool IsMultiplet(double a, double b, Id count)
{
  return b - a < std::min(0.25 / static_cast<double>(count), 0.01) * b;
}

double LowestValue(double area, double side)
{
  const auto pi = double(EIGEN_PI);
  return std::min(4.0 * pi / area, pi * pi / (side * side));
}

EigenvalueErrors EstimateErrors(const ValuesOnLevels& values, const std::vector<double>& residuals)
{
  EigenvalueErrors errors;
  for (std::size_t j = 0; j < residuals.size(); ++j)
  {
    const Id mode = static_cast<Id>(j);
    const double finest = values.finest[mode];
    const double step = std::abs(values.next[mode] - finest) / finest;
    const double before = std::abs(values.afterNext[mode] - values.next[mode]) / finest;
    const double ratio = step > 0.0 ? before / step : LargestRatio; // NaN: unknown
    const double used =
      std::isnan(ratio) ? SecondOrder : std::clamp(ratio, LeastRatio, SecondOrder);
    const double error = std::isnan(step) ? 1.0 : step / (used - 1.0);
    const bool isRounding = step < IterationError && before < 10.0 * IterationError;
    errors.relative.push_back(std::min(1.0, error + residuals[j] * residuals[j]));
    const bool isPlausible =
      ratio >= SmallestRatio && ratio <= LargestRatio && before <= LargestChange;
    errors.isTrusted.push_back(isRounding || (isPlausible && error < 1.0));
  }
  return errors;
}

int DepthForAccuracy(const std::vector<double>& estimatedErrors, int depth, double accuracy)
{
  CheckAccuracy(accuracy);
  double error = 0.0;
  for (const double estimate : estimatedErrors)
  {
    error = std::max(error, estimate);
  }
  while (error > accuracy && depth < MaximumDepth)
  {
    error /= 4.0;
    ++depth;
  }
  return depth;
}

int FirstDepthForAccuracy(double functionsAt5, Id modes, double accuracy)
{
  CheckAccuracy(accuracy);
  const double perMode = std::max(FunctionsPerModeAndError / accuracy, LeastFunctionsPerMode);
  double functions = functionsAt5 * std::pow(0.25, 5 - MinimumDepth);
  int depth = MinimumDepth;
  while (functions < perMode * static_cast<double>(modes) && depth < MaximumDepth)
  {
    functions *= 4.0;
    ++depth;
  }
  return depth;
}

} // namespace gridfem
