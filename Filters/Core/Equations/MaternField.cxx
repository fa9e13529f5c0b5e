#include "Equations/MaternField.h"

#include "Base/Errors.h"
#include "Spaces/RandomLoads.h"

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

FieldSamples MaternField::Sample(std::uint64_t seed, Id first, Id count, const Job& job) const
{
  const double weight = options_.kappa * options_.kappa;
  const bool isOdd = options_.smoothness == 2; // an odd power of the root of the operator
  const int solves = options_.smoothness == 1 ? 1 : 2;
  MultiVector load = RandomLoads(
    *space_, isOdd ? weight : 1.0, isOdd ? 1.0 : 0.0, seed, first, count, job.Part(0.0, 0.2));
  const PoissonOptions options{ options_, weight };
  FieldSamples samples;
  for (int k = 0; k < solves; ++k)
  {
    PoissonSolution solution = SolvePoisson(*space_, *multigrid_, load / weight, {}, options,
      job.progress.Part(0.2 + 0.8 * k / solves, 0.2 + 0.8 * (k + 1) / solves));
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
  const double pi = std::acos(-1.0);
  samples.coefficients *=
    std::sqrt(4.0 * pi * options_.smoothness) * std::pow(options_.kappa, options_.smoothness);
  return samples;
}

} // namespace gridfem
