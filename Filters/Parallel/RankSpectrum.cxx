#include "Parallel/RankSpectrum.h"

#include "Krylov/LobpcgWindows.h"
#include "Parallel/RankEigenproblem.h"
#include "Problems/CollectSpectrum.h"
#include "Problems/SpectrumAccuracy.h"
#include "Problems/SpectrumList.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// As on one rank: the level below the finest also serves the estimate of the error.
constexpr double CoarseTolerance = 3e-4;
constexpr double SecondTolerance = 3e-5;
constexpr int CoarseIterations = 3;
constexpr int RandomStartIterations = 40;

/// An abort that one rank asks for is one of all: the others would wait for it.
Progress OfAll(const Communicator& ranks, const Progress& progress)
{
  return Progress(
    [ranks, progress](double fraction)
    {
      double wish = progress.Report(fraction) ? 0.0 : 1.0;
      ranks.Maximum(&wish, 1);
      return wish == 0.0;
    });
}

/// Pairs on their way from the shared levels to the finest one.
class RankIteration
{
public:
  RankIteration(const RankSpace& space, const SpectrumOptions& options)
    : space_(space), options_(options)
  {
  }

  Spectrum Run(const Progress& progress);

private:
  void SolveShared(Index count);
  void Prolong(std::size_t level, const RankEigenproblem& problem, BlockOptions& block);
  void Improve(std::size_t level, RankEigenproblem& problem, const Progress& progress);
  Spectrum Finish(RankEigenproblem& problem, Index wanted, const Progress& progress);
  BlockOptions Options(std::size_t level, Index wanted) const;

  const RankSpace& space_;
  const SpectrumOptions& options_;
  double shift_ = 0.0;
  Index zeros_ = 0;
  /// On the level before, of all functions that touch this rank's cells there.
  MultiVector coarse_;
  Index coarserConstants_ = 0; // of that level
  EigenPairs<double> pairs_;
};

/// The same on all ranks, which hold these levels whole.
void RankIteration::SolveShared(Index count)
{
  SpectrumOptions options = options_;
  options.numberOfModes = count;
  options.completeMultiplets = false;
  options.tolerance = SecondTolerance;
  Spectrum start;
  space_.Ranks().Together([&] { start = ComputeSpectrum(space_.Shared(), options); });
  const auto isZero = [](double value) { return value == 0.0; };
  coarserConstants_ = static_cast<Index>(
    std::find_if_not(start.eigenvalues.begin(), start.eigenvalues.end(), isZero) -
    start.eigenvalues.begin());
  const auto found = static_cast<Index>(start.eigenvalues.size()) - coarserConstants_;
  coarse_ = start.vectors.rightCols(found);
  pairs_.values =
    Eigen::Map<const Eigen::VectorXd>(start.eigenvalues.data() + coarserConstants_, found);
}

BlockOptions RankIteration::Options(std::size_t level, Index wanted) const
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

/// The spaces are nested, so that Ritz pairs stay what they are, but where components part.
void RankIteration::Prolong(std::size_t level, const RankEigenproblem& problem, BlockOptions& block)
{
  const Id columns = coarse_.cols();
  MultiVector fine;
  space_.Ranks().Together(
    [&]
    {
      Multiply(space_.Own().Prolongation(level), coarse_, fine, options_.multigrid.threads);
      pairs_.vectors.Reserve(problem.Rows(), std::max<Id>(columns, block.blockSize));
      pairs_.vectors.Show(columns);
      pairs_.vectors.View() = fine.bottomRows(problem.Rows()); // foreign functions come first
    });
  coarse_.resize(0, 0);
  problem.constants->Remove<double>(pairs_.vectors.View());
  pairs_.isRenewed = pairs_.isRenewed && problem.constants->Count() == coarserConstants_;
  block.minimumIterations = std::min(1, block.maximumIterations);
  if (columns < block.wanted)
  {
    block.maximumIterations = std::max(RandomStartIterations, block.maximumIterations);
  }
}

void RankIteration::Improve(std::size_t level, RankEigenproblem& problem, const Progress& progress)
{
  problem.SetShift(shift_);
  const Id functions = space_.Numberings()[level].total;
  BlockOptions block = this->Options(
    level, static_cast<Index>(std::min<Id>(options_.numberOfModes - zeros_, functions)));
  this->Prolong(level, problem, block);
  ImproveManyEigenPairs<double>(problem, block, pairs_, progress);
  coarse_ = problem.Spread(pairs_.vectors.View());
  coarserConstants_ = problem.constants->Count();
}

Spectrum RankIteration::Finish(RankEigenproblem& problem, Index wanted, const Progress& progress)
{
  const Eigen::VectorXd coarseValues = pairs_.values;
  BlockOptions block = this->Options(0, wanted);
  this->Prolong(0, problem, block);
  ListEnd end;
  end.zeros = zeros_;
  end.completeMultiplets = options_.completeMultiplets;
  const ListReport report = FinishList<double>(problem, block, end, pairs_, progress);
  const std::vector<double> errors =
    EstimateErrors(coarseValues, pairs_.values, report.block.residuals);
  Spectrum spectrum = CollectSpectrum<double>(
    *problem.constants, zeros_, pairs_, report.block, options_.tolerance, problem, progress);
  spectrum.estimatedErrors.insert(spectrum.estimatedErrors.end(), errors.begin(), errors.end());
  spectrum.estimatedErrors.resize(spectrum.eigenvalues.size());
  spectrum.cutsMultiplet = report.cutsMultiplet;
  return spectrum;
}

Spectrum RankIteration::Run(const Progress& progress)
{
  RankEigenproblem finest(space_, 0, options_.multigrid);
  zeros_ = std::min(finest.constants->Count(), options_.numberOfModes);
  Spectrum spectrum;
  if (zeros_ == options_.numberOfModes)
  {
    const bool isCut = finest.constants->Count() > zeros_ && !options_.completeMultiplets;
    zeros_ = options_.completeMultiplets ? finest.constants->Count() : zeros_;
    spectrum =
      CollectSpectrum<double>(*finest.constants, zeros_, pairs_, {}, options_.tolerance, finest);
    spectrum.cutsMultiplet = isCut;
  }
  else
  {
    const Index wanted = options_.numberOfModes - zeros_;
    shift_ = zeros_ * LowestValue(finest.Area(), space_.Own().Extent());
    this->SolveShared(zeros_ + GuardedSize(wanted));
    progress.Check(0.1);
    double done = 0.1;
    for (std::size_t level = space_.Numberings().size() - 1; level > 0; --level)
    {
      RankEigenproblem problem(space_, level, options_.multigrid);
      this->Improve(level, problem, progress.Part(done, done + 0.5 * (1.0 - done)));
      done += 0.5 * (1.0 - done);
    }
    finest.SetShift(shift_);
    spectrum = this->Finish(finest, wanted, progress.Part(done, 1.0));
    spectrum.truncated = static_cast<Index>(spectrum.eigenvalues.size()) < options_.numberOfModes;
  }
  spectrum.vectors = finest.Spread(spectrum.vectors);
  return spectrum;
}

} // namespace

Spectrum ComputeSpectrum(
  const RankSpace& space, const SpectrumOptions& options, const Progress& progress)
{
  Validate(options);
  if (space.Numberings().front().total == 0)
  {
    return {};
  }
  return RankIteration(space, options).Run(OfAll(space.Ranks(), progress));
}

} // namespace gridfem
