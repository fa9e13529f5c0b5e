#include "Equations/HeldBoundary.h"

#include "Base/VectorRows.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// β, per unit of length. On grids of depth 4 to 6, a catenoid comes to rest equally close to the
/// exact one for 10 to 1,000, but not for 3 or less. On coarse meshes with many holes the boundary
/// is off by half as much with 100 as with 30. Iterations do not grow.
constexpr double Stiffness = 100.0;

/// The outward unit normal of an edge in the plane of its triangle; 0 if the triangle has no area.
Vec3 Conormal(const TriangleEdge& edge, const std::vector<Vec3>& points,
  const std::vector<std::array<Id, 3>>& triangles)
{
  const std::array<Id, 3>& corners = triangles[edge.triangle];
  const Vec3& from = points[corners[edge.corner]];
  const Vec3 along = points[corners[(edge.corner + 1) % 3]] - from;
  const Vec3 inwards = points[corners[(edge.corner + 2) % 3]] - from;
  const double length2 = along.squaredNorm();
  const Vec3 across =
    length2 > 0.0 ? Vec3(inwards.dot(along) / length2 * along - inwards) : Vec3(Vec3::Zero());
  const double height = across.norm();
  return height > 0.0 ? Vec3(across / height) : Vec3(Vec3::Zero());
}

} // namespace

HeldBoundary::HeldBoundary(const FiniteElementSpace& space, const TriangleMesh& mesh,
  std::vector<TriangleEdge> edges, double timeStep, int threads)
  : edges_(std::move(edges))
{
  EdgeSamples samples = space.SamplesOfSegments(SegmentsOf(edges_, mesh));
  place_.resize(samples.rows.rows, 3);
  for (Index row = 0; row < samples.rows.rows; ++row)
  {
    const std::array<Id, 2> ends = edges_[samples.edge[row]].Ends(mesh);
    const double t = samples.position[row];
    const Vec3 place = (1.0 - t) * mesh.points[ends[0]] + t * mesh.points[ends[1]];
    SetRow(place_, row, (place - space.Origin()) / space.UnitLength());
  }
  edgeOfRow_ = std::move(samples.edge);
  std::vector<double> weight = std::move(samples.length);
  for (double& length : weight)
  {
    length *= timeStep * Stiffness / space.UnitLength();
  }
  penalty_ = RowPenalty(space, std::move(samples.rows), std::move(weight), threads);
}

MultiVector HeldBoundary::Load(const std::vector<Vec3>& points,
  const std::vector<std::array<Id, 3>>& triangles, const MultiVector& shift, int threads) const
{
  MultiVector values;
  Multiply(penalty_.Rows(), shift, values, threads);
  values = place_ - values;
  for (Id row = 0; row < values.rows(); ++row)
  {
    const Vec3 conormal = Conormal(edges_[edgeOfRow_[row]], points, triangles);
    SetRow(values, row, RowOf(values, row) + conormal / Stiffness);
  }
  return penalty_.LoadOf(values, threads);
}

} // namespace gridfem
