#include "Integrals/MotionMetric.h"

#include "Base/Errors.h"

namespace gridfem
{
namespace
{

/// Returns the linear map between two triangles, which maps normal to normal. Returns the identity
/// if a triangle is flat.
Eigen::Matrix3d MapOf(const TriangleFrame& from, const TriangleFrame& to)
{
  if (from.isFlat || to.isFlat)
  {
    return Eigen::Matrix3d::Identity();
  }
  const auto columnsOf = [](const TriangleFrame& frame)
  {
    Eigen::Matrix3d columns;
    columns << frame.a, frame.b, frame.normal.normalized();
    return columns;
  };
  return columnsOf(to) * columnsOf(from).inverse();
}

void RequireSameTriangles(const TriangleMesh& mesh, const TriangleMesh& moved)
{
  if (mesh.points.size() != moved.points.size() || mesh.triangles != moved.triangles)
  {
    throw InvalidInput("A mesh that has moved has other triangles than before.");
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
    const TriangleFrame from(mesh, t);
    const TriangleFrame to(moved, t);
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
  return MapVectors(mesh, s,
    [&](Id t) -> Eigen::Matrix3d
    { return MapOf(TriangleFrame(mesh, t), TriangleFrame(moved, t)).transpose(); });
}

} // namespace gridfem
