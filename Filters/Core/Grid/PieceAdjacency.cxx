#include "Grid/PieceAdjacency.h"

#include "Base/Grouping.h"
#include "Base/PerThreadLists.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Links of one edge. `pieces` is sorted and unique, so it is grouped by cell.
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
    std::sort(pieces.begin(), pieces.end());
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
    LinkStar(
      pieces, [&](Index piece) { return clipped.CellOf(piece); }, links);
  }
}

} // namespace

void LinkStars(std::vector<EdgeUse>& uses, const Array<Index>& pieceCell, Array<Link>& links)
{
  std::sort(uses.begin(), uses.end(),
    [](const EdgeUse& a, const EdgeUse& b)
    { return a.edge != b.edge ? a.edge < b.edge : a.piece < b.piece; });
  std::vector<Index> pieces;
  for (std::size_t k = 0; k < uses.size(); ++k)
  {
    if (pieces.empty() || pieces.back() != uses[k].piece)
    {
      pieces.push_back(uses[k].piece);
    }
    if (k + 1 == uses.size() || uses[k + 1].edge != uses[k].edge)
    {
      LinkStar(
        pieces, [&](Index piece) { return pieceCell[piece]; }, links);
      pieces.clear();
    }
  }
}

void LinkAtPoints(const Array<Index>& pointClass, int threads, ClippedMesh& clipped)
{
  const auto points = static_cast<Index>(clipped.numberOfInputPoints);
  Array<Link> uses; // class of a point, piece that has it
  AppendRanges(clipped.NumberOfPieces(), threads, uses,
    [&](Id begin, Id end, Array<Link>& list)
    {
      for (auto piece = static_cast<Index>(begin); piece < end; ++piece)
      {
        for (Index k = clipped.pieceBegin[piece]; k < clipped.pieceBegin[piece + 1]; ++k)
        {
          if (clipped.corners[k] < points)
          {
            list.emplace_back(pointClass[clipped.corners[k]], piece);
          }
        }
      }
    });
  Array<Index> point(uses.size());
  std::transform(
    uses.begin(), uses.end(), point.begin(), [](const Link& use) { return use.first; });
  const Groups ofPoint =
    GroupItems(point.data(), static_cast<Id>(point.size()), Id{ points }, threads);
  const Array<Index> pieceCell = PieceCells(clipped, threads);
  AppendRanges(points, threads, clipped.links,
    [&](Id begin, Id end, Array<Link>& links)
    {
      std::vector<Index> pieces;
      for (Id p = begin; p < end; ++p)
      {
        pieces.clear();
        for (Index k = ofPoint.begin[p]; k < ofPoint.begin[p + 1]; ++k)
        {
          const Index piece = uses[ofPoint.item[k]].second;
          if (pieces.empty() || pieces.back() != piece)
          {
            pieces.push_back(piece);
          }
        }
        LinkStar(
          pieces, [&](Index piece) { return pieceCell[piece]; }, links);
      }
    });
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
