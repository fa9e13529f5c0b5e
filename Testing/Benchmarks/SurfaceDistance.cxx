#include "SurfaceDistance.h"

#include "Largest.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace gridfem::benchmarks
{

namespace
{

using Cell = std::array<int, 3>;

struct CellHash
{
  std::size_t operator()(const Cell& cell) const
  {
    std::size_t hash = 0;
    for (const int k : cell)
    {
      hash = hash * 0x9e3779b97f4a7c15u + static_cast<unsigned>(k);
    }
    return hash ^ (hash >> 29);
  }
};

/// The triangles in each cell of a grid that their bounding boxes touch.
class TriangleCells
{
public:
  TriangleCells(const std::vector<Vec3>& points, const TriangleMesh& mesh)
    : points_(points), mesh_(mesh)
  {
    double sum = 0.0;
    for (const auto& corner : mesh.triangles)
    {
      sum += (points[corner[1]] - points[corner[0]]).norm();
    }
    size_ = 2.0 * sum / static_cast<double>(mesh.triangles.size()) + 1e-300;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      Vec3 low = points[mesh.triangles[t][0]];
      Vec3 high = low;
      for (const Id point : mesh.triangles[t])
      {
        low = low.cwiseMin(points[point]);
        high = high.cwiseMax(points[point]);
      }
      this->ForEachCell(low, high, [&](const Cell& cell) { inCell_[cell].push_back(t); });
    }
  }

  /// @param bound  some distance to the surface that is known
  double Distance(const Vec3& p, double bound) const
  {
    double least = bound;
    const Vec3 reach = Vec3::Constant(bound);
    this->ForEachCell(p - reach, p + reach,
      [&](const Cell& cell)
      {
        const auto found = inCell_.find(cell);
        for (std::size_t k = 0; found != inCell_.end() && k < found->second.size(); ++k)
        {
          least = std::min(least, this->DistanceTo(found->second[k], p));
        }
      });
    return least;
  }

  double DistanceTo(std::size_t triangle, const Vec3& p) const
  {
    const auto& corner = mesh_.triangles[triangle];
    return DistanceToTriangle(p, points_[corner[0]], points_[corner[1]], points_[corner[2]]);
  }

private:
  template<class Body>
  void ForEachCell(const Vec3& low, const Vec3& high, Body&& body) const
  {
    Cell first;
    Cell last;
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = static_cast<int>(std::floor(low[axis] / size_));
      last[axis] = static_cast<int>(std::floor(high[axis] / size_));
    }
    for (int x = first[0]; x <= last[0]; ++x)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        for (int z = first[2]; z <= last[2]; ++z)
        {
          body({ x, y, z });
        }
      }
    }
  }

  const std::vector<Vec3>& points_;
  const TriangleMesh& mesh_;
  double size_ = 1.0;
  std::unordered_map<Cell, std::vector<std::size_t>, CellHash> inCell_;
};

double DistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

} // namespace

double DistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 normal = (b - a).cross(c - a);
  const bool isAbove = normal.squaredNorm() > 0.0 && (b - a).cross(p - a).dot(normal) >= 0.0 &&
                       (c - b).cross(p - b).dot(normal) >= 0.0 &&
                       (a - c).cross(p - c).dot(normal) >= 0.0;
  if (isAbove)
  {
    return std::abs((p - a).dot(normal)) / normal.norm();
  }
  return std::min(
    { DistanceToSegment(p, a, b), DistanceToSegment(p, b, c), DistanceToSegment(p, c, a) });
}

SurfaceDistance DistanceBetween(
  const std::vector<Vec3>& points, const std::vector<Vec3>& others, const TriangleMesh& mesh)
{
  const TriangleCells cells(others, mesh);
  std::vector<double> bound(points.size(), -1.0); // of points without a triangle
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const Id k : mesh.triangles[t])
    {
      const double own = cells.DistanceTo(t, points[k]);
      bound[k] = bound[k] < 0.0 ? own : std::min(bound[k], own);
    }
  }
  SurfaceDistance distance;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (bound[k] >= 0.0)
    {
      const double least = cells.Distance(points[k], bound[k]);
      distance.largest = testing::Larger(distance.largest, least);
      sum += least * least;
      count += 1.0;
    }
  }
  distance.rms = std::sqrt(sum / count);
  return distance;
}

} // namespace gridfem::benchmarks
