#include "Integrals/MotionMetric.h"

#include "Base/Errors.h"

namespace gridfem
{
namespace
{

/// Two edges of a triangle and its unit normal as columns.
struct Frame
{
  Eigen::Matrix3d columns;
  bool isFlat;

  Frame(const TriangleMesh& mesh, Id triangle)
  {
    constexpr double SmallestHeight = 1e-10; // of the longest edge, as in PlaneTensor
    const std::array<Id, 3>& corner = mesh.triangles[triangle];
    const Vec3 a = mesh.points[corner[1]] - mesh.points[corner[0]];
    const Vec3 b = mesh.points[corner[2]] - mesh.points[corner[0]];
    const double longest2 = std::max({ a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm() });
    const Vec3 normal = a.cross(b);
    isFlat = !(normal.norm() > SmallestHeight * longest2);
    columns << a, b, normal.normalized();
  }
};

/// The linear map of a triangle, normal to normal; the identity where the triangle is flat.
Eigen::Matrix3d MapOf(const Frame& from, const Frame& to)
{
  if (from.isFlat || to.isFlat)
  {
    return Eigen::Matrix3d::Identity();
  }
  return to.columns * from.columns.inverse();
}

void RequireSameTriangles(const TriangleMesh& mesh, const TriangleMesh& moved)
{
  if (mesh.points.size() != moved.points.size() || mesh.triangles != moved.triangles)
  {
    throw InvalidInput("A mesh that has moved has other triangles than before.");
  }
}

/// Every vector of a row times a matrix.
void MapVectors(
  const Eigen::Matrix3d& map, const MultiVector& from, Id fromRow, MultiVector& to, Id toRow)
{
  for (Id c = 0; c < from.cols(); c += 3)
  {
    const Vec3 vector(from(fromRow, c), from(fromRow, c + 1), from(fromRow, c + 2));
    to.row(toRow).segment<3>(c) = (map * vector).transpose();
  }
}

} // namespace

std::optional<TriangleMetric> MetricOfMotion(const TriangleMesh& mesh, const TriangleMesh& moved)
{
  RequireSameTriangles(mesh, moved);
  const auto count = static_cast<Id>(mesh.triangles.size());
  TriangleMetric metric;
  metric.area.resize(count);
  metric.tensor.resize(count);
  for (Id t = 0; t < count; ++t)
  {
    const Frame from(mesh, t);
    const Frame to(moved, t);
    const Eigen::Matrix3d map = MapOf(from, to);
    const PlaneTensor plane(mesh, t, map.transpose() * map);
    if (from.isFlat != to.isFlat || !plane.IsMetric())
    {
      return std::nullopt;
    }
    metric.area[t] = plane.Area();
    metric.tensor[t] = plane.InverseTimesArea();
  }
  return metric;
}

Field PullBack(const TriangleMesh& mesh, const TriangleMesh& moved, const Field& s)
{
  RequireSameTriangles(mesh, moved);
  RequireVectors(s, moved);
  const bool isConstant = s.association == FieldAssociation::Triangles;
  const Id rows = isConstant ? 1 : 3;
  Field result;
  result.association = isConstant ? FieldAssociation::Triangles : FieldAssociation::Corners;
  result.values.resize(rows * static_cast<Id>(mesh.triangles.size()), s.values.cols());
  for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
  {
    const Eigen::Matrix3d map = MapOf(Frame(mesh, t), Frame(moved, t)).transpose();
    const std::array<Id, 3> given = s.RowsOf(t, mesh.triangles[t]);
    for (Id k = 0; k < rows; ++k)
    {
      MapVectors(map, s.values, given[k], result.values, rows * t + k);
    }
  }
  return result;
}

MultiVector PushForward(
  const TriangleMesh& mesh, const TriangleMesh& moved, const MultiVector& gradients)
{
  RequireSameTriangles(mesh, moved);
  MultiVector result(gradients.rows(), gradients.cols());
  for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
  {
    const Eigen::Matrix3d back = MapOf(Frame(moved, t), Frame(mesh, t)).transpose(); // J⁻ᵀ
    MapVectors(back, gradients, t, result, t);
  }
  return result;
}

} // namespace gridfem
