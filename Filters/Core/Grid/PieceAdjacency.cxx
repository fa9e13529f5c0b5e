#include "Grid/PieceAdjacency.h"

#include "Base/Grouping.h"
#include "Base/PerThreadLists.h"
#include "Base/SortEachOnce.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Appends the links of one edge. `pieces` is sorted and unique, so it is grouped by cell.
template<class CellOf>
void LinkStar(const std::vector<Index>& pieces, const CellOf& cellOf, Array<Link>& links)
{
  std::vector<Index> firstOfCell;
  for (const Index piece : pieces)
  {
    if (!firstOfCell.empty() && cellOf(firstOfCell.back()) == cellOf(piece))
    {
      links.emplace_back(firstOfCell.back(), piece);
      continue;
    }
    for (const Index other : firstOfCell)
    {
      links.emplace_back(other, piece);
    }
    firstOfCell.push_back(piece);
  }
}

void LinkManySides(const ManySidedEdge& edge, const Array<Index>& stretches,
  const Array<Index>& place, const ClippedMesh& clipped, Array<Link>& links)
{
  for (Index k = 0; k < edge.stretches; ++k)
  {
    std::vector<Index> pieces;
    for (Index side = 0; side < edge.sides; ++side)
    {
      const Index piece = stretches[edge.begin + side * edge.stretches + k];
      if (piece >= 0)
      {
        pieces.push_back(place[piece]);
      }
    }
    SortEachOnce(pieces);
    LinkStar(
      pieces, [&](Index piece) { return clipped.CellOf(piece); }, links);
  }
}

} // namespace

void LinkStars(const Array<EdgeUse>& uses, Id edges, const Array<Index>& pieceCell, int threads,
  Array<Link>& links)
{
  Array<Index> edge(uses.size());
  std::transform(
    uses.begin(), uses.end(), edge.begin(), [](const EdgeUse& use) { return use.edge; });
  const Groups ofEdge = GroupItems(edge.data(), static_cast<Id>(edge.size()), edges, threads);
  AppendRanges(edges, threads, links,
    [&](Id begin, Id end, Array<Link>& list)
    {
      std::vector<Index> pieces;
      for (Id e = begin; e < end; ++e)
      {
        pieces.clear();
        for (Index k = ofEdge.begin[e]; k < ofEdge.begin[e + 1]; ++k)
        {
          pieces.push_back(uses[ofEdge.item[k]].piece);
        }
        pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
        LinkStar(
          pieces, [&](Index piece) { return pieceCell[piece]; }, list);
      }
    });
}

void LinkAtPoints(const Array<Index>& pointClass, int threads, ClippedMesh& clipped)
{
  Array<EdgeUse> uses;
  AppendRanges(clipped.NumberOfPieces(), threads, uses,
    [&](Id begin, Id end, Array<EdgeUse>& list)
    {
      for (auto piece = static_cast<Index>(begin); piece < end; ++piece)
      {
        for (Index k = clipped.pieceBegin[piece]; k < clipped.pieceBegin[piece + 1]; ++k)
        {
          if (clipped.corners[k] < clipped.numberOfInputPoints)
          {
            list.push_back({ pointClass[clipped.corners[k]], piece });
          }
        }
      }
    });
  LinkStars(
    uses, clipped.numberOfInputPoints, PieceCells(clipped, threads), threads, clipped.links);
}

void LinkAlongEdges(const MeshEdges& edges, const Array<Index>& stretches,
  const Array<Index>& place, const Job& job, ClippedMesh& clipped)
{
  AppendRanges(
    edges.numberOfPairs, job.threads, clipped.links,
    [&](Id begin, Id end, Array<Link>& links)
    {
      for (Id pair = begin; pair < end; ++pair)
      {
        const Index first = stretches[2 * pair];
        const Index second = stretches[2 * pair + 1];
        if (first >= 0 && second >= 0 && first != second)
        {
          const auto [low, high] = std::minmax(place[first], place[second]);
          links.emplace_back(low, high);
        }
      }
    },
    job.progress);
  AppendRanges(static_cast<Id>(edges.manySided.size()), job.threads, clipped.links,
    [&](Id begin, Id end, Array<Link>& links)
    {
      for (Id edge = begin; edge < end; ++edge)
      {
        LinkManySides(edges.manySided[edge], stretches, place, clipped, links);
      }
    });
}

} // namespace gridfem
