#include "Spectrum/Spectrum.h"

#include "Algebra/BlockProducts.h"
#include "Algebra/BlockVectors.h"
#include "Base/LargeMemory.h"
#include "Equations/LevelProblem.h"
#include "Krylov/DenseSpectrum.h"
#include "Krylov/LobpcgWindows.h"
#include "Spectrum/CollectSpectrum.h"
#include "Spectrum/MassUnit.h"
#include "Spectrum/ModeMatch.h"
#include "Spectrum/SpectrumAccuracy.h"
#include "Spectrum/SpectrumCycle.h"
#include "Spectrum/SpectrumList.h"
#include "Spectrum/UnnestedSpectrum.h"

#include <cmath>
#include <limits>
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
  return !space.Distributed(level) && IsDense(space.NumberOfFunctions(level), blockSize);
}

/// The level where the iteration starts. If the finest level is solved densely, the levels below
/// only serve the error estimate. Otherwise it is the coarsest level with enough functions, or the
/// level below that one if it is too large for a dense solve.
std::size_t StartLevel(const SpaceLevels& space, Index blockSize)
{
  constexpr std::size_t ForTheEstimate = 2;
  const std::size_t levels = space.NumberOfLevels();
  const auto size = [&](std::size_t l) { return space.NumberOfFunctions(l); };
  if (CanBeDense(space, 0, blockSize))
  {
    return std::min(ForTheEstimate, levels - 1);
  }
  std::size_t level = 0;
  while (level + 1 < levels && (!CanBeDense(space, level, blockSize) ||
                                 (level > 0 && size(level + 1) >= 1.5 * blockSize)))
  {
    ++level;
  }
  return level;
}

/// The share of a level in the progress. Work grows by less than four per level, because pairs of
/// coarser levels start those of finer levels.
Progress LevelPart(const Progress& progress, std::size_t level)
{
  constexpr double setUp = 0.1;
  constexpr double Coarser = 0.4; // measured on scans with 10 to 400 modes
  const double begin = std::pow(Coarser, static_cast<double>(level) + 1.0);
  const double end = std::pow(Coarser, static_cast<double>(level));
  return progress.Part(setUp + (1.0 - setUp) * begin, setUp + (1.0 - setUp) * end);
}

/// The result of a list that ends among the constants.
Spectrum OnlyConstants(const Constants& zeroModes, const SpectralProblem<double>& problem,
  const SpectrumOptions& options)
{
  EigenPairs<double> none;
  Eigen::MatrixXd nothing;
  Spectrum spectrum = CollectSpectrum(
    zeroModes, options.numberOfModes, none, {}, options.tolerance, problem, nothing);
  spectrum.cutsMultiplet = zeroModes.Count() > options.numberOfModes;
  return spectrum;
}

/// The nested iteration with blocks of one precision, and the data that its levels share.
template<class Real>
class NestedIteration
{
public:
  /// @param unit   of the mass
  /// @param shift  of the problem with that mass
  NestedIteration(const SpaceLevels& space, const SpectrumOptions& options, SpectrumCycle& cycle,
    double unit, double shift)
    : space_(space), options_(options), cycle_(cycle), unit_(unit), shift_(shift)
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
  void Compare(std::size_t level, const SpectralProblem<Real>& problem);
  Eigen::MatrixXd Errors(const BlockReport& report) const;
  BlockReport FinishList(
    const SpectralProblem<Real>& problem, const BlockOptions& block, const Progress& progress);

  const SpaceLevels& space_;
  const SpectrumOptions& options_;
  SpectrumCycle& cycle_;
  const double unit_;
  const double shift_;
  Index zeros_ = 0;
  Index coarserConstants_ = 0; // number on the level that the pairs come from
  EigenPairs<Real> pairs_;
  EigenPairs<Real> coarser_; // of the next coarser level
  /// The values of each pair on the next coarser levels, one column for each of at most two levels.
  Eigen::MatrixXd valuesBelow_;
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
  const Id columns = coarser_.vectors.Columns();
  pairs_.vectors.Reserve(P.rows, std::max<Id>(columns, block.blockSize));
  pairs_.vectors.Show(columns);
  MultiplyBlock<Real>(
    P, coarser_.vectors.View(), pairs_.vectors.View(), options_.multigrid.threads);
  constants.Remove<Real>(pairs_.vectors.View());
  pairs_.values = coarser_.values;
  pairs_.isRenewed = coarser_.isRenewed && constants.Count() == coarserConstants_;
  block.minimumIterations = std::min(1, block.maximumIterations);
  if (columns < block.wanted)
  {
    block.maximumIterations = std::max(RandomStartIterations, block.maximumIterations);
  }
}

