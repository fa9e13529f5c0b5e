#include "Grid/CutPoints.h"

#include "Base/Parallel.h"

namespace gridfem
{

namespace
{

constexpr Index Unmade = -1;

} // namespace

void AllocateEdgeCuts(Id cuts, int threads, ClippedMesh& clipped)
{
  // Interior points are appended later. Fine meshes have fewer of them than this reserve, so that
  // nothing moves then.
  clipped.cutPoints.reserve(cuts + cuts / 8);
  clipped.position.reserve(clipped.numberOfInputPoints + cuts + cuts / 8);
  clipped.cutPoints.resize(cuts);
  clipped.position.resize(clipped.numberOfInputPoints + cuts);
  ParallelRanges(cuts, threads,
    [&](Id begin, Id end)
    {
      for (Id cut = begin; cut < end; ++cut)
      {
        clipped.cutPoints[cut].triangle = Unmade;
      }
    });
}

void DropUnmadeCutPoints(int threads, ClippedMesh& clipped)
{
  const Id cuts = static_cast<Id>(clipped.cutPoints.size());
  const Id unmade = ParallelSum(cuts, threads, Id{ 0 },
    [&](Id begin, Id end)
    {
      Id count = 0;
      for (Id cut = begin; cut < end; ++cut)
      {
        count += clipped.cutPoints[cut].triangle == Unmade ? 1 : 0;
      }
      return count;
    });
  if (unmade == 0)
  {
    return;
  }
  const auto inputs = static_cast<Index>(clipped.numberOfInputPoints);
  std::vector<Index> number(cuts);
  Index made = 0;
  for (Id cut = 0; cut < cuts; ++cut)
  {
    number[cut] = made;
    if (clipped.cutPoints[cut].triangle != Unmade)
    {
      clipped.cutPoints[made] = clipped.cutPoints[cut];
      clipped.position[inputs + made] = clipped.position[inputs + cut];
      ++made;
    }
  }
  clipped.cutPoints.resize(made);
  clipped.position.resize(inputs + made);
  ParallelRanges(static_cast<Id>(clipped.corners.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        Index& corner = clipped.corners[k];
        corner = corner < inputs ? corner : inputs + number[corner - inputs];
      }
    });
}

} // namespace gridfem
