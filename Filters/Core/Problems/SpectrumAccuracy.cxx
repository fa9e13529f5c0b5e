#include "Problems/SpectrumAccuracy.h"

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
  const double pi = 3.14159265358979323846;
  return std::min(4.0 * pi / area, pi * pi / (side * side));
}

std::vector<double> EstimateErrors(
  const Eigen::VectorXd& coarse, const Eigen::VectorXd& fine, const std::vector<double>& residuals)
{
  std::vector<double> errors;
  for (std::size_t j = 0; j < residuals.size(); ++j)
  {
    const Id pair = static_cast<Id>(j);
    const double difference =
      pair < coarse.size() ? std::max(0.0, coarse[pair] - fine[pair]) / (3.0 * fine[pair]) : 1.0;
    errors.push_back(std::min(1.0, difference + residuals[j] * residuals[j]));
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
