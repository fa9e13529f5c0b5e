#include "Equations/MaternField.h"

#include "Base/Errors.h"
#include "Spaces/RandomLoads.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace gridfem
{

MaternField::MaternField(
  std::shared_ptr<const FiniteElementSpace> space, const MaternOptions& options, const Job& job)
  : space_(std::move(space)), options_(options)
{
  if (!(options.kappa > 0.0) || std::isinf(options.kappa))
  {
    throw InvalidInput("κ is " + std::to_string(options.kappa) + "; it must be a number above 0.");
  }
  if (options.smoothness < 1 || options.smoothness > 3)
  {
    throw InvalidInput(
      "Smoothness is " + std::to_string(options.smoothness) + "; it must be 1, 2 or 3.");
  }
  mass_ = space_->Matrix(0, 1.0, 0.0, job.threads);
  multigrid_ = std::make_unique<Multigrid>(
    BuildMultigrid(*space_, options.kappa * options.kappa, 1.0, options.multigrid, job.progress));
}

FieldSamples MaternField::Solve(
  MultiVector load, int solves, double tolerance, const Job& job) const
{
  const double weight = options_.kappa * options_.kappa;
  PoissonOptions options{ options_, weight };
  options.solve.tolerance = tolerance;
  FieldSamples samples;
  for (int k = 0; k < solves; ++k)
  {
    PoissonSolution solution = SolvePoisson(*space_, *multigrid_, load / weight, {}, options,
      job.progress.Part(double(k) / solves, double(k + 1) / solves));
    if (k + 1 < solves)
    {
      Multiply(mass_, solution.coefficients, load, job.threads);
    }
    if (k == 0)
    {
      samples.report = std::move(solution.report);
    }
    else
    {
      KeepWorse(std::move(solution.report), samples.report);
    }
    samples.coefficients = std::move(solution.coefficients);
  }
  return samples;
}

double MaternField::Scale() const
{
  return std::sqrt(4.0 * double(EIGEN_PI) * options_.smoothness) *
         std::pow(options_.kappa, options_.smoothness);
}

FieldSamples MaternField::Sample(std::uint64_t seed, Id first, Id count, const Job& job) const
{
  const bool isOdd = options_.smoothness == 2; // an odd power of the root of the operator
  FieldSamples samples =
    this->Solve(RandomLoads(*space_, isOdd ? options_.kappa * options_.kappa : 1.0,
                  isOdd ? 1.0 : 0.0, seed, first, count, job.Part(0.0, 0.2)),
      options_.smoothness == 1 ? 1 : 2, options_.solve.tolerance, job.Part(0.2, 1.0));
  samples.coefficients *= this->Scale();
  return samples;
}

/// The areas are the sums of the functions' integrals, because the functions add up to 1.
std::vector<double> MaternField::DeviationsOfMeans(const Job& job) const
{
  const Components components = space_->ComponentsOf(0, job);
  MultiVector integrals;
  Multiply(mass_, MultiVector::Ones(mass_.rows, 1), integrals, job.threads);
  std::vector<double> areas(components.count, 0.0);
  for (Id function = 0; function < integrals.rows(); ++function)
  {
    areas[components.ofFunction[function]] += integrals(function, 0);
  }
  std::vector<double> deviations;
  for (const double area : areas)
  {
    deviations.push_back(
      std::sqrt(4.0 * double(EIGEN_PI) * options_.smoothness / area) / options_.kappa);
  }
  return deviations;
}

double MaternField::CovarianceTolerance() const
{
  return std::min(options_.solve.tolerance, 1e-9);
}

FieldSamples MaternField::Covariances(MultiVector load, const Job& job) const
{
  FieldSamples samples =
    this->Solve(std::move(load), options_.smoothness + 1, this->CovarianceTolerance(), job);
  samples.coefficients *= this->Scale() * this->Scale();
  return samples;
}

} // namespace gridfem
