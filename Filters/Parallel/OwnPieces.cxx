#include "Parallel/OwnPieces.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Renumbers the cut points that corners use, and drops all others.
void KeepCutPoints(ClippedMesh& clipped)
{
  const auto inputs = static_cast<Index>(clipped.numberOfInputPoints);
  std::vector<Index> number(clipped.cutPoints.size(), -1);
  for (const Index corner : clipped.corners)
  {
    if (corner >= inputs)
    {
      number[corner - inputs] = 0;
    }
  }
  Array<CutPoint> cuts;
  Array<Vec3> position(clipped.position.begin(), clipped.position.begin() + inputs);
  for (std::size_t k = 0; k < number.size(); ++k)
  {
    if (number[k] == 0)
    {
      number[k] = static_cast<Index>(cuts.size());
      cuts.push_back(clipped.cutPoints[k]);
      position.push_back(clipped.position[inputs + k]);
    }
  }
  for (Index& corner : clipped.corners)
  {
    corner = corner < inputs ? corner : inputs + number[corner - inputs];
  }
  clipped.cutPoints = std::move(cuts);
  clipped.position = std::move(position);
}

/// Removed pieces of triangles that also have pieces that stay.
template<class IsKept>
std::vector<PieceElsewhere> FindElsewhere(
  const ClippedMesh& all, const Array<Index>& piecePatch, const IsKept& isKept)
{
  std::vector<char> isHere;
  for (std::size_t piece = 0; piece < all.pieceTriangle.size(); ++piece)
  {
    const auto triangle = static_cast<std::size_t>(all.pieceTriangle[piece]);
    isHere.resize(std::max(isHere.size(), triangle + 1), 0);
    isHere[triangle] |= isKept(piecePatch[piece]);
  }
  std::vector<PieceElsewhere> elsewhere;
  for (std::size_t cell = 0; cell < all.cells.size(); ++cell)
  {
    for (Index piece = all.cellBegin[cell]; piece < all.cellBegin[cell + 1]; ++piece)
    {
      if (!isKept(piecePatch[piece]) && isHere[all.pieceTriangle[piece]])
      {
        elsewhere.push_back({ all.cells[cell], all.pieceTriangle[piece] });
      }
    }
  }
  return elsewhere;
}

} // namespace

void KeepPieces(Index first, Index last, GridFunctions& functions)
{
  const auto isKept = [&](Index patch) { return patch >= first && patch < last; };
  ClippedMesh& clipped = functions.clipped;
  ClippedMesh all = std::move(clipped);
  clipped = ClippedMesh();
  clipped.grid = all.grid;
  clipped.numberOfInputPoints = all.numberOfInputPoints;
  clipped.isWelded = all.isWelded;
  clipped.cutPoints = std::move(all.cutPoints);
  clipped.position = std::move(all.position);
  functions.isPart = true;
  functions.elsewhere = FindElsewhere(all, functions.piecePatch, isKept);
  Array<Index> piecePatch;
  // Room for all pieces is reserved, because unused memory costs nothing.
  piecePatch.reserve(all.pieceTriangle.size());
  clipped.pieceTriangle.reserve(all.pieceTriangle.size());
  clipped.pieceBegin.reserve(all.pieceBegin.size());
  clipped.corners.reserve(all.corners.size());
  clipped.pieceBegin.push_back(0);
  for (std::size_t cell = 0; cell < all.cells.size(); ++cell)
  {
    const auto begin = static_cast<Index>(piecePatch.size());
    for (Index piece = all.cellBegin[cell]; piece < all.cellBegin[cell + 1]; ++piece)
    {
      if (!isKept(functions.piecePatch[piece]))
      {
        continue;
      }
      piecePatch.push_back(functions.piecePatch[piece] - first);
      clipped.pieceTriangle.push_back(all.pieceTriangle[piece]);
      clipped.corners.insert(clipped.corners.end(), all.corners.begin() + all.pieceBegin[piece],
        all.corners.begin() + all.pieceBegin[piece + 1]);
      clipped.pieceBegin.push_back(static_cast<Index>(clipped.corners.size()));
    }
    if (begin < static_cast<Index>(piecePatch.size()))
    {
      clipped.cells.push_back(all.cells[cell]);
      clipped.cellBegin.push_back(begin);
    }
  }
  clipped.cellBegin.push_back(static_cast<Index>(piecePatch.size()));
  functions.piecePatch = std::move(piecePatch);
  KeepCutPoints(clipped);
  for (Index& patch : functions.pointPatch)
  {
    patch = isKept(patch) ? patch - first : -1;
  }
}

} // namespace gridfem
