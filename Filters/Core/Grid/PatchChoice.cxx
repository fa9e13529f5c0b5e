#include "Grid/PatchChoice.h"

#include <algorithm>

namespace gridfem
{

std::vector<double> CountedPatchAreas(
  const ClippedMesh& clipped, const Array<Index>& piecePatch, Id numberOfPatches)
{
  std::vector<double> area(numberOfPatches, 0.0);
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
