#include "Krylov/LobpcgWindows.h"

#include "Base/Parallel.h"

#include <algorithm>
#include <numeric>

namespace gridfem
{
namespace
{

/// Blocks up to this size are not cut into windows.
constexpr Index LargestBlock = 160;

/// Wanted pairs of one window, at most, and the additional pairs. There are many of them, because
/// the gap is relatively small inside the spectrum.
constexpr Index WindowSize = 112;
constexpr Index WindowGuard = 32;

/// Wanted pairs of the next window. All windows get about the same size.
Index NextWindowSize(Index left)
{
  const Index windows = (left + WindowSize - 1) / WindowSize;
  return (left + windows - 1) / windows;
}

/// The windows found so far, and the start vectors that are left. Both share one block. The found
/// windows never need more columns than were already taken out of the block. More room is needed
/// only beyond the last start vector.
template<class Real>
class WindowIteration
{
public:
  WindowIteration(
    const SpectralProblem<Real>& problem, const BlockOptions& options, EigenPairs<Real>& pairs)
    : problem_(problem), options_(options), pairs_(pairs), start_(pairs.vectors.Columns())
  {
  }

  BlockReport Run(const Progress& progress);

private:
  void MakeRoom();
  bool NextWindow(const Progress& progress);
  void SetStartVectors(Index blockSize);
  void Lock(const BlockReport& report);
  BlockReport Collect();
  void Arrange(const std::vector<Index>& order);

  const SpectralProblem<Real>& problem_;
  const BlockOptions& options_;
  EigenPairs<Real>& pairs_;
  const Id start_; // columns of the start
  Id used_ = 0;    // number of start columns that have been in a window
  EigenPairs<Real> window_;
  BlockBuffer<Real> guards_; // guards of the last window
  std::vector<double> values_;
  std::vector<double> residuals_;
  BlockWorkspace<Real> workspace_;
  BlockReport report_;
};

/// Provides one column for every wanted pair and every guard.
template<class Real>
void WindowIteration<Real>::MakeRoom()
{
  const Id columns = std::max<Id>(start_, options_.wanted + WindowGuard);
  pairs_.vectors.Grow(problem_.Rows(), columns, problem_.threads);
  pairs_.vectors.Show(columns);
}

/// Starts the window from the guards of the last window and the next columns of the start.
template<class Real>
void WindowIteration<Real>::SetStartVectors(Index blockSize)
{
  const Id guards = guards_.Columns();
  const Id fresh = std::clamp<Id>(blockSize - guards, 0, start_ - used_);
  window_.values.resize(0);
  window_.isRenewed = false;
  window_.vectors.Reserve(problem_.Rows(), std::max<Id>(blockSize, guards + fresh));
  window_.vectors.Show(guards + fresh);
  auto window = window_.vectors.View();
  CopyBlock(guards_.View(), window.leftCols(guards), problem_.threads);
  CopyBlock(
    pairs_.vectors.View().middleCols(used_, fresh), window.rightCols(fresh), problem_.threads);
  used_ += fresh;
}

/// Appends the pairs of the window to the locked pairs, and keeps its guards.
template<class Real>
void WindowIteration<Real>::Lock(const BlockReport& report)
{
  const Id found = static_cast<Id>(values_.size());
  const Id locked = static_cast<Id>(report.residuals.size());
  const double* values = window_.values.data();
  values_.insert(values_.end(), values, values + locked);
  residuals_.insert(residuals_.end(), report.residuals.begin(), report.residuals.end());
  const auto window = window_.vectors.View();
  const Id guards = window.cols() - locked;
  guards_.Reserve(problem_.Rows(), std::max<Id>(WindowGuard, guards));
  guards_.Show(guards);
  CopyBlock(
    window.leftCols(locked), pairs_.vectors.View().middleCols(found, locked), problem_.threads);
  CopyBlock(window.rightCols(guards), guards_.View(), problem_.threads);
  report_.numberOfConverged += report.numberOfConverged;
  report_.nextResidual = report.nextResidual;
  report_.iterations = std::max(report_.iterations, report.iterations);
}

/// Solves the next window. False when no pairs are left.
template<class Real>
bool WindowIteration<Real>::NextWindow(const Progress& progress)
{
  BlockOptions block = options_;
  const Id found = static_cast<Id>(values_.size());
  block.wanted = NextWindowSize(options_.wanted - static_cast<Index>(found));
  block.blockSize = block.wanted + WindowGuard;
  this->SetStartVectors(block.blockSize);
  BasisParts<Real> known;
  if (found > 0)
  {
    known.push_back(pairs_.vectors.View().leftCols(found));
  }
  const BlockReport report =
    ImproveEigenPairs<Real>(problem_, block, known, window_, workspace_, progress);
  this->Lock(report);
  return static_cast<Index>(report.residuals.size()) == block.wanted;
}

/// Sorts the found columns and puts the guards behind them.
template<class Real>
void WindowIteration<Real>::Arrange(const std::vector<Index>& order)
{
  const Id found = static_cast<Id>(order.size());
  const Id guards = guards_.Columns();
  auto all = pairs_.vectors.View();
  const auto last = guards_.View();
  ParallelRanges(all.rows(), problem_.threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        auto columns = all.row(row);
        const Eigen::Matrix<Real, 1, Eigen::Dynamic> ordered = columns(order);
        columns.head(found) = ordered;
        columns.segment(found, guards) = last.row(row);
      }
    });
  pairs_.vectors.Show(found + guards);
}

