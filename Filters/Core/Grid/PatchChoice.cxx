#include "Grid/PatchChoice.h"

#include "Base/Parallel.h"

#include <algorithm>
#include <atomic>

namespace gridfem
{

std::vector<double> CountedPatchAreas(
  const ClippedMesh& clipped, const Array<Index>& piecePatch, Id numberOfPatches, int threads)
{
  // For nearly all patches, one large piece suffices. The areas of the others are added in the
  // order of the pieces.
  std::vector<std::atomic<char>> hasLarge(numberOfPatches);
  for (std::atomic<char>& patch : hasLarge)
  {
    patch.store(0, std::memory_order_relaxed);
  }
  ParallelRanges(clipped.NumberOfPieces(), threads,
    [&](Id begin, Id end)
    {
      for (Id piece = begin; piece < end; ++piece)
      {
        std::atomic<char>& patch = hasLarge[piecePatch[piece]];
        if (!patch.load(std::memory_order_relaxed) &&
            PieceArea(clipped, piece) >= SmallestPatchArea)
        {
          patch.store(1, std::memory_order_relaxed);
        }
      }
    });
  std::vector<double> area(numberOfPatches);
  std::transform(hasLarge.begin(), hasLarge.end(), area.begin(),
    [](const std::atomic<char>& patch) { return patch.load() ? SmallestPatchArea : 0.0; });
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    double& sum = area[piecePatch[piece]];
    if (sum < SmallestPatchArea)
    {
      sum = std::min(SmallestPatchArea, sum + PieceArea(clipped, piece));
    }
  }
  return area;
}

} // namespace gridfem
