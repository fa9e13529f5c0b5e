#include "Parallel/RankBoundary.h"

#include "Parallel/HeldPoints.h"

namespace gridfem
{

namespace
{

/// Whether a part of the edges is in the cells of this rank. Of received triangles that end where
/// nothing more was received none is.
bool HasPart(const RankSpace& space, const std::vector<TriangleEdge>& edges)
{
  const EdgeSamples samples = space.Own().SamplesOfSegments(SegmentsOf(edges, space.Own().Mesh()));
  return samples.rows.rows > 0;
}

/// Of received points: 1 at ends of the edges, and the values.
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

} // namespace

/// Whoever has a cell that an edge runs through, or a point, has received all triangles with them.
BoundaryTerms TermsOnBoundary(const RankLevels& levels, bool weldCoincidentPoints,
  const MultiVector* flux, const MultiVector* values)
{
  const RankSpace& space = levels.Space();
  const Communicator& ranks = space.Ranks();
  const GridSpace& own = space.Own();
  std::vector<TriangleEdge> edges;
  double parts = 0.0;
  ranks.Together(
    [&]
    {
      edges = FindSurfaceEdges(own.Mesh(), weldCoincidentPoints).boundary;
      parts = HasPart(space, edges) ? 1.0 : 0.0;
    });
  ranks.Sum(&parts, 1);
  BoundaryTerms terms;
  terms.isThere = parts > 0.0;
  if (terms.isThere && flux)
  {
    const MultiVector received = space.Distribution().SendPoints(*flux);
    ranks.Together([&] { terms.load = LoadOnEdges(own, own.Mesh(), edges, received); });
    levels.Divided(0)->Sum(terms.load);
  }
  if (terms.isThere && values)
  {
    const MultiVector received = space.Distribution().SendPoints(*values);
    ranks.Together(
      [&]
      {
        const std::vector<TriangleEdge> known = KnownEdges(own.Mesh(), edges, received);
        terms.held = Join(HoldReceived(space, RowsOfEnds(own.Mesh(), known, received)),
          HoldWithinEdges(own, own.Mesh(), known, received));
      });
  }
  return terms;
}

} // namespace gridfem