/// Collects all windows in ascending order. The guards of the last window come behind them.
template<class Real>
BlockReport WindowIteration<Real>::Collect()
{
  std::vector<Index> order(values_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](Index a, Index b) { return values_[a] < values_[b]; });
  const Id found = static_cast<Id>(order.size());
  const Id guards = guards_.Columns();
  pairs_.values.resize(found + guards);
  pairs_.values.tail(guards) = window_.values.tail(guards);
  pairs_.isRenewed = false;
  for (Id j = 0; j < found; ++j)
  {
    pairs_.values[j] = values_[order[j]];
    report_.residuals.push_back(residuals_[order[j]]);
  }
  this->Arrange(order);
  return report_;
}

template<class Real>
BlockReport WindowIteration<Real>::Run(const Progress& progress)
{
  this->MakeRoom();
  bool more = true;
  while (more && static_cast<Index>(values_.size()) < options_.wanted)
  {
    const double begin = double(values_.size()) / options_.wanted;
    const double end = std::min(1.0, begin + double(WindowSize) / options_.wanted);
    more = this->NextWindow(progress.Part(begin, end));
  }
  return this->Collect();
}

} // namespace

Index GuardedSize(Index wanted)
{
  const Index guards = std::max<Index>(8, wanted / 8);
  return (wanted + guards + 7) / 8 * 8; // whole SIMD lanes
}

Id HeldColumns(Index wanted)
{
  constexpr Id blocks = 3; // vectors, directions, corrections
  const Id one = GuardedSize(wanted);
  return one <= LargestBlock
           ? blocks * one
           : wanted + WindowGuard + blocks * (NextWindowSize(wanted) + WindowGuard);
}

template<class Real>
BlockReport ImproveManyEigenPairs(const SpectralProblem<Real>& problem, const BlockOptions& options,
  EigenPairs<Real>& pairs, const Progress& progress)
{
  if (options.blockSize <= LargestBlock)
  {
    BlockWorkspace<Real> workspace;
    return ImproveEigenPairs<Real>(problem, options, {}, pairs, workspace, progress);
  }
  return WindowIteration<Real>(problem, options, pairs).Run(progress);
}

template BlockReport ImproveManyEigenPairs(
  const SpectralProblem<float>&, const BlockOptions&, EigenPairs<float>&, const Progress&);
template BlockReport ImproveManyEigenPairs(
  const SpectralProblem<double>&, const BlockOptions&, EigenPairs<double>&, const Progress&);

} // namespace gridfem
