#include "Parallel/RankBoundary.h"

#include "Parallel/HeldPoints.h"

#include <algorithm>
#include <array>

namespace gridfem
{

namespace
{

/// Whether a part of the edges is in the cells of this rank, on a grid. Some edges exist only
/// because no more triangles were received. Such edges have no part of the boundary.
bool HasPart(const RankSpace& space, const std::vector<TriangleEdge>& edges)
{
  const EdgeSamples samples = space.Own().SamplesOfSegments(SegmentsOf(edges, space.Own().Mesh()));
  return samples.rows.rows > 0;
}

using Ends = std::array<double, 6>;

/// Identifies an edge by the coordinates of its ends, in an order that all ranks share.
Ends EndsOf(const TriangleEdge& edge, const TriangleMesh& mesh)
{
  const auto corner = edge.Ends(mesh);
  const Vec3& a = mesh.points[std::min(corner[0], corner[1])];
  const Vec3& b = mesh.points[std::max(corner[0], corner[1])];
  return { a[0], a[1], a[2], b[0], b[1], b[2] };
}

/// Collective. Boundary edges of the triangles that this rank integrates, with hats. If one end of
/// an edge is in this rank's cells, this rank knows whether another triangle has the edge.
/// Otherwise the rank that owns the first end decides.
/// @param edges  edges with one received triangle
std::vector<TriangleEdge> EdgesOfHats(
  const RankLevels& levels, const std::vector<TriangleEdge>& edges)
{
  const RankSpace& space = levels.Space();
  const Communicator& ranks = space.Ranks();
  const TriangleMesh& mesh = space.Own().Mesh();
  std::vector<TriangleEdge> found;
  std::vector<std::vector<Ends>> asked(ranks.Size());
  std::vector<std::vector<TriangleEdge>> open(ranks.Size());
  ranks.Together(
    [&]
    {
      for (const TriangleEdge& edge : edges)
      {
        if (levels.Hats()->IsIntegrated()[edge.triangle] == 0.0)
        {
          continue;
        }
        const auto corner = edge.Ends(mesh);
        const int first = space.OwnerOfPoint(mesh.points[std::min(corner[0], corner[1])]);
        const int other = space.OwnerOfPoint(mesh.points[std::max(corner[0], corner[1])]);
        if (first == ranks.Rank() || other == ranks.Rank())
        {
          found.push_back(edge);
          continue;
        }
        asked[first].push_back(EndsOf(edge, mesh));
        open[first].push_back(edge);
      }
    });
  asked = ranks.Exchange(asked);
  std::vector<std::vector<char>> told(ranks.Size());
  ranks.Together(
    [&]
    {
      std::vector<Ends> here;
      for (const TriangleEdge& edge : edges)
      {
        here.push_back(EndsOf(edge, mesh));
      }
      std::sort(here.begin(), here.end());
      for (int rank = 0; rank < ranks.Size(); ++rank)
      {
        for (const Ends& ends : asked[rank])
        {
          told[rank].push_back(std::binary_search(here.begin(), here.end(), ends));
        }
      }
    });
  told = ranks.Exchange(told, SizesOf(open));
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    for (std::size_t k = 0; k < told[rank].size(); ++k)
    {
      if (told[rank][k])
      {
        found.push_back(open[rank][k]);
      }
    }
  }
  return found;
}

/// Rows of received points: 1 at ends of the edges, followed by the values.
MultiVector RowsOfEnds(
  const TriangleMesh& mesh, const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  MultiVector rows = MultiVector::Zero(values.rows(), 1 + values.cols());
  for (const Id end : EndsOf(edges, mesh))
  {
    rows.row(end) << 1.0, values.row(end);
  }
  return rows;
}

/// Collective. The boundary edges that this rank samples. A rank that owns a point, or a cell that
/// an edge runs through, has received all triangles with them.
std::vector<TriangleEdge> BoundaryEdges(const RankLevels& levels, bool weldCoincidentPoints)
{
  const RankSpace& space = levels.Space();
  std::vector<TriangleEdge> edges;
  space.Ranks().Together(
    [&] { edges = FindSurfaceEdges(space.Own().Mesh(), weldCoincidentPoints).boundary; });
  return levels.Hats() ? EdgesOfHats(levels, edges) : edges;
}

} // namespace

BoundaryTerms TermsOnBoundary(const RankLevels& levels, bool weldCoincidentPoints,
  const MultiVector* flux, const MultiVector* values)
{
  const RankSpace& space = levels.Space();
  const Communicator& ranks = space.Ranks();
  const FiniteElementSpace& own = levels.Own();
  const TriangleMesh& mesh = space.Own().Mesh();
  const std::vector<TriangleEdge> edges = BoundaryEdges(levels, weldCoincidentPoints);
  double parts = 0.0;
  ranks.Together(
    [&] { parts = (levels.Hats() ? !edges.empty() : HasPart(space, edges)) ? 1.0 : 0.0; });
  ranks.Sum(&parts, 1);
  BoundaryTerms terms;
  terms.isThere = parts > 0.0;
  if (terms.isThere && flux)
  {
    const MultiVector received = space.Distribution().SendPoints(*flux);
    ranks.Together([&] { terms.load = LoadOnEdges(own, mesh, edges, received); });
    levels.Distributed(0)->Sum(terms.load);
  }
  if (terms.isThere && values)
  {
    const MultiVector received = space.Distribution().SendPoints(*values);
    std::vector<TriangleEdge> known;
    MultiVector atEnds;
    ranks.Together(
      [&]
      {
        known = KnownEdges(mesh, edges, received);
        atEnds = RowsOfEnds(mesh, known, received);
      });
    terms.held = HoldReceived(levels, atEnds);
    ranks.Together(
      [&] { terms.held = Join(terms.held, HoldWithinEdges(own, mesh, known, received)); });
  }
  return terms;
}

EdgeSamples SampleBoundary(const RankLevels& levels, bool weldCoincidentPoints)
{
  const RankSpace& space = levels.Space();
  const std::vector<TriangleEdge> edges = BoundaryEdges(levels, weldCoincidentPoints);
  EdgeSamples samples;
  space.Ranks().Together(
    [&] { samples = levels.Own().SamplesOfSegments(SegmentsOf(edges, space.Own().Mesh())); });
  return samples;
}

} // namespace gridfem
