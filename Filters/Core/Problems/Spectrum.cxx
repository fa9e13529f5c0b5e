#include "Problems/Spectrum.h"

#include "Algebra/BlockProducts.h"
#include "Algebra/BlockVectors.h"
#include "Base/LargeMemory.h"
#include "Krylov/DenseSpectrum.h"
#include "Krylov/LobpcgWindows.h"
#include "Problems/CollectSpectrum.h"
#include "Problems/LevelProblem.h"
#include "Problems/SpectrumAccuracy.h"
#include "Problems/SpectrumCycle.h"
#include "Problems/SpectrumList.h"
#include "Problems/UnnestedSpectrum.h"

#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

/// Accuracy of the eigenvalues on coarser levels, whose discretization error is far larger. The
/// level below the finest also serves the error estimate.
constexpr double CoarseTolerance = 3e-4;
constexpr double SecondTolerance = 3e-5;
constexpr int CoarseIterations = 3;

/// Smallest wanted error with blocks in single precision. Rounding the blocks makes an error of
/// 1e-14 times the ratio of the largest to the lowest eigenvalue, which is below 1e-9 at depth 8.
constexpr double SmallestSingleTolerance = 1e-7;

/// Steps in single precision. If they do not suffice, everything is repeated in double precision.
constexpr int SingleIterations = 40;

/// Whether a level can be solved densely. A level that processes divide cannot, because no process
/// has its matrices.
bool CanBeDense(const SpaceLevels& space, std::size_t level, Index blockSize)
{
  return !space.Divided(level) && IsDense(space.NumberOfFunctions(level), blockSize);
}

/// The level where the iteration starts. If the finest level is solved densely, it is the level
/// below. Otherwise it is the coarsest level with enough functions, or the level below that one if
/// it is too large for a dense solve.
std::size_t StartLevel(const SpaceLevels& space, Index blockSize)
{
  const std::size_t levels = space.NumberOfLevels();
  const auto size = [&](std::size_t l) { return space.NumberOfFunctions(l); };
  if (CanBeDense(space, 0, blockSize))
  {
    return std::min<std::size_t>(1, levels - 1);
  }
  std::size_t level = 0;
  while (level + 1 < levels && (!CanBeDense(space, level, blockSize) ||
                                 (level > 0 && size(level + 1) >= 1.5 * blockSize)))
  {
    ++level;
  }
  return level;
}

void Append(std::vector<double>& list, const std::vector<double>& more)
{
  list.insert(list.end(), more.begin(), more.end());
}

/// The share of a level in the progress. Work grows by four per level.
Progress LevelPart(const Progress& progress, std::size_t level)
{
  const double setUp = 0.1;
  const double begin = std::pow(0.25, static_cast<double>(level) + 1.0);
  const double end = std::pow(0.25, static_cast<double>(level));
  return progress.Part(setUp + (1.0 - setUp) * begin, setUp + (1.0 - setUp) * end);
}

/// The result of a list that ends among the constants.
Spectrum OnlyConstants(const Constants& zeroModes, const SpectralProblem<double>& problem,
  const SpectrumOptions& options)
{
  EigenPairs<double> none;
  Spectrum spectrum =
    CollectSpectrum(zeroModes, options.numberOfModes, none, {}, options.tolerance, problem);
  spectrum.cutsMultiplet = zeroModes.Count() > options.numberOfModes;
  return spectrum;
}

/// The nested iteration with blocks of one precision, and the data that its levels share.
template<class Real>
class NestedIteration
{
public:
  NestedIteration(
    const SpaceLevels& space, const SpectrumOptions& options, SpectrumCycle& cycle, double shift)
    : space_(space), options_(options), cycle_(cycle), shift_(shift)
  {
  }

  Spectrum Run(const Constants& zeroModes, SparseMatrix mass, const Progress& progress);

private:
  BlockOptions Options(std::size_t level, Index wanted) const;
  SpectralProblem<Real> Problem(
    std::size_t level, const Constants& constants, SparseMatrix&& mass) const;
  BlockReport ImproveLevel(std::size_t level, std::size_t start,
    const SpectralProblem<Real>& problem, const Progress& progress);
  void Prolong(std::size_t level, const Constants& constants, BlockOptions& block);
  BlockReport FinishList(
    const SpectralProblem<Real>& problem, const BlockOptions& block, const Progress& progress);

  const SpaceLevels& space_;
  const SpectrumOptions& options_;
  SpectrumCycle& cycle_;
  const double shift_;
  Index zeros_ = 0;
  Index coarserConstants_ = 0; // number on the level that the pairs come from
  EigenPairs<Real> pairs_;
  bool isDense_ = false; // the finest level was solved densely
  bool cutsMultiplet_ = false;
};

template<class Real>
SpectralProblem<Real> NestedIteration<Real>::Problem(
  std::size_t level, const Constants& constants, SparseMatrix&& mass) const
{
  SpectralProblem<Real> problem =
    ProblemOnLevel<Real>(space_, level, constants, std::move(mass), options_.multigrid.threads);
  problem.shift = shift_;
  problem.preconditioner = cycle_.From<Real>(level);
  return problem;
}

