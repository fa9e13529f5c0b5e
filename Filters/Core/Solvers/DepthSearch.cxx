#include "Solvers/DepthSearch.h"

#include "Grid/Grid.h"
#include "Solvers/MemoryEstimate.h"
#include "Solvers/Requirements.h"
#include "Spectrum/SpectrumAccuracy.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// Largest step of the depth. Estimates on coarse grids may be far too large, and an additional
/// depth on the way costs a sixteenth.
constexpr int LongestStep = 2;

} // namespace

void DepthSearch::Judge(
  const TriangleMesh& mesh, const SolutionAccuracy& errors, double wanted, FunctionKind kind)
{
  if (isFound_)
  {
    return;
  }
  const double error = errors.discretization;
  const bool isAccurate = error <= wanted;
  isReached_ = isAccurate && (errors.isTrusted || wasAccurate_);
  int next = depth_;
  if (!isReached_)
  {
    next = error > wanted ? DepthForAccuracy({ error }, depth_, wanted) : depth_ + 1;
    next = FittingDepth(mesh, std::min({ next, depth_ + LongestStep, MaximumDepth }), depth_, kind);
  }
  wasAccurate_ = isAccurate;
  isFound_ = next == depth_;
  depth_ = next;
}

int FirstDepthForModes(const TriangleMesh& mesh, Id modes, double accuracy, FunctionKind kind)
{
  const int depth = FirstDepthForAccuracy(EstimateMemory(mesh, 5).functions, modes, accuracy);
  return FittingDepth(mesh, depth, MinimumDepth, kind);
}

int NextDepthForModes(const TriangleMesh& mesh, const std::vector<double>& errors, bool isConfirmed,
  int depth, double accuracy, FunctionKind kind)
{
  int next = DepthForAccuracy(errors, depth, accuracy);
  if (next == depth && !isConfirmed)
  {
    next = std::min(depth + 1, MaximumDepth);
  }
  return next == depth || FitsMemory(mesh, next, kind) ? next : depth;
}

} // namespace gridfem
