#include "Links.h"

#include "BlockLists.h"
#include "Errors.h"
#include "Parallel.h"
#include "TriangleClipper.h"

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

/// The pieces along a side of an edge, one per stretch.
const Index* PiecesAlong(const MeshEdges& edges, const Stretches& stretches, Index side)
{
  const Index triangle = side / 3;
  const Index* piece = stretches.piece.data() + stretches.begin[triangle];
  const bool isCut = stretches.begin[triangle + 1] - stretches.begin[triangle] > 3;
  for (int k = 0; k < side % 3; ++k)
  {
    piece += isCut ? StretchesOf(edges, edges.ofTriangle[triangle][k]) : 1;
  }
  return piece;
}

void LinkTwoSides(const Index* first, const Index* second, Index stretches, Array<Link>& links)
{
  for (Index k = 0; k < stretches; ++k)
  {
    const auto [low, high] = std::minmax(first[k], second[k]);
    if (low >= 0 && low != high)
    {
      links.emplace_back(low, high);
    }
  }
}

void LinkManySides(const MeshEdges& edges, const Stretches& stretches, Index edge,
  const ClippedMesh& clipped, Array<Link>& links)
{
  for (Index k = 0; k < StretchesOf(edges, edge); ++k)
  {
    std::vector<Index> pieces;
    for (Index side = edges.sideBegin[edge]; side < edges.sideBegin[edge + 1]; ++side)
    {
      const Index piece = PiecesAlong(edges, stretches, edges.side[side])[k];
      if (piece >= 0)
      {
        pieces.push_back(piece);
      }
    }
    std::sort(pieces.begin(), pieces.end());
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
    LinkStar(
      pieces, [&](Index piece) { return clipped.CellOf(piece); }, links);
  }
}

void LinkEdge(const MeshEdges& edges, const Stretches& stretches, Index edge,
  const ClippedMesh& clipped, Array<Link>& links)
{
  const Index* side = edges.side.data() + edges.sideBegin[edge];
  const Index sides = edges.sideBegin[edge + 1] - edges.sideBegin[edge];
  if (edges.ends[edge][0] == edges.ends[edge][1] || sides == 1)
  {
    return;
  }
  if (sides == 2)
  {
    LinkTwoSides(PiecesAlong(edges, stretches, side[0]), PiecesAlong(edges, stretches, side[1]),
      StretchesOf(edges, edge), links);
  }
  else
  {
    LinkManySides(edges, stretches, edge, clipped, links);
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

Stretches AllocateStretches(const MeshEdges& edges, int threads)
{
  Stretches stretches;
  const Id triangles = static_cast<Id>(edges.ofTriangle.size());
  stretches.begin.resize(triangles + 1);
  const double total = ParallelSum(triangles, threads, 0.0,
    [&](Id begin, Id end)
    {
      double sum = 0.0;
      for (Id t = begin; t < end; ++t)
      {
        stretches.begin[t] = 0;
        for (const Index edge : edges.ofTriangle[t])
        {
          stretches.begin[t] += StretchesOf(edges, edge);
        }
        sum += stretches.begin[t];
      }
      return sum;
    });
  RequireIndices(total, "stretches of edges");
  stretches.begin[triangles] = 0;
  stretches.piece.resize(ExclusiveScan(stretches.begin));
  return stretches;
}

void LinkAlongEdges(const MeshEdges& edges, const Stretches& stretches, int threads,
  const Progress& progress, ClippedMesh& clipped)
{
  AppendRanges(
    edges.NumberOfEdges(), threads, clipped.links,
    [&](Id begin, Id end, Array<Link>& links)
    {
      for (Id edge = begin; edge < end; ++edge)
      {
        LinkEdge(edges, stretches, static_cast<Index>(edge), clipped, links);
      }
    },
    progress);
}

} // namespace gridfem