template<class Real>
BlockOptions NestedIteration<Real>::Options(std::size_t level, Index wanted) const
{
  BlockOptions block;
  block.wanted = wanted;
  block.blockSize = GuardedSize(wanted);
  block.tolerance = level == 0   ? options_.tolerance
                    : level == 1 ? SecondTolerance
                                 : CoarseTolerance;
  block.measureLast = level == 0;
  block.maximumIterations = level == 0 ? options_.maximumIterations
                                       : std::min(CoarseIterations, options_.maximumIterations);
  return block;
}

/// Brings the pairs to a finer level. They stay Ritz pairs, because the spaces are nested. The
/// exception is a component of the coarser level that splits, because plain functions ignore
/// connectivity. The finer level then has more constants to take out.
template<class Real>
void NestedIteration<Real>::Prolong(
  std::size_t level, const Constants& constants, BlockOptions& block)
{
  const SharedMatrix prolongation = space_.Prolongation(level);
  const SparseMatrix& P = prolongation;
  BlockBuffer<Real> coarse;
  std::swap(coarse, pairs_.vectors);
  const Id columns = coarse.Columns();
  pairs_.vectors.Reserve(P.rows, std::max<Id>(columns, block.blockSize));
  pairs_.vectors.Show(columns);
  MultiplyBlock<Real>(P, coarse.View(), pairs_.vectors.View(), options_.multigrid.threads);
  constants.Remove<Real>(pairs_.vectors.View());
  pairs_.isRenewed = pairs_.isRenewed && constants.Count() == coarserConstants_;
  block.minimumIterations = std::min(1, block.maximumIterations);
  if (columns < block.wanted)
  {
    block.maximumIterations = std::max(RandomStartIterations, block.maximumIterations);
  }
}

/// Completes the list. Values of a dense solve are all there are if they are fewer than the block
/// has room for.
template<class Real>
BlockReport NestedIteration<Real>::FinishList(
  const SpectralProblem<Real>& problem, const BlockOptions& block, const Progress& progress)
{
  ListEnd end;
  end.zeros = zeros_;
  end.isAll = isDense_ && pairs_.values.size() < block.blockSize;
  end.completeMultiplets = options_.completeMultiplets;
  const ListReport report = gridfem::FinishList(problem, block, end, pairs_, progress);
  cutsMultiplet_ = report.cutsMultiplet;
  return report.block;
}

/// Computes the pairs of a level from the pairs of the next coarser level, or from nothing on level
/// `start`.
template<class Real>
BlockReport NestedIteration<Real>::ImproveLevel(std::size_t level, std::size_t start,
  const SpectralProblem<Real>& problem, const Progress& progress)
{
  // No level has more pairs than functions; room for more would only cost memory.
  const Index functions = space_.NumberOfFunctions(level);
  BlockOptions block = this->Options(level, std::min(options_.numberOfModes - zeros_, functions));
  if ((level == start || level == 0) && CanBeDense(space_, level, block.blockSize))
  {
    pairs_ = SolveDense<Real>(problem, block.blockSize);
    isDense_ = level == 0;
    if (level > 0)
    {
      return {};
    }
  }
  else if (level != start)
  {
    this->Prolong(level, *problem.constants, block);
  }
  else // thousands of components: no level is small, but B is nearly exact there
  {
    block.maximumIterations = std::max(RandomStartIterations, options_.maximumIterations);
  }
  return level == 0 ? this->FinishList(problem, block, progress)
                    : ImproveManyEigenPairs<Real>(problem, block, pairs_, progress);
}

template<class Real>
Spectrum NestedIteration<Real>::Run(
  const Constants& zeroModes, SparseMatrix mass, const Progress& progress)
{
  const int threads = options_.multigrid.threads;
  zeros_ = zeroModes.Count();
  const Index blockSize = GuardedSize(options_.numberOfModes - zeros_);
  const std::size_t start = StartLevel(space_, blockSize);
  for (std::size_t level = start; level > 0; --level)
  {
    SparseMatrix levelMass = space_.Matrix(level, 1.0, 0.0, threads);
    const Constants constants = ConstantsOnLevel(space_, level, levelMass, threads);
    const SpectralProblem<Real> problem = this->Problem(level, constants, std::move(levelMass));
    this->ImproveLevel(level, start, problem, LevelPart(progress, level));
    coarserConstants_ = constants.Count();
  }
  const Eigen::VectorXd coarseValues = pairs_.values;
  const SpectralProblem<Real> problem = this->Problem(0, zeroModes, std::move(mass));
  const BlockReport report = this->ImproveLevel(0, start, problem, LevelPart(progress, 0));
  const std::vector<double> errors = EstimateErrors(coarseValues, pairs_.values, report.residuals);
  Spectrum spectrum =
    CollectSpectrum(zeroModes, zeros_, pairs_, report, options_.tolerance, problem, progress);
  Append(spectrum.estimatedErrors, errors);
  // The dropped pairs without mass are the last, because their values are the largest.
  spectrum.estimatedErrors.resize(spectrum.eigenvalues.size());
  spectrum.truncated = static_cast<Index>(spectrum.eigenvalues.size()) < options_.numberOfModes;
  spectrum.cutsMultiplet = cutsMultiplet_;
  spectrum.singlePrecision = cycle_.IsSingle();
  return spectrum;
}

} // namespace