/// Finds the values that the next coarser levels have for the pairs.
template<class Real>
void NestedIteration<Real>::Compare(std::size_t level, const SpectralProblem<Real>& problem)
{
  Eigen::MatrixXd below(coarser_.values.size(), 2);
  below.col(0) = coarser_.values;
  below.col(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  if (valuesBelow_.cols() > 0)
  {
    below.col(1) = valuesBelow_.col(0);
  }
  const SharedMatrix prolongation = space_.Prolongation(level);
  valuesBelow_ = MatchNumbers<Real>(
    problem, pairs_.vectors.View(), prolongation, coarser_.vectors.View(), below);
  coarser_ = {};
}

/// Completes the list. If a dense solve has fewer values than the block has room for, there are no
/// others.
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
  const bool isFirst = level == start;
  if (!isFirst)
  {
    coarser_ = std::move(pairs_);
    pairs_ = {};
  }
  BlockOptions block = this->Options(level, std::min(options_.numberOfModes - zeros_, functions));
  if ((isFirst || level == 0) && CanBeDense(space_, level, block.blockSize))
  {
    pairs_ = SolveDense<Real>(problem, block.blockSize);
    isDense_ = level == 0;
    if (level > 0)
    {
      return {};
    }
  }
  else if (!isFirst)
  {
    this->Prolong(level, *problem.constants, block);
  }
  else // thousands of components: no level is small, but B is nearly exact there
  {
    block.maximumIterations = std::max(RandomStartIterations, options_.maximumIterations);
  }
  const BlockReport report = level == 0
                               ? this->FinishList(problem, block, progress)
                               : ImproveManyEigenPairs<Real>(problem, block, pairs_, progress);
  if (!isFirst)
  {
    this->Compare(level, problem);
  }
  return report;
}

/// The error and the trust (0 or 1) of each pair in the report.
template<class Real>
Eigen::MatrixXd NestedIteration<Real>::Errors(const BlockReport& report) const
{
  ValuesOnLevels values;
  values.finest = pairs_.values;
  values.next.setConstant(pairs_.values.size(), std::numeric_limits<double>::quiet_NaN());
  values.afterNext = values.next;
  if (valuesBelow_.cols() > 0)
  {
    values.next = valuesBelow_.col(0);
    values.afterNext = valuesBelow_.col(1);
  }
  const EigenvalueErrors errors = EstimateErrors(values, report.residuals);
  Eigen::MatrixXd ofPairs(static_cast<Id>(errors.relative.size()), 2);
  for (Id k = 0; k < ofPairs.rows(); ++k)
  {
    ofPairs.row(k) << errors.relative[k], errors.isTrusted[k] ? 1.0 : 0.0;
  }
  return ofPairs;
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
    DivideBy(unit_, levelMass);
    const Constants constants = ConstantsOnLevel(space_, level, levelMass, threads);
    const SpectralProblem<Real> problem = this->Problem(level, constants, std::move(levelMass));
    this->ImproveLevel(level, start, problem, LevelPart(progress, level));
    coarserConstants_ = constants.Count();
  }
  const SpectralProblem<Real> problem = this->Problem(0, zeroModes, std::move(mass));
  const BlockReport report = this->ImproveLevel(0, start, problem, LevelPart(progress, 0));
  Eigen::MatrixXd errors = this->Errors(report);
  Spectrum spectrum = CollectSpectrum(
    zeroModes, zeros_, pairs_, report, options_.tolerance, problem, errors, progress);
  for (const auto& error : errors.rowwise())
  {
    spectrum.estimatedErrors.push_back(error[0]);
    spectrum.isErrorTrusted.push_back(error[1] != 0.0);
  }
  spectrum.truncated = static_cast<Index>(spectrum.eigenvalues.size()) < options_.numberOfModes;
  spectrum.cutsMultiplet = cutsMultiplet_;
  spectrum.singlePrecision = cycle_.IsSingle();
  spectrum.where = cycle_.Where();
  return spectrum;
}

