#include "Equations/PartialField.h"

#include "Algebra/DistributedRows.h"
#include "Base/Errors.h"

#include <algorithm>
#include <array>
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

/// Sets rows with NaN to 0. Returns the rows that have none.
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

/// The values of each corner of the triangles.
Field AtCorners(const Field& f, const TriangleMesh& mesh)
{
  Field corners{ FieldAssociation::Corners,
    MultiVector(3 * static_cast<Id>(mesh.triangles.size()), f.values.cols()) };
  for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
  {
    const auto rows = f.RowsOf(t, mesh.triangles[t]);
    for (int k = 0; k < 3; ++k)
    {
      corners.values.row(3 * t + k) = f.values.row(rows[k]);
    }
  }
  return corners;
}

/// Replaces the values of corners that do not count by the mean of the others.
void FillCorners(
  const std::array<Id, 3>& points, const std::vector<char>& counts, Id first, MultiVector& corners)
{
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(corners.cols());
  double number = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    if (counts[points[k]])
    {
      sum += corners.row(first + k);
      number += 1.0;
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    if (!counts[points[k]])
    {
      corners.row(first + k) = sum / number;
    }
  }
}

} // namespace

PartialField SplitField(Field field, const Field* weight, const TriangleMesh& mesh)
{
  RequireField(field, mesh);
  RequireScale(weight, mesh);
  PartialField partial;
  partial.weight = WeightsOfTriangles(weight, mesh);
  partial.values = std::move(field);
  partial.hasValue = TakeOutUnknown(partial.values.values);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    const auto rows = partial.values.RowsOf(static_cast<Id>(t), corner);
    const bool isWhole =
      std::all_of(rows.begin(), rows.end(), [&](Id row) { return partial.hasValue[row]; });
    partial.isKnown.push_back(isWhole);
    partial.weight[t] *= isWhole;
  }
  return partial;
}

void LeaveOutWeightless(
  const SurfaceSpace& space, const Field& weight, const TriangleMesh& mesh, PartialField& field)
{
  if (field.values.association != FieldAssociation::Points ||
      weight.association != FieldAssociation::Points)
  {
    return;
  }
  const auto points = static_cast<Id>(mesh.points.size());
  std::vector<char> counts(points);
  for (Id point = 0; point < points; ++point)
  {
    counts[point] = field.hasValue[point] && weight.values(point, 0) > 0.0;
  }
  const auto isCounted = [&](Id point) { return counts[point] != 0; };
  MultiVector whole = MultiVector::Zero(points, 1); // triangles whose corners all count
  for (const auto& corner : mesh.triangles)
  {
    const bool isWhole = std::all_of(corner.begin(), corner.end(), isCounted);
    for (const Id point : corner)
    {
      whole(point, 0) += isWhole;
    }
  }
  space.SumAtPoints(whole);
  const auto needsMore = [&](Id point) { return isCounted(point) && whole(point, 0) == 0.0; };
  // A value that would count is unknown.
  const auto isUnknown = [&](Id point)
  { return !field.hasValue[point] && weight.values(point, 0) > 0.0; };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    if (std::all_of(corner.begin(), corner.end(), isCounted))
    {
      continue;
    }
    field.weight[t] = 0.0;
    if (std::any_of(corner.begin(), corner.end(), needsMore) &&
        std::none_of(corner.begin(), corner.end(), isUnknown))
    {
      if (!field.counted)
      {
        field.counted = AtCorners(field.values, mesh);
      }
      FillCorners(corner, counts, 3 * static_cast<Id>(t), field.counted->values);
      field.weight[t] =
        (weight.values(corner[0], 0) + weight.values(corner[1], 0) + weight.values(corner[2], 0)) /
        3.0;
    }
  }
}

Id CountIgnoredPoints(
  const SurfaceSpace& space, const PartialField& field, const TriangleMesh& mesh)
{
  if (field.values.association != FieldAssociation::Points)
  {
    return 0;
  }
  // The number of known triangles around each point, and of the processes that have the point.
  MultiVector around = MultiVector::Zero(static_cast<Id>(mesh.points.size()), 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const Id point : mesh.triangles[t])
    {
      around(point, 0) += field.isKnown[t] || field.weight[t] > 0.0;
      around(point, 1) = 1.0;
    }
  }
  space.SumAtPoints(around);
  std::array<double, 1> ignored{ 0.0 };
  for (Id point = 0; point < around.rows(); ++point)
  {
    if (field.hasValue[point] && around(point, 0) == 0.0 && around(point, 1) > 0.0)
    {
      ignored[0] += 1.0 / around(point, 1);
    }
  }
  SumOverProcesses(space.Distributed(0), ignored);
  return std::llround(ignored[0]);
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

MultiVector MeansOfKnown(const SurfaceSpace& space, const PartialField& field, const Job& job)
{
  const std::vector<double> isKnown(field.isKnown.begin(), field.isKnown.end());
  const Components components = space.ComponentsOf(0, job);
  const Field one{ FieldAssociation::Triangles,
    MultiVector::Ones(static_cast<Id>(isKnown.size()), 1) };
  const MultiVector load = space.LoadOfWeightedValues(field.values, isKnown, job.Part(0.0, 0.5));
  const MultiVector area = space.LoadOfWeightedValues(one, isKnown, job.Part(0.5, 1.0));
  MultiVector sum = MultiVector::Zero(components.count, load.cols());
  std::vector<double> size(components.count, 0.0);
  const DistributedRows* const distributed = space.Distributed(0);
  for (Id i = GhostRows(distributed); i < load.rows(); ++i)
  {
    sum.row(components.ofFunction[i]) += load.row(i);
    size[components.ofFunction[i]] += area(i, 0);
  }
  SumOverProcesses(distributed, sum);
  SumOverProcesses(distributed, size);
  for (Id c = 0; c < sum.rows(); ++c)
  {
    sum.row(c) *= size[c] > 0.0 ? 1.0 / size[c] : std::numeric_limits<double>::quiet_NaN();
  }
  return sum;
}

} // namespace gridfem
