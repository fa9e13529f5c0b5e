#include "Problems/EdgeConditions.h"

#include "Algebra/RowBuilder.h"
#include "Base/Errors.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>

namespace gridfem
{
namespace
{

void CheckValues(const TriangleMesh& mesh, const MultiVector& values)
{
  if (values.rows() != static_cast<Id>(mesh.points.size()))
  {
    throw InvalidInput("There are " + std::to_string(values.rows()) + " values on edges for " +
                       std::to_string(mesh.points.size()) + " points.");
  }
}

/// The values of a function at the samples. It is linear along the edges.
MultiVector AtSamples(const EdgeSamples& samples, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  MultiVector result(samples.rows.rows, values.cols());
  for (Id k = 0; k < result.rows(); ++k)
  {
    const auto ends = edges[samples.edge[k]].Ends(mesh);
    const double t = samples.position[k];
    result.row(k) = (1.0 - t) * values.row(ends[0]) + t * values.row(ends[1]);
  }
  return result;
}

void AppendRow(const SparseMatrix& matrix, Index row, RowBuilder& rows)
{
  RowBuilder::Entries entries;
  for (Id k = matrix.rowBegin[row]; k < matrix.rowBegin[row + 1]; ++k)
  {
    entries.emplace_back(matrix.column[k], matrix.value[k]);
  }
  rows.Append(entries);
}

} // namespace

HeldValues HoldPoints(
  const FiniteElementSpace& space, const std::vector<Id>& points, MultiVector values)
{
  return { space.RowsAtPoints(points), std::move(values) };
}

HeldValues Join(const HeldValues& first, const HeldValues& second)
{
  HeldValues both;
  both.values.resize(first.values.rows() + second.values.rows(), first.values.cols());
  both.values << first.values, second.values;
  RowBuilder rows;
  for (const HeldValues* part : { &first, &second })
  {
    for (Index row = 0; row < part->rows.rows; ++row)
    {
      AppendRow(part->rows, row, rows);
    }
  }
  both.rows = rows.Finish(first.rows.columns);
  return both;
}

std::vector<TriangleEdge> KnownEdges(
  const TriangleMesh& mesh, const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  CheckValues(mesh, values);
  std::vector<TriangleEdge> known;
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(known),
    [&](const TriangleEdge& edge)
    {
      const auto own = edge.Ends(mesh);
      return !values.row(own[0]).hasNaN() && !values.row(own[1]).hasNaN();
    });
  return known;
}

HeldValues HoldWithinEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  std::vector<TriangleEdge> longEdges;
  for (const TriangleEdge& edge : edges)
  {
    const auto own = edge.Ends(mesh);
    if ((mesh.points[own[1]] - mesh.points[own[0]]).norm() > space.UnitLength())
    {
      longEdges.push_back(edge);
    }
  }
  const EdgeSamples samples = space.SamplesOfSegments(SegmentsOf(longEdges, mesh));
  const MultiVector atSamples = AtSamples(samples, mesh, longEdges, values);
  HeldValues held;
  held.values.resize(
    std::count(samples.isMiddle.begin(), samples.isMiddle.end(), 1), values.cols());
  RowBuilder rows;
  Id next = 0;
  for (Index row = 0; row < samples.rows.rows; ++row)
  {
    if (samples.isMiddle[row])
    {
      AppendRow(samples.rows, row, rows);
      held.values.row(next++) = atSamples.row(row);
    }
  }
  held.rows = rows.Finish(samples.rows.columns);
  return held;
}

HeldValues HoldEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  const std::vector<TriangleEdge> known = KnownEdges(mesh, edges, values);
  const std::vector<Id> ends = EndsOf(known, mesh);
  MultiVector atEnds(static_cast<Id>(ends.size()), values.cols());
  for (Id k = 0; k < atEnds.rows(); ++k)
  {
    atEnds.row(k) = values.row(ends[k]);
  }
  return Join(
    HoldPoints(space, ends, std::move(atEnds)), HoldWithinEdges(space, mesh, known, values));
}

MultiVector LoadOnEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  CheckValues(mesh, values);
  const EdgeSamples samples = space.SamplesOfSegments(SegmentsOf(edges, mesh));
  return IntegrateAlong(samples, AtSamples(samples, mesh, edges, values));
}

namespace
{

/// Mixes the bits of a number. [Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators,
/// 2014]
std::uint64_t MixBits(std::uint64_t x)
{
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Whether each side of a triangle is passed as often in one direction as in the other, so that no
/// side is a boundary. The sum over all sides needs a twentieth of the time that finding them
/// takes. A sum of 0 by accident has a probability of 1e-19.
bool IsClosed(const TriangleMesh& mesh)
{
  std::uint64_t sum = 0;
  for (const auto& corner : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto first = static_cast<std::uint64_t>(corner[k]);
      const auto second = static_cast<std::uint64_t>(corner[k == 2 ? 0 : k + 1]);
      const std::uint64_t side =
        MixBits(MixBits(std::min(first, second) + 1) + std::max(first, second));
      sum += first < second ? side : first > second ? 0 - side : 0;
    }
  }
  return sum == 0;
}

} // namespace

BoundaryTerms TermsOnBoundary(const FiniteElementSpace& space, const TriangleMesh& mesh,
  bool weldCoincidentPoints, const MultiVector* flux, const MultiVector* values)
{
  BoundaryTerms terms;
  if (IsClosed(mesh))
  {
    return terms;
  }
  const std::vector<TriangleEdge> edges = FindSurfaceEdges(mesh, weldCoincidentPoints).boundary;
  terms.isThere = !edges.empty();
  if (terms.isThere && flux)
  {
    terms.load = LoadOnEdges(space, mesh, edges, *flux);
  }
  if (terms.isThere && values)
  {
    terms.held = HoldEdges(space, mesh, edges, *values);
  }
  return terms;
}

} // namespace gridfem
