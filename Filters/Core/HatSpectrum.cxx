#include "HatSpectrum.h"

#include "CollectSpectrum.h"
#include "SpectrumAccuracy.h"
#include "WindowIteration.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Far below what the two discretisations differ by.
constexpr double GridTolerance = 1e-4;
constexpr int RandomStartIterations = 40;

/// The modes of the grid, with enough behind the wanted ones to keep the gap open.
Spectrum GridModes(const FunctionSpace& space, const System& system, SpectrumOptions options,
  const Progress& progress)
{
  options.numberOfModes = GuardedSize(options.numberOfModes);
  options.tolerance = std::max(options.tolerance, GridTolerance);
  options.completeMultiplets = false;
  return ComputeSpectrum(space, system, options, progress);
}

/// How many of the grid's modes make up the list.
Index ListLength(const Spectrum& grid, const SpectrumOptions& options)
{
  const auto modes = static_cast<Index>(grid.eigenvalues.size());
  Index count = std::min<Index>(options.numberOfModes, modes);
  while (options.completeMultiplets && count < modes &&
         IsMultiplet(grid.eigenvalues[count - 1], grid.eigenvalues[count], count))
  {
    ++count;
  }
  return count;
}

SpectralProblem HatProblem(
  const HatHierarchy& hats, const Constants& constants, double shift, const Multigrid& multigrid)
{
  SpectralProblem problem;
  problem.stiffness = hats.matrices.stiffness;
  problem.mass = hats.matrices.mass;
  problem.shift = shift;
  problem.constants = &constants;
  problem.threads = multigrid.Options().threads;
  problem.precondition = [&multigrid](const MultiVector& r, MultiVector& z)
  { CycleOnColumns(multigrid, 0, r, z); };
  return problem;
}

/// Relative differences from the values on the grid; 1 (unknown) where it has none.
std::vector<double> Differences(const std::vector<double>& hats, const std::vector<double>& grid)
{
  std::vector<double> difference(hats.size(), 1.0);
  for (std::size_t k = 0; k < std::min(hats.size(), grid.size()); ++k)
  {
    const double larger = std::max(hats[k], grid[k]);
    difference[k] = larger > 0.0 ? std::abs(hats[k] - grid[k]) / larger : 0.0;
  }
  return difference;
}

} // namespace

Spectrum ComputeHatSpectrum(const HatHierarchy& hats, const FunctionSpace& space,
  const System& system, const SpectrumOptions& options, const Progress& progress)
{
  const int threads = options.multigrid.threads;
  const Spectrum grid = GridModes(space, system, options, progress.Part(0.0, 0.3));
  const Constants constants(
    hats.matrices.mass, hats.functions.component, hats.functions.numberOfComponents, threads);
  const Index modes =
    std::min(std::max(options.numberOfModes, ListLength(grid, options)), hats.functions.Count());
  const Index zeros = std::min(constants.Count(), modes);
  EigenPairs pairs;
  BlockReport report;
  if (zeros < modes)
  {
    const auto first = std::find_if(
      grid.eigenvalues.begin(), grid.eigenvalues.end(), [](double value) { return value > 0.0; });
    // About the lowest value: far above it, a shift would cost digits.
    const double shift = first == grid.eigenvalues.end() ? 1.0 : *first;
    HatMultigridOptions cycle;
    cycle.grid = options.multigrid;
    const Multigrid multigrid = BuildHatMultigrid(hats, space, system, shift, 1.0, cycle);
    Multiply(hats.prolongation, grid.vectors, pairs.vectors, threads);
    constants.Remove(pairs.vectors);
    BlockOptions block;
    block.wanted = modes - zeros;
    block.blockSize = GuardedSize(block.wanted);
    block.tolerance = options.tolerance;
    block.maximumIterations = pairs.vectors.cols() < block.wanted
                                ? std::max(RandomStartIterations, options.maximumIterations)
                                : options.maximumIterations;
    report = ImproveManyEigenPairs(
      HatProblem(hats, constants, shift, multigrid), block, pairs, progress.Part(0.3, 1.0));
  }
  Spectrum spectrum = CollectSpectrum(constants, zeros, pairs, report, hats.matrices.mass, threads);
  spectrum.estimatedErrors = Differences(spectrum.eigenvalues, grid.eigenvalues);
  const auto found = static_cast<Index>(spectrum.eigenvalues.size());
  spectrum.truncated = found < options.numberOfModes;
  spectrum.cutsMultiplet =
    found - zeros < pairs.values.size() &&
    IsMultiplet(spectrum.eigenvalues.back(), pairs.values[found - zeros], found);
  return spectrum;
}

} // namespace gridfem
