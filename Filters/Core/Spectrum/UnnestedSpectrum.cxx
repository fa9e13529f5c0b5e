#include "Spectrum/UnnestedSpectrum.h"

#include "Algebra/BlockProducts.h"
#include "Equations/LevelProblem.h"
#include "Krylov/LobpcgWindows.h"
#include "Multigrid/BlockPreconditioner.h"
#include "Spectrum/CollectSpectrum.h"
#include "Spectrum/MassUnit.h"
#include "Spectrum/ModeMatch.h"
#include "Spectrum/SpectrumAccuracy.h"
#include "Spectrum/SpectrumList.h"

#include <algorithm>
#include <memory>

namespace gridfem
{
namespace
{

/// Far below the difference of the two discretizations.
constexpr double StartTolerance = 1e-4;

/// Whether the value behind the first `count` belongs to the multiplet of the last of them.
/// @param before  number of values before these
template<class Values>
bool EndsInside(const Values& values, Index before, Index count)
{
  return count > 0 && count < static_cast<Index>(values.size()) &&
         IsMultiplet(values[count - 1], values[count], before + count);
}

/// The number of the start's modes that form the list.
Index ListLength(const Spectrum& start, const SpectrumOptions& options)
{
  Index count = options.numberOfModes;
  while (options.completeMultiplets && EndsInside(start.eigenvalues, 0, count))
  {
    ++count;
  }
  return count;
}

/// Approximate lowest value, used as the shift. A shift far above it would cost digits. With a
/// shift far below it, constants would drown everything else; rounding gives such values to a piece
/// without an area.
double LowestValue(const Spectrum& start)
{
  constexpr double Rounding = 1e-10;
  const double zero = start.eigenvalues.empty() ? 0.0 : Rounding * start.eigenvalues.back();
  const auto first = std::find_if(start.eigenvalues.begin(), start.eigenvalues.end(),
    [zero](double value) { return value > zero; });
  return first == start.eigenvalues.end() ? 1.0 : *first;
}

/// Removes constants from the columns. A column that was constant leaves only rounding, which may
/// be constant again. Scaled, it would count as one more mode, so it becomes zero.
void RemoveConstants(
  const Constants& constants, const DistributedRows* distributed, Block<double> columns)
{
  constexpr double Rounding = 1e-10;
  const auto norms = [&]
  {
    Eigen::RowVectorXd squares =
      columns.bottomRows(columns.rows() - GhostRows(distributed)).colwise().squaredNorm();
    SumOverProcesses(distributed, squares);
    return Eigen::RowVectorXd(squares.cwiseSqrt());
  };
  const Eigen::RowVectorXd before = norms();
  constants.Remove<double>(columns);
  const Eigen::RowVectorXd left = norms();
  for (Id c = 0; c < columns.cols(); ++c)
  {
    if (left[c] <= Rounding * before[c])
    {
      columns.col(c).setZero();
    }
  }
}

/// One cycle, and a cycle with factors in double precision as its fallback. The latter is made
/// once.
/// @param isDouble  becomes true when the fallback is made
WithFallback<BlockPreconditioner<double>> BlockCycleWithFallback(
  const Multigrid& multigrid, bool& isDouble)
{
  WithFallback<BlockPreconditioner<double>> B{ CyclePreconditioner<double>(multigrid, 0), {} };
  if (multigrid.HasSingleFactors())
  {
    B.makeDouble = [&multigrid, &isDouble, inDouble = std::shared_ptr<const Multigrid>()]() mutable
    {
      if (!inDouble)
      {
        inDouble = std::make_shared<const Multigrid>(multigrid.InDoublePrecision());
        isDouble = true;
      }
      return CyclePreconditioner<double>(*inDouble, 0);
    };
  }
  return B;
}

/// Finds the wanted pairs, at most `all`. If asked to, it adds pairs until the multiplet at the end
/// is complete.
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
    const double next = AfterRound(done);
    report = ImproveManyEigenPairs<double>(problem, block, pairs, progress.Part(done, next));
    done = next;
    while (options.completeMultiplets && report.numberOfConverged == found &&
           EndsInside(pairs.values, zeros, block.wanted))
    {
      ++block.wanted;
    }
  }
  return report;
}

