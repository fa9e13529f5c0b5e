// Element matrices of several patches at once, one per SIMD lane.
#ifndef GridFEM_ElementLanes_h
#define GridFEM_ElementLanes_h

#include "Base/Parallel.h"
#include "Base/SimdLanes.h"
#include "Integrals/ElementMatrices.h"

#include <algorithm>

namespace gridfem
{

using ElementLanes = std::array<Lanes, ElementEntries>;

/// One pointer per lane, to the entries of the lane's matrix.
using MatrixPointers = std::array<const double*, LaneCount>;

inline void Gather(const MatrixPointers& matrices, ElementLanes& lanes)
{
  for (int begin = 0; begin < ElementEntries; begin += LaneCount)
  {
    const int first = std::min(begin, ElementEntries - LaneCount);
    LoadLanes(matrices, first, &lanes[first]);
  }
}

/// Writes the first `count` lanes to the matrices.
inline void Scatter(const ElementLanes& lanes, int count, ElementMatrix* matrices)
{
  std::array<double*, LaneCount> entries{};
  std::transform(matrices, matrices + count, entries.begin(),
    [](ElementMatrix& matrix) { return matrix.data(); });
  for (int begin = 0; begin < ElementEntries; begin += LaneCount)
  {
    const int first = std::min(begin, ElementEntries - LaneCount);
    LaneBlock block;
    for (int k = 0; k < LaneCount; ++k)
    {
      block.col(k) = lanes[first + k];
    }
    StoreLanes(block, entries, count, first);
  }
}

/// Calls body(begin, count) in parallel, for groups of up to LaneCount of the `patches` patches.
template<class Body>
void ForEachLaneGroup(Id patches, int threads, Body&& body)
{
  ParallelRanges(
    patches, threads,
    [&](Id begin, Id end)
    {
      for (Id first = begin; first < end; first += LaneCount)
      {
        body(first, static_cast<int>(std::min<Id>(LaneCount, end - first)));
      }
    },
    PatchesPerBlock);
}

} // namespace gridfem

#endif
