#include "Problems/PartialField.h"

#include "Base/Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

std::vector<double> WeightsOfTriangles(const Field* weight, const TriangleMesh& mesh)
{
  std::vector<double> ofTriangle(mesh.triangles.size(), 1.0);
  for (std::size_t t = 0; weight && t < ofTriangle.size(); ++t)
  {
    double sum = 0.0;
    for (const Id row : weight->RowsOf(static_cast<Id>(t), mesh.triangles[t]))
    {
      sum += weight->values(row, 0);
      if (!(weight->values(row, 0) >= 0.0) || std::isinf(weight->values(row, 0)))
      {
        throw InvalidInput("The weight of the values must be a number of 0 or more.");
      }
    }
    ofTriangle[t] = sum / 3.0;
  }
  return ofTriangle;
}

/// Which rows have no NaN; those that have become 0.
std::vector<char> TakeOutUnknown(MultiVector& rows)
{
  std::vector<char> isKnown(rows.rows());
  for (Id row = 0; row < rows.rows(); ++row)
  {
    isKnown[row] = !rows.row(row).hasNaN();
    if (!isKnown[row])
    {
      rows.row(row).setZero();
    }
  }
  return isKnown;
}

} // namespace

PartialField SplitField(Field field, const Field* weight, const TriangleMesh& mesh)
{
  RequireField(field, mesh);
  RequireScale(weight, mesh);
  PartialField partial;
  partial.weight = WeightsOfTriangles(weight, mesh);
  partial.values = std::move(field);
  const std::vector<char> isKnown = TakeOutUnknown(partial.values.values);
  const bool isOnPoints = partial.values.association == FieldAssociation::Points;
  std::vector<char> counts(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    const auto rows = partial.values.RowsOf(static_cast<Id>(t), corner);
    const bool isWhole =
      std::all_of(rows.begin(), rows.end(), [&](Id row) { return isKnown[row]; });
    for (const Id point : corner)
    {
      counts[point] |= isWhole;
    }
    partial.isKnown.push_back(isWhole);
    partial.weight[t] *= isWhole;
  }
  const std::vector<char> used = UsedPoints(mesh);
  for (std::size_t point = 0; isOnPoints && point < used.size(); ++point)
  {
    partial.numberOfIgnoredPoints += used[point] && isKnown[point] && !counts[point];
  }
  return partial;
}

Field ScaleOfKnown(const PartialField& field, const Field* scale, const TriangleMesh& mesh)
{
  RequireScale(scale, mesh);
  Field known{ FieldAssociation::Triangles,
    MultiVector::Zero(static_cast<Id>(mesh.triangles.size()), 1) };
  for (Id t = 0; t < known.values.rows(); ++t)
  {
    for (const Id row : scale ? scale->RowsOf(t, mesh.triangles[t]) : std::array<Id, 3>{})
    {
      known.values(t, 0) += field.isKnown[t] * (scale ? scale->values(row, 0) : 1.0) / 3.0;
    }
  }
  return known;
}

MultiVector MeansOfKnown(const FiniteElementSpace& space, const PartialField& field, const Job& job)
{
  const std::vector<double> isKnown(field.isKnown.begin(), field.isKnown.end());
  const Components components = space.ComponentsOf(0, job);
  const Field one{ FieldAssociation::Triangles,
    MultiVector::Ones(static_cast<Id>(isKnown.size()), 1) };
  const MultiVector load = space.LoadOfWeightedValues(field.values, isKnown, job.Part(0.0, 0.5));
  const MultiVector area = space.LoadOfWeightedValues(one, isKnown, job.Part(0.5, 1.0));
  MultiVector sum = MultiVector::Zero(components.count, load.cols());
  std::vector<double> size(components.count, 0.0);
  for (Id i = 0; i < load.rows(); ++i)
  {
    sum.row(components.ofFunction[i]) += load.row(i);
    size[components.ofFunction[i]] += area(i, 0);
  }
  for (Id c = 0; c < sum.rows(); ++c)
  {
    sum.row(c) *= size[c] > 0.0 ? 1.0 / size[c] : std::numeric_limits<double>::quiet_NaN();
  }
  return sum;
}

} // namespace gridfem
