#include "Distance/MarchedDistance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace gridfem
{
namespace
{

constexpr double Unreached = std::numeric_limits<double>::infinity();

/// The distance at a corner of a triangle, given the distances at the two others. A straight front
/// with these distances arrives across the triangle, or else along an edge.
/// @param a, b  the other corners, relative to this one
double CrossTriangle(const Vec3& a, double distanceA, const Vec3& b, double distanceB)
{
  const double alongEdges = std::min(distanceA + a.norm(), distanceB + b.norm());
  if (!std::isfinite(distanceA) || !std::isfinite(distanceB))
  {
    return alongEdges;
  }
  // The gradient Σ w_k (d_k - d) of the front has length 1, with w dual to the edges. This is a
  // quadratic equation in d.
  Eigen::Matrix2d products;
  products << a.dot(a), a.dot(b), a.dot(b), b.dot(b);
  const Eigen::Matrix2d dual = products.inverse();
  const Eigen::Vector2d known(distanceA, distanceB);
  const Eigen::Vector2d sums = dual.rowwise().sum();
  const double square = sums.sum();
  const double linear = sums.dot(known);
  const double discriminant = linear * linear - square * (known.dot(dual * known) - 1.0);
  if (!(discriminant >= 0.0) || !(square > 0.0))
  {
    return alongEdges;
  }
  const double distance = (linear + std::sqrt(discriminant)) / square;
  const Eigen::Vector2d cameFrom = dual * (distance - known.array()).matrix();
  return cameFrom.minCoeff() > 0.0 ? std::min(distance, alongEdges) : alongEdges;
}

/// Distances at the functions of the mesh, and the functions that the front reaches next.
class Front
{
public:
  Front(const TriangleMesh& mesh, const HatFunctions& hats, double limit)
    : mesh_(mesh), hats_(hats), limit_(limit), distance_(hats.Count(), Unreached),
      isFinal_(hats.Count(), 0)
  {
  }

  void Reach(Index function, double distance)
  {
    if (distance <= limit_ && distance < distance_[function])
    {
      distance_[function] = distance;
      next_.emplace(distance, function);
    }
  }

  void March()
  {
    while (!next_.empty())
    {
      const Index function = next_.top().second;
      next_.pop();
      if (!isFinal_[function])
      {
        isFinal_[function] = 1;
        this->Advance(function);
      }
    }
  }

  double At(Index function) const { return distance_[function]; }

private:
  using Entry = std::pair<double, Index>;

  double FinalAt(Index function) const
  {
    return isFinal_[function] ? distance_[function] : Unreached;
  }

  void Advance(Index function)
  {
    for (Index k = hats_.begin[function]; k < hats_.begin[function + 1]; ++k)
    {
      const TriangleCorner here = hats_.corners[k];
      const auto& triangle = mesh_.triangles[here.Triangle()];
      const Id from = triangle[here.Corner()];
      for (const int step : { 1, 2 })
      {
        const Id to = triangle[(here.Corner() + step) % 3];
        const Id other = triangle[(here.Corner() + 3 - step) % 3];
        const Vec3& origin = mesh_.points[to];
        this->Reach(
          hats_.ofPoint[to], CrossTriangle(mesh_.points[from] - origin, distance_[function],
                               mesh_.points[other] - origin, this->FinalAt(hats_.ofPoint[other])));
      }
    }
  }

  const TriangleMesh& mesh_;
  const HatFunctions& hats_;
  double limit_;
  std::vector<double> distance_;
  std::vector<char> isFinal_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> next_;
};

} // namespace

std::vector<double> MarchDistance(const TriangleMesh& mesh, const HatFunctions& hats,
  const std::vector<char>& isSource, double limit)
{
  Front front(mesh, hats, limit);
  const auto points = static_cast<Id>(mesh.points.size());
  for (Id point = 0; point < points; ++point)
  {
    if (isSource[point] && hats.ofPoint[point] >= 0)
    {
      front.Reach(hats.ofPoint[point], 0.0);
    }
  }
  front.March();
  std::vector<double> distance(points, Unreached);
  for (Id point = 0; point < points; ++point)
  {
    distance[point] = isSource[point]            ? 0.0
                      : hats.ofPoint[point] >= 0 ? front.At(hats.ofPoint[point])
                                                 : Unreached;
  }
  return distance;
}

} // namespace gridfem