/// Approximate lowest value above 0 of the problem with the mass over the unit.
double ShiftFor(
  const SpaceLevels& space, const SparseMatrix& mass, Index constants, double unit, int threads)
{
  const bool isUnusual = unit != 1.0 || IsStretched(space, mass, threads);
  const double lowest = isUnusual ? LowestOnCoarsest(space, unit, threads) : 0.0;
  if (lowest > 0.0)
  {
    return lowest;
  }
  double area = std::accumulate(mass.value.begin(), mass.value.end(), 0.0);
  if (space.Distributed(0))
  {
    space.Distributed(0)->SumNumbers(&area, 1);
  }
  return std::max<Index>(1, constants) * LowestValue(area, space.Extent());
}

/// @param mass  of the finest level, over the unit
Spectrum IterateOnLevels(const SpaceLevels& space, const SpectrumOptions& options,
  const Constants& zeroModes, SparseMatrix mass, double unit, const Progress& progress)
{
  const int threads = options.multigrid.threads;
  const double shift = ShiftFor(space, mass, zeroModes.Count(), unit, threads);
  SpectrumCycle cycle(space, shift / unit, options.multigrid, progress.Part(0.0, 0.1));
  const bool wasSingle = cycle.IsSingle() && options.tolerance >= SmallestSingleTolerance;
  if (wasSingle)
  {
    SpectrumOptions few = options;
    few.maximumIterations = std::min(options.maximumIterations, SingleIterations);
    Spectrum spectrum = NestedIteration<float>(space, few, cycle, unit, shift)
                          .Run(zeroModes, std::move(mass), progress.Part(0.0, 0.99));
    const bool isLost = !spectrum.eigenvalues.empty() && std::isnan(spectrum.eigenvalues.back());
    if (!isLost && (spectrum.converged || options.maximumIterations <= SingleIterations))
    {
      return spectrum;
    }
    mass = space.Matrix(0, 1.0, 0.0, threads);
    DivideBy(unit, mass);
  }
  return NestedIteration<double>(space, options, cycle, unit, shift)
    .Run(zeroModes, std::move(mass), progress.Part(wasSingle ? 0.99 : 0.0, 1.0));
}

} // namespace

Spectrum ComputeOnNestedLevels(
  const SpaceLevels& space, const SpectrumOptions& options, const Progress& progress)
{
  Validate(options);
  const MemoryReuse reuse; // the blocks of a level reuse the memory of the level before
  const int threads = options.multigrid.threads;
  const double unit = MassUnit(space, threads);
  SparseMatrix mass = space.Matrix(0, 1.0, 0.0, threads);
  DivideBy(unit, mass);
  const Constants zeroModes = ConstantsOnLevel(space, 0, mass, threads);
  Spectrum spectrum;
  if (zeroModes.Count() >= options.numberOfModes)
  {
    spectrum = OnlyConstants(
      zeroModes, ProblemOnLevel<double>(space, 0, zeroModes, std::move(mass), threads), options);
  }
  else
  {
    spectrum = IterateOnLevels(space, options, zeroModes, std::move(mass), unit, progress);
  }
  ConvertUnit(unit, 1.0, spectrum);
  return spectrum;
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
  const SpaceLevels& space, const SpectrumOptions& options, const Progress& progress)
{
  const SpaceLevels* nested = space.NestedLevels();
  return nested ? ComputeOnNestedLevels(*nested, StartOptions(options), progress)
                : ComputeOnNestedLevels(space, options, progress);
}

Spectrum FinishSpectrum(const SpaceLevels& space, Spectrum nested, const SpectrumOptions& options,
  const Progress& progress)
{
  return space.NestedLevels() ? ImproveSpectrum(space, std::move(nested), options, progress)
                              : std::move(nested);
}

Spectrum ComputeSpectrum(
  const SpaceLevels& space, const SpectrumOptions& options, const Progress& progress)
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
