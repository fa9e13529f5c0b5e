#include "Problems/EdgeConditions.h"

#include "Algebra/RowBuilder.h"
#include "Base/Errors.h"

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

} // namespace

HeldEdges HoldEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  CheckValues(mesh, values);
  const std::vector<Id> ends = EndsOf(edges, mesh);
  std::vector<TriangleEdge> longEdges;
  for (const TriangleEdge& edge : edges)
  {
    const auto own = edge.Ends(mesh);
    if ((mesh.points[own[1]] - mesh.points[own[0]]).norm() > space.UnitLength())
    {
      longEdges.push_back(edge);
    }
  }
  const EdgeSamples samples = space.SamplesOfEdges(longEdges);
  const MultiVector between = AtSamples(samples, mesh, longEdges, values);
  const SparseMatrix atEnds = space.RowsAtPoints(ends);
  constexpr Index PerStretch = 3; // samples, of which one is held
  HeldEdges held;
  held.values.resize(atEnds.rows + samples.rows.rows / PerStretch, values.cols());
  RowBuilder rows;
  for (Index row = 0; row < atEnds.rows; ++row)
  {
    AppendRow(atEnds, row, rows);
    held.values.row(row) = values.row(ends[row]);
  }
  for (Index row = 0; row < samples.rows.rows / PerStretch; ++row)
  {
    AppendRow(samples.rows, PerStretch * row + 1, rows);
    held.values.row(atEnds.rows + row) = between.row(PerStretch * row + 1);
  }
  held.rows = rows.Finish(atEnds.columns);
  return held;
}

MultiVector LoadOnEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  CheckValues(mesh, values);
  const EdgeSamples samples = space.SamplesOfEdges(edges);
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
