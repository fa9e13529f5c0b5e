#include "WindowIteration.h"

#include "Parallel.h"

#include <algorithm>
#include <numeric>

namespace gridfem
{
namespace
{

/// Blocks up to this size are not cut into windows.
constexpr Index LargestBlock = 160;

/// Wanted pairs of one window, at most, and those beyond: inside the spectrum the gap is relatively
/// small.
constexpr Index WindowSize = 112;
constexpr Index WindowGuard = 32;

/// Windows are of equal size.
Index NextWindowSize(Index left)
{
  const Index windows = (left + WindowSize - 1) / WindowSize;
  return (left + windows - 1) / windows;
}

/// Windows that have been found, and the start vectors that are left. Both share one block: the
/// windows that were found need no more columns than were taken out of it, but at its end.
class WindowIteration
{
public:
  WindowIteration(const SpectralProblem& problem, const BlockOptions& options, EigenPairs& pairs)
    : problem_(problem), options_(options), pairs_(pairs), start_(pairs.vectors.cols())
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

  SpectralProblem problem_;
  const BlockOptions& options_;
  EigenPairs& pairs_;
  const Id start_; // columns of the start
  Id used_ = 0;    // of them have been in a window
  EigenPairs window_;
  MultiVector guards_; // of the last window
  std::vector<double> values_;
  std::vector<double> residuals_;
  BlockWorkspace workspace_;
  BlockReport report_;
};

/// One column for every wanted pair and guard.
void WindowIteration::MakeRoom()
{
  const Id columns = options_.wanted + WindowGuard;
  if (start_ < columns)
  {
    MultiVector wide;
    Reshape(wide, problem_.mass.rows, columns);
    wide.leftCols(start_) = pairs_.vectors;
    pairs_.vectors.swap(wide);
  }
}

/// The guards of the last window and the next columns of the start.
void WindowIteration::SetStartVectors(Index blockSize)
{
  const Id guards = guards_.cols();
  const Id fresh = std::clamp<Id>(blockSize - guards, 0, start_ - used_);
  window_.values.resize(0);
  Reshape(window_.vectors, problem_.mass.rows, guards + fresh);
  ParallelRanges(problem_.mass.rows, problem_.threads,
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      auto rows = window_.vectors.middleRows(begin, count);
      if (guards > 0)
      {
        rows.leftCols(guards) = guards_.middleRows(begin, count);
      }
      rows.rightCols(fresh) = pairs_.vectors.block(begin, used_, count, fresh);
    });
  used_ += fresh;
}

/// Puts what was found behind what is locked.
void WindowIteration::Lock(const BlockReport& report)
{
  const Id found = static_cast<Id>(values_.size());
  const Id locked = static_cast<Id>(report.residuals.size());
  const double* values = window_.values.data();
  values_.insert(values_.end(), values, values + locked);
  residuals_.insert(residuals_.end(), report.residuals.begin(), report.residuals.end());
  Reshape(guards_, problem_.mass.rows, window_.vectors.cols() - locked);
  ParallelRanges(problem_.mass.rows, problem_.threads,
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      const auto rows = window_.vectors.middleRows(begin, count);
      pairs_.vectors.block(begin, found, count, locked) = rows.leftCols(locked);
      guards_.middleRows(begin, count) = rows.rightCols(guards_.cols());
    });
  problem_.known = BasisParts{ pairs_.vectors.leftCols(found + locked) };
  report_.numberOfConverged += report.numberOfConverged;
  report_.nextResidual = report.nextResidual;
  report_.iterations = std::max(report_.iterations, report.iterations);
}

/// False when no pairs are left.
bool WindowIteration::NextWindow(const Progress& progress)
{
  BlockOptions block = options_;
  const Index left = options_.wanted - static_cast<Index>(values_.size());
  block.wanted = NextWindowSize(left);
  block.blockSize = block.wanted + WindowGuard;
  this->SetStartVectors(block.blockSize);
  const BlockReport report = ImproveEigenPairs(problem_, block, window_, workspace_, progress);
  this->Lock(report);
  return static_cast<Index>(report.residuals.size()) == block.wanted;
}

/// Orders the columns that were found and puts the guards behind.
void WindowIteration::Arrange(const std::vector<Index>& order)
{
  const Id found = static_cast<Id>(order.size());
  const Id guards = guards_.cols();
  ParallelRanges(problem_.mass.rows, problem_.threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        auto columns = pairs_.vectors.row(row);
        const Eigen::RowVectorXd ordered = columns(order);
        columns.head(found) = ordered;
        columns.segment(found, guards) = guards_.row(row);
      }
    });
  KeepColumns(pairs_.vectors, found + guards);
}

/// All windows as one, in ascending order, and the guards of the last behind.
BlockReport WindowIteration::Collect()
{
  std::vector<Index> order(values_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](Index a, Index b) { return values_[a] < values_[b]; });
  const Id found = static_cast<Id>(order.size());
  pairs_.values.resize(found + guards_.cols());
  pairs_.values.tail(guards_.cols()) = window_.values.tail(guards_.cols());
  for (Id j = 0; j < found; ++j)
  {
    pairs_.values[j] = values_[order[j]];
    report_.residuals.push_back(residuals_[order[j]]);
  }
  this->Arrange(order);
  return report_;
}

BlockReport WindowIteration::Run(const Progress& progress)
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

BlockReport ImproveManyEigenPairs(const SpectralProblem& problem, const BlockOptions& options,
  EigenPairs& pairs, const Progress& progress)
{
  if (options.blockSize <= LargestBlock)
  {
    BlockWorkspace workspace;
    return ImproveEigenPairs(problem, options, pairs, workspace, progress);
  }
  return WindowIteration(problem, options, pairs).Run(progress);
}

} // namespace gridfem