Spectrum ComputeOnNestedLevels(
  const SpaceLevels& space, const SpectrumOptions& options, const Progress& progress)
{
  Validate(options);
  const MemoryReuse reuse; // the blocks of a level reuse the memory of the level before
  const int threads = options.multigrid.threads;
  SparseMatrix mass = space.Matrix(0, 1.0, 0.0, threads);
  const Constants zeroModes = ConstantsOnLevel(space, 0, mass, threads);
  if (zeroModes.Count() >= options.numberOfModes)
  {
    return OnlyConstants(
      zeroModes, ProblemOnLevel<double>(space, 0, zeroModes, std::move(mass), threads), options);
  }
  double area = std::accumulate(mass.value.begin(), mass.value.end(), 0.0);
  if (space.Divided(0))
  {
    space.Divided(0)->SumNumbers(&area, 1);
  }
  const double shift = zeroModes.Count() * LowestValue(area, space.Extent());
  SpectrumCycle cycle(space, shift, options.multigrid, progress.Part(0.0, 0.1));
  const bool wasSingle = cycle.IsSingle() && options.tolerance >= SmallestSingleTolerance;
  if (wasSingle)
  {
    SpectrumOptions few = options;
    few.maximumIterations = std::min(options.maximumIterations, SingleIterations);
    Spectrum spectrum = NestedIteration<float>(space, few, cycle, shift)
                          .Run(zeroModes, std::move(mass), progress.Part(0.0, 0.99));
    const bool isLost = !spectrum.eigenvalues.empty() && std::isnan(spectrum.eigenvalues.back());
    if (!isLost && (spectrum.converged || options.maximumIterations <= SingleIterations))
    {
      return spectrum;
    }
    mass = space.Matrix(0, 1.0, 0.0, threads);
  }
  return NestedIteration<double>(space, options, cycle, shift)
    .Run(zeroModes, std::move(mass), progress.Part(wasSingle ? 0.99 : 0.0, 1.0));
}

void Validate(const SpectrumOptions& options)
{
  if (options.numberOfModes < 1)
  {
    throw InvalidInput("The number of modes must be at least 1.");
  }
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0))
  {
    throw InvalidInput("The tolerance of the spectrum must lie between 0 and 1.");
  }
  if (options.maximumIterations < 0)
  {
    throw InvalidInput("The number of iterations must not be negative.");
  }
  if (options.multigrid.preSweeps != options.multigrid.postSweeps)
  {
    throw InvalidInput(
      "The cycles of a spectrum need equally many sweeps before and after the correction.");
  }
}

Spectrum ComputeNestedSpectrum(
  const SurfaceSpace& space, const SpectrumOptions& options, const Progress& progress)
{
  const SurfaceSpace* nested = space.NestedLevels();
  return nested ? ComputeOnNestedLevels(*nested, StartOptions(options), progress)
                : ComputeOnNestedLevels(space, options, progress);
}

Spectrum FinishSpectrum(const SurfaceSpace& space, Spectrum nested, const SpectrumOptions& options,
  const Progress& progress)
{
  return space.NestedLevels() ? ImproveSpectrum(space, nested, options, progress)
                              : std::move(nested);
}

Spectrum ComputeSpectrum(
  const SurfaceSpace& space, const SpectrumOptions& options, const Progress& progress)
{
  const double split = space.NestedLevels() ? 0.3 : 1.0;
  return FinishSpectrum(space, ComputeNestedSpectrum(space, options, progress.Part(0.0, split)),
    options, progress.Part(split, 1.0));
}

double EstimateSpectrumMemory(Id functions, Id modes, int threads)
{
  // Bytes per function, fitted to the growth of the process (Testing/Benchmarks, group `memory`).
  // Two matrices with 18 entries per row, and a hierarchy of floats and factors.
  constexpr double matrices = 850.0;
  constexpr double panels = 512.0; // of each active cycle: 4 panels of 32 floats
  const Id columns = std::min(functions, modes);
  const Id cycles =
    std::min<Id>(NumberOfThreads(threads), (columns + WidestPanel - 1) / WidestPanel);
  const double blocks = sizeof(float) * double(HeldColumns(static_cast<Index>(columns)));
  const double result = double(sizeof(float) + sizeof(double)) * double(columns);
  const double products = sizeof(double) * double(columns) * double(columns); // of all mode pairs
  return double(functions) * (matrices + panels * double(cycles) + std::max(blocks, result)) +
         products;
}

double EstimateSpectrumSeconds(Id functions, Id modes, int threads)
{
  constexpr double secondsOfOneThread = 1e-9; // per function and pair of modes (Testing/Benchmarks)
  const double columns = double(std::min(functions, modes));
  return secondsOfOneThread * double(functions) * columns * columns / NumberOfThreads(threads);
}

} // namespace gridfem
