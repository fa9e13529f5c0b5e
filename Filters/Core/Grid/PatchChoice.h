// Which patch a point is given to that lies in several.
#ifndef GridFEM_PatchChoice_h
#define GridFEM_PatchChoice_h

#include "Grid/Clip.h"

#include <vector>

namespace gridfem
{

/// Area of every patch in cell faces, added up from its pieces to SmallestPatchArea, and counted no
/// further: what is larger is no rounding. Cost O(pieces); same bits for any number of threads.
/// @param piecePatch  per piece its patch, in [0, numberOfPatches)
constexpr double SmallestPatchArea = 1e-10;
std::vector<double> CountedPatchAreas(
  const ClippedMesh& clipped, const Array<Index>& piecePatch, Id numberOfPatches, int threads);

/// A point is given to the patch with the largest counted area, and of equal ones to the lowest. On
/// a patch without area a function has no integral, so that no equation says what it is there.
class PatchChoice
{
public:
  PatchChoice(
    const ClippedMesh& clipped, const Array<Index>& piecePatch, Id numberOfPatches, int threads)
    : area_(CountedPatchAreas(clipped, piecePatch, numberOfPatches, threads))
  {
  }

  /// Whether `patch` is a better choice than `other`; -1 stands for no patch.
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