/// Returns, for each pair, the value, the error and the trust (0 or 1) of the same mode of the
/// start. They are NaN if the start has no such mode.
Eigen::MatrixXd MatchStart(const SpectralProblem<double>& problem, const EigenPairs<double>& pairs,
  const SparseMatrix& prolongation, const Spectrum& start)
{
  Eigen::MatrixXd numbers(start.vectors.cols(), 3);
  for (Id k = 0; k < numbers.rows(); ++k)
  {
    numbers.row(k) << start.eigenvalues[k], start.estimatedErrors[k],
      start.isErrorTrusted[k] ? 1.0 : 0.0;
  }
  return MatchNumbers<double>(problem, pairs.vectors.View(), prolongation, start.vectors, numbers);
}

/// Adds relative errors as eigenvalues of the surface; 1 (unknown) if the start has no such mode.
/// @param matched  as MatchStart returns them, for the values behind the constants
void AddErrorsBeyond(const Eigen::MatrixXd& matched, Spectrum& spectrum)
{
  const std::size_t zeros = spectrum.estimatedErrors.size();
  for (std::size_t k = zeros; k < spectrum.eigenvalues.size(); ++k)
  {
    const auto mode = static_cast<Id>(k - zeros);
    const double below = matched(mode, 0);
    const double excess = std::max(0.0, spectrum.eigenvalues[k] - below) / below;
    const bool isKnown = below > 0.0; // not NaN
    spectrum.estimatedErrors.push_back(isKnown ? std::min(1.0, matched(mode, 1) + excess) : 1.0);
    spectrum.isErrorTrusted.push_back(isKnown && matched(mode, 2) > 0.9);
  }
}

} // namespace

SpectrumOptions StartOptions(SpectrumOptions options)
{
  options.numberOfModes = GuardedSize(options.numberOfModes);
  options.tolerance = std::max(options.tolerance, StartTolerance);
  return options;
}

Spectrum ImproveSpectrum(const SpaceLevels& space, Spectrum start, const SpectrumOptions& options,
  const Progress& progress)
{
  const int threads = options.multigrid.threads;
  const double unit = MassUnit(*space.NestedLevels(), threads);
  ConvertUnit(1.0, unit, start);
  SparseMatrix mass = space.Matrix(0, 1.0, 0.0, threads);
  DivideBy(unit, mass);
  const Constants constants = ConstantsOnLevel(space, 0, mass, threads);
  const Index zeros = constants.Count();
  const Index all = space.NumberOfFunctions(0) - zeros;
  const Index listed = std::min<Index>(zeros, options.numberOfModes);
  SpectralProblem<double> problem =
    ProblemOnLevel<double>(space, 0, constants, std::move(mass), threads);
  EigenPairs<double> pairs;
  BlockReport report;
  Eigen::MatrixXd matched;
  std::string where;
  if (options.numberOfModes > zeros && all > 0)
  {
    problem.shift = LowestValue(start);
    const Multigrid multigrid = BuildMultigrid(space, problem.shift / unit, 1.0, options.multigrid);
    bool isDouble = false;
    problem.preconditioner = BlockCycleWithFallback(multigrid, isDouble);
    progress.Check(0.1);
    pairs.vectors.Reserve(problem.mass.rows, start.vectors.cols());
    pairs.vectors.Show(start.vectors.cols());
    const SharedMatrix prolongation = space.Prolongation(0);
    MultiplyBlock<double>(prolongation, start.vectors, pairs.vectors.View(), threads);
    SumProlonged<double>(space.Distributed(0), pairs.vectors.View());
    RemoveConstants(constants, space.Distributed(0), pairs.vectors.View());
    report = FindPairs(
      problem, options, ListLength(start, options) - zeros, all, pairs, progress.Part(0.1, 1.0));
    matched = MatchStart(problem, pairs, prolongation, start);
    where =
      isDouble && multigrid.OnDevice() ? "CPU: the modes need double precision" : multigrid.Where();
  }
  Spectrum spectrum =
    CollectSpectrum(constants, listed, pairs, report, options.tolerance, problem, matched);
  AddErrorsBeyond(matched, spectrum);
  spectrum.where = where;
  const auto others = static_cast<Index>(report.residuals.size());
  spectrum.truncated = static_cast<Index>(spectrum.eigenvalues.size()) < options.numberOfModes;
  spectrum.cutsMultiplet = listed < zeros || EndsInside(pairs.values, zeros, others);
  ConvertUnit(unit, 1.0, spectrum);
  return spectrum;
}

} // namespace gridfem
