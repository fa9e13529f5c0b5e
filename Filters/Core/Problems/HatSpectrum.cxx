#include "Problems/HatSpectrum.h"

#include "Algebra/BlockProducts.h"
#include "Krylov/LobpcgWindows.h"
#include "Multigrid/BlockPreconditioner.h"
#include "Problems/FinishSpectrum.h"
#include "Problems/SpectrumAccuracy.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// Far below what the two discretisations differ by.
constexpr double GridTolerance = 1e-4;
constexpr int RandomStartIterations = 40;

/// Whether the value behind the first `count` belongs to the multiplet of the last of them.
/// @param before  how many values precede these
template<class Values>
bool EndsInside(const Values& values, Index before, Index count)
{
  return count > 0 && count < static_cast<Index>(values.size()) &&
         IsMultiplet(values[count - 1], values[count], before + count);
}

/// How many of the grid's modes make up the list.
Index ListLength(const Spectrum& grid, const SpectrumOptions& options)
{
  Index count = options.numberOfModes;
  while (options.completeMultiplets && EndsInside(grid.eigenvalues, 0, count))
  {
    ++count;
  }
  return count;
}

/// Without a preconditioner, which is not needed where the list ends among the constants.
SpectralProblem<double> HatProblem(
  const HatHierarchy& hats, const Constants& constants, int threads)
{
  SpectralProblem<double> problem;
  problem.stiffness = hats.matrices.stiffness;
  problem.mass = hats.matrices.mass;
  problem.constants = &constants;
  problem.threads = threads;
  return problem;
}

/// About the lowest value: far above it, a shift would cost digits; far below, as by the values
/// that rounding gives a piece without an area, constants would drown all else.
double LowestValue(const Spectrum& grid)
{
  constexpr double Rounding = 1e-10;
  const double zero = grid.eigenvalues.empty() ? 0.0 : Rounding * grid.eigenvalues.back();
  const auto first = std::find_if(grid.eigenvalues.begin(), grid.eigenvalues.end(),
    [zero](double value) { return value > zero; });
  return first == grid.eigenvalues.end() ? 1.0 : *first;
}

/// The wanted pairs, at most `all`; more until the multiplet at their end is whole, if that is
/// asked for.
BlockReport FindPairs(const SpectralProblem<double>& problem, const SpectrumOptions& options,
  Index wanted, Index all, EigenPairs<double>& pairs, const Progress& progress)
{
  const Index zeros = problem.constants->Count();
  BlockReport report;
  double done = 0.0;
  BlockOptions block;
  block.tolerance = options.tolerance;
  block.wanted = std::min(wanted, all);
  for (Index found = 0; found < block.wanted;)
  {
    found = block.wanted;
    block.blockSize = std::min(GuardedSize(found), all);
    block.maximumIterations = pairs.vectors.Columns() < found
                                ? std::max(RandomStartIterations, options.maximumIterations)
                                : options.maximumIterations;
    report =
      ImproveManyEigenPairs<double>(problem, block, pairs, progress.Part(done, 0.5 + 0.5 * done));
    done = 0.5 + 0.5 * done;
    while (options.completeMultiplets && report.numberOfConverged == found &&
           EndsInside(pairs.values, zeros, block.wanted))
    {
      ++block.wanted;
    }
  }
  return report;
}

/// Relative errors as eigenvalues of the surface; 1 (unknown) where the grid has no such value.
std::vector<double> EstimateHatErrors(const std::vector<double>& hats, const Spectrum& grid)
{
  std::vector<double> errors(hats.size(), 0.0);
  for (std::size_t k = 0; k < hats.size(); ++k)
  {
    const double value = k < grid.eigenvalues.size() ? grid.eigenvalues[k] : 0.0;
    if (hats[k] > 0.0)
    {
      errors[k] = value > 0.0 ? std::min(1.0,
                                  grid.estimatedErrors[k] + std::max(0.0, hats[k] - value) / value)
                              : 1.0;
    }
  }
  return errors;
}

} // namespace

SpectrumOptions HatStartOptions(SpectrumOptions options)
{
  options.numberOfModes = GuardedSize(options.numberOfModes);
  options.tolerance = std::max(options.tolerance, GridTolerance);
  return options;
}

Spectrum ComputeHatSpectrum(const HatHierarchy& hats, const GridFunctions& space,
  const LevelOperators& system, const Spectrum& grid, const SpectrumOptions& options,
  const Progress& progress)
{
  const int threads = options.multigrid.threads;
  const Constants constants(
    hats.matrices.mass, hats.functions.component, hats.functions.numberOfComponents, threads);
  const Index zeros = constants.Count();
  const Index all = hats.functions.Count() - zeros;
  const Index listed = options.completeMultiplets ? zeros : std::min(zeros, options.numberOfModes);
  SpectralProblem<double> problem = HatProblem(hats, constants, threads);
  EigenPairs<double> pairs;
  BlockReport report;
  if (options.numberOfModes > zeros && all > 0)
  {
    problem.shift = LowestValue(grid);
    const Multigrid multigrid =
      BuildHatMultigrid(hats, space, system, problem.shift, 1.0, HatCycle(options.multigrid));
    problem.precondition = CyclePreconditioner<double>(multigrid, 0);
    progress.Check(0.1);
    pairs.vectors.Reserve(problem.mass.rows, grid.vectors.cols());
    pairs.vectors.Show(grid.vectors.cols());
    MultiplyBlock<double>(hats.prolongation, grid.vectors, pairs.vectors.View(), threads);
    constants.Remove<double>(pairs.vectors.View());
    report = FindPairs(
      problem, options, ListLength(grid, options) - zeros, all, pairs, progress.Part(0.1, 1.0));
  }
  Spectrum spectrum = CollectSpectrum(constants, listed, pairs, report, options.tolerance, problem);
  spectrum.estimatedErrors = EstimateHatErrors(spectrum.eigenvalues, grid);
  const auto others = static_cast<Index>(report.residuals.size());
  spectrum.truncated = static_cast<Index>(spectrum.eigenvalues.size()) < options.numberOfModes;
  spectrum.cutsMultiplet = listed < zeros || EndsInside(pairs.values, zeros, others);
  return spectrum;
}

Spectrum ComputeHatSpectrum(const HatHierarchy& hats, const GridFunctions& space,
  const LevelOperators& system, const SpectrumOptions& options, const Progress& progress)
{
  const Spectrum grid =
    ComputeSpectrum(space, system, HatStartOptions(options), progress.Part(0.0, 0.3));
  return ComputeHatSpectrum(hats, space, system, grid, options, progress.Part(0.3, 1.0));
}

} // namespace gridfem
