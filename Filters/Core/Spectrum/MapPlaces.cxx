#include "Spectrum/MapPlaces.h"

#include "Base/Grouping.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// A quadratic function of two weights: a s² + 2 b s t + c t² - 2 d s - 2 e t.
struct Quadratic
{
  double a, b, c, d, e;

  double At(double s, double t) const
  {
    return a * s * s + 2.0 * b * s * t + c * t * t - 2.0 * d * s - 2.0 * e * t;
  }
};

double Clamped(double numerator, double denominator)
{
  return denominator > 0.0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
}

/// Returns the least place with s, t >= 0 and s + t <= 1: inside, or on one of the three sides.
std::array<double, 2> Least(const Quadratic& q)
{
  const double determinant = q.a * q.c - q.b * q.b;
  if (determinant > 1e-12 * q.a * q.c)
  {
    const double s = (q.c * q.d - q.b * q.e) / determinant;
    const double t = (q.a * q.e - q.b * q.d) / determinant;
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0)
    {
      return { s, t };
    }
  }
  const double onThird = Clamped(q.d - q.e - q.b + q.c, q.a - 2.0 * q.b + q.c);
  const std::array<std::array<double, 2>, 3> onSides = { { { Clamped(q.d, q.a), 0.0 },
    { 0.0, Clamped(q.e, q.c) }, { onThird, 1.0 - onThird } } };
  return *std::min_element(onSides.begin(), onSides.end(),
    [&](const auto& left, const auto& right)
    { return q.At(left[0], left[1]) < q.At(right[0], right[1]); });
}

} // namespace

MapPlaces::MapPlaces(const TriangleMesh& mesh, const ModeRows& rows, const MultiVector& embedded)
  : embedded_(embedded)
{
  const Array<Index> place = WeldCoincidentPoints(mesh.points, UsedPoints(mesh));
  for (const Id point : rows.point)
  {
    classOf_.push_back(place[point]);
  }
  std::vector<Index> corners;
  for (const std::array<Id, 3>& triangle : mesh.triangles)
  {
    const std::array<Id, 3> ofRows = { rows.rowOf[triangle[0]], rows.rowOf[triangle[1]],
      rows.rowOf[triangle[2]] };
    if (*std::min_element(ofRows.begin(), ofRows.end()) >= 0)
    {
      triangles_.push_back(ofRows);
      for (const Id corner : triangle)
      {
        corners.push_back(place[corner]);
      }
    }
  }
  around_ = GroupItems(
    corners.data(), static_cast<Id>(corners.size()), static_cast<Id>(mesh.points.size()));
}

PlaceOfMap MapPlaces::Nearest(Id row, const Eigen::RowVectorXd& query) const
{
  PlaceOfMap nearest{ { row, row, row }, { 1.0, 0.0, 0.0 }, (query - embedded_.row(row)).norm() };
  double least = nearest.distance * nearest.distance;
  const Index place = classOf_[row];
  for (Index k = around_.begin[place]; k < around_.begin[place + 1]; ++k)
  {
    const std::array<Id, 3>& triangle = triangles_[around_.item[k] / 3];
    const Index corner = around_.item[k] % 3;
    const Id first = triangle[corner]; // a copy of the row
    const Id second = triangle[(corner + 1) % 3];
    const Id third = triangle[(corner + 2) % 3];
    const Eigen::RowVectorXd away = query - embedded_.row(first);
    const Eigen::RowVectorXd u = embedded_.row(second) - embedded_.row(first);
    const Eigen::RowVectorXd v = embedded_.row(third) - embedded_.row(first);
    const Quadratic square{ u.squaredNorm(), u.dot(v), v.squaredNorm(), u.dot(away), v.dot(away) };
    const auto [s, t] = Least(square);
    const double distance = std::max(0.0, away.squaredNorm() + square.At(s, t));
    if (distance < least)
    {
      least = distance;
      nearest = { { first, second, third }, { 1.0 - s - t, s, t }, std::sqrt(distance) };
    }
  }
  return nearest;
}

} // namespace gridfem
