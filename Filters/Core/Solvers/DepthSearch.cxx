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

/// Returns the wanted depth, or the largest before it that is near enough and fits into memory.
int StepTowards(const TriangleMesh& mesh, int wanted, int depth, FunctionKind kind)
{
  const int next = std::min({ wanted, depth + LongestStep, MaximumDepth });
  return next == depth ? depth : FittingDepth(mesh, next, depth, kind);
}

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
    next = StepTowards(mesh, next, depth_, kind);
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
    next = depth + 1;
  }
  return StepTowards(mesh, next, depth, kind);
}

} // namespace gridfem
