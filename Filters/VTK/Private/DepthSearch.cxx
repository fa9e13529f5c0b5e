#include "DepthSearch.h"

#include "Grid/Grid.h"
#include "InputValidation.h"
#include "Problems/SpectrumAccuracy.h"

#include <algorithm>

namespace gridfem
{
namespace
{

constexpr int FirstDepth = 5; // costs next to nothing

} // namespace

int DepthSearch::Begin(const StageKey& asked)
{
  isFound_ = isFound_ && asked == asked_;
  if (!isFound_)
  {
    asked_ = asked;
    depth_ = FirstDepth;
    wasAccurate_ = false;
  }
  return depth_;
}

int DepthSearch::Next(
  const TriangleMesh& mesh, int depth, double error, bool isTrusted, double wanted)
{
  const bool isAccurate = error <= wanted;
  int next = depth;
  if (!isFound_ && !(isAccurate && (isTrusted || wasAccurate_)))
  {
    next = error > wanted ? DepthForAccuracy({ error }, depth, wanted) : depth + 1;
    next = std::min(next, MaximumDepth);
    while (next > depth && !FitsMemory(mesh, next))
    {
      --next;
    }
  }
  wasAccurate_ = isAccurate;
  isFound_ = next == depth;
  depth_ = next;
  return next;
}

} // namespace gridfem
