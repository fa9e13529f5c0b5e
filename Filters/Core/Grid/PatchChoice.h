// Chooses the patch of a point that lies in several patches.
#ifndef GridFEM_PatchChoice_h
#define GridFEM_PatchChoice_h

#include "Grid/Clip.h"

#include <vector>

namespace gridfem
{

/// Returns the area of every patch in units of cell faces, but at most SmallestPatchArea. Larger
/// areas do not come from rounding, so their size does not matter. Cost O(pieces); same bits for
/// any number of threads.
/// @param piecePatch  the patch of each piece, in [0, numberOfPatches)
constexpr double SmallestPatchArea = 1e-10;
std::vector<double> CountedPatchAreas(
  const ClippedMesh& clipped, const Array<Index>& piecePatch, Id numberOfPatches, int threads);

/// Prefers the patch with the largest counted area, and the lowest number among equal areas. On a
/// patch without area, functions have no integral, so no equation determines their values.
class PatchChoice
{
public:
  PatchChoice(
    const ClippedMesh& clipped, const Array<Index>& piecePatch, Id numberOfPatches, int threads)
    : area_(CountedPatchAreas(clipped, piecePatch, numberOfPatches, threads))
  {
  }

  /// Whether `patch` is a better choice than `other`; -1 means no patch.
  bool IsBetter(Index patch, Index other) const
  {
    if (patch < 0 || other < 0)
    {
      return other < patch;
    }
    return area_[patch] != area_[other] ? area_[patch] > area_[other] : patch < other;
  }

  bool HasArea(Index patch) const { return area_[patch] >= SmallestPatchArea; }

private:
  std::vector<double> area_;
};

} // namespace gridfem

#endif
