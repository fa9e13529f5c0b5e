#include "Problems/EdgeConditions.h"

#include "Algebra/RowBuilder.h"
#include "Base/Errors.h"

#include <algorithm>
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

/// The values of a linear function at the samples.
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

/// In the middle of each stretch.
HeldValues HoldBetween(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  constexpr Index PerStretch = 3; // samples, of which one is held
  const EdgeSamples samples = space.SamplesOfSegments(SegmentsOf(edges, mesh));
  const MultiVector atSamples = AtSamples(samples, mesh, edges, values);
  HeldValues held;
  held.values.resize(samples.rows.rows / PerStretch, values.cols());
  RowBuilder rows;
  for (Index row = 0; row < held.values.rows(); ++row)
  {
    AppendRow(samples.rows, PerStretch * row + 1, rows);
    held.values.row(row) = atSamples.row(PerStretch * row + 1);
  }
  held.rows = rows.Finish(samples.rows.columns);
  return held;
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

HeldValues HoldEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  CheckValues(mesh, values);
  std::vector<TriangleEdge> known;
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(known),
    [&](const TriangleEdge& edge)
    {
      const auto own = edge.Ends(mesh);
      return !values.row(own[0]).hasNaN() && !values.row(own[1]).hasNaN();
    });
  const std::vector<Id> ends = EndsOf(known, mesh);
  MultiVector atEnds(static_cast<Id>(ends.size()), values.cols());
  for (Id k = 0; k < atEnds.rows(); ++k)
  {
    atEnds.row(k) = values.row(ends[k]);
  }
  std::vector<TriangleEdge> longEdges;
  for (const TriangleEdge& edge : known)
  {
    const auto own = edge.Ends(mesh);
    if ((mesh.points[own[1]] - mesh.points[own[0]]).norm() > space.UnitLength())
    {
      longEdges.push_back(edge);
    }
  }
  return Join(
    HoldPoints(space, ends, std::move(atEnds)), HoldBetween(space, mesh, longEdges, values));
}

MultiVector LoadOnEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  CheckValues(mesh, values);
  const EdgeSamples samples = space.SamplesOfSegments(SegmentsOf(edges, mesh));
  const MultiVector atSamples = AtSamples(samples, mesh, edges, values);
  MultiVector load = MultiVector::Zero(samples.rows.columns, values.cols());
  for (Index row = 0; row < samples.rows.rows; ++row)
  {
    for (Id k = samples.rows.rowBegin[row]; k < samples.rows.rowBegin[row + 1]; ++k)
    {
      load.row(samples.rows.column[k]) +=
        samples.length[row] * samples.rows.value[k] * atSamples.row(row);
    }
  }
  return load;
}

} // namespace gridfem
