#include "WindowIteration.h"

#include "Parallel.h"

#include <deque>
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

/// Windows that have been found, and the start vectors that are left.
class WindowIteration
{
public:
  WindowIteration(const SpectralProblem& problem, const BlockOptions& options, EigenPairs& pairs)
    : problem_(problem), options_(options), pairs_(pairs)
  {
  }

  BlockReport Run(const Progress& progress);

private:
  bool NextWindow(const Progress& progress);
  EigenPairs StartVectors(Index blockSize);
  void Lock(const EigenPairs& window, const BlockReport& report);
  BlockReport Collect();

  SpectralProblem problem_;
  const BlockOptions& options_;
  EigenPairs& pairs_;
  std::deque<MultiVector> found_; // addresses stay
  std::vector<double> values_;
  std::vector<double> residuals_;
  MultiVector guards_; // of the last window
  Eigen::VectorXd guardValues_;
  Id used_ = 0; // columns of pairs_ that have been in a window
  BlockReport report_;
};

/// The guards of the last window and the next columns of the start.
EigenPairs WindowIteration::StartVectors(Index blockSize)
{
  const Id fresh = std::clamp<Id>(blockSize - guards_.cols(), 0, pairs_.vectors.cols() - used_);
  EigenPairs window;
  window.vectors.resize(problem_.mass.rows, guards_.cols() + fresh);
  if (guards_.cols() > 0)
  {
    window.vectors.leftCols(guards_.cols()) = guards_;
  }
  window.vectors.rightCols(fresh) = pairs_.vectors.middleCols(used_, fresh);
  used_ += fresh;
  return window;
}

void WindowIteration::Lock(const EigenPairs& window, const BlockReport& report)
{
  const Id locked = static_cast<Id>(report.residuals.size());
  values_.insert(values_.end(), window.values.data(), window.values.data() + locked);
  residuals_.insert(residuals_.end(), report.residuals.begin(), report.residuals.end());
  found_.emplace_back(window.vectors.leftCols(locked));
  problem_.known.push_back(&found_.back());
  guards_ = window.vectors.rightCols(window.vectors.cols() - locked);
  guardValues_ = window.values.tail(guards_.cols());
  report_.numberOfConverged += report.numberOfConverged;
  report_.nextResidual = report.nextResidual;
  report_.iterations = std::max(report_.iterations, report.iterations);
}

/// False when no pairs are left.
bool WindowIteration::NextWindow(const Progress& progress)
{
  BlockOptions block = options_;
  const Index left = options_.wanted - static_cast<Index>(values_.size());
  const Index windows = (left + WindowSize - 1) / WindowSize;
  block.wanted = (left + windows - 1) / windows; // windows of equal size
  block.blockSize = block.wanted + WindowGuard;
  EigenPairs window = this->StartVectors(block.blockSize);
  const BlockReport report = ImproveEigenPairs(problem_, block, window, progress);
  this->Lock(window, report);
  return static_cast<Index>(report.residuals.size()) == block.wanted;
}

/// All windows as one, in ascending order, and the guards of the last behind.
BlockReport WindowIteration::Collect()
{
  std::vector<Index> order(values_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](Index a, Index b) { return values_[a] < values_[b]; });
  const Id count = static_cast<Id>(order.size());
  std::vector<Id> place(order.size());
  pairs_.values.resize(count + guards_.cols());
  pairs_.values.tail(guards_.cols()) = guardValues_;
  for (Id j = 0; j < count; ++j)
  {
    place[order[j]] = j;
    pairs_.values[j] = values_[order[j]];
    report_.residuals.push_back(residuals_[order[j]]);
  }
  pairs_.vectors.resize(problem_.mass.rows, pairs_.values.size());
  pairs_.vectors.rightCols(guards_.cols()) = guards_;
  Id first = 0;
  while (!found_.empty())
  {
    for (Id j = 0; j < found_.front().cols(); ++j)
    {
      pairs_.vectors.col(place[first + j]) = found_.front().col(j);
    }
    first += found_.front().cols();
    found_.pop_front();
  }
  return report_;
}

BlockReport WindowIteration::Run(const Progress& progress)
{
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

BlockReport ImproveManyEigenPairs(const SpectralProblem& problem, const BlockOptions& options,
  EigenPairs& pairs, const Progress& progress)
{
  if (options.blockSize <= LargestBlock)
  {
    return ImproveEigenPairs(problem, options, pairs, progress);
  }
  return WindowIteration(problem, options, pairs).Run(progress);
}

} // namespace gridfem
