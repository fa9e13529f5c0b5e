#include "Shape/DiskMetric.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

constexpr double Degree = double(EIGEN_PI) / 180.0;

/// The least difference between the sum of two sides and the third, relative to the mean side.
constexpr double LeastSlack = 1e-9;

Vec2 PointOf(const MultiVector& plane, Index vertex)
{
  return plane.row(vertex).transpose();
}

double CrossProduct(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

double TwiceAreaInPlane(const std::array<Index, 3>& corner, const MultiVector& plane)
{
  const Vec2 origin = PointOf(plane, corner[0]);
  return CrossProduct(PointOf(plane, corner[1]) - origin, PointOf(plane, corner[2]) - origin);
}

} // namespace

double SideLengths::Area() const
{
  std::array<double, 3> side = length;
  std::sort(side.begin(), side.end());
  const auto [c, b, a] = side;
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return 0.25 * std::sqrt(std::max(product, 0.0));
}

double SideLengths::AngleAt(int corner) const
{
  const double a = length[(corner + 1) % 3];
  const double b = length[corner];
  const double c = length[(corner + 2) % 3];
  return std::atan2(4.0 * this->Area(), b * b + c * c - a * a);
}

double SideLengths::CotangentAt(int corner) const
{
  const double a = length[(corner + 1) % 3];
  const double b = length[corner];
  const double c = length[(corner + 2) % 3];
  return (b * b + c * c - a * a) / (4.0 * this->Area());
}

std::array<Vec2, 3> SideLengths::InPlane() const
{
  const double b = length[0];
  const double x = (b * b + length[2] * length[2] - length[1] * length[1]) / (2.0 * b);
  return { Vec2(0.0, 0.0), Vec2(b, 0.0), Vec2(x, 2.0 * this->Area() / b) };
}

std::vector<SideLengths> MeasureTriangles(const Disk& disk)
{
  std::vector<SideLengths> sides;
  double sum = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& corner : disk.triangles)
  {
    SideLengths triangle{};
    for (int k = 0; k < 3; ++k)
    {
      triangle.length[k] = (disk.points[corner[(k + 1) % 3]] - disk.points[corner[k]]).norm();
    }
    const auto& l = triangle.length;
    const double total = l[0] + l[1] + l[2];
    sum += total;
    least = std::min(least, total - 2.0 * std::max({ l[0], l[1], l[2] }));
    sides.push_back(triangle);
  }
  const double wanted = LeastSlack * sum / (3.0 * static_cast<double>(sides.size()));
  if (least < wanted)
  {
    for (SideLengths& triangle : sides)
    {
      for (double& length : triangle.length)
      {
        length += wanted - least;
      }
    }
  }
  return sides;
}

std::vector<ChartDistortion> MeasureDistortion(
  const Disk& disk, const std::vector<SideLengths>& sides, const MultiVector& plane)
{
  std::vector<ChartDistortion> distortions;
  for (std::size_t t = 0; t < disk.triangles.size(); ++t)
  {
    const auto& corner = disk.triangles[t];
    const auto flat = sides[t].InPlane();
    const Vec2 origin = PointOf(plane, corner[0]);
    Eigen::Matrix2d from;
    Eigen::Matrix2d to;
    from << flat[1], flat[2];
    to << PointOf(plane, corner[1]) - origin, PointOf(plane, corner[2]) - origin;
    const Eigen::Matrix2d J = to * from.inverse();
    // The part that keeps angles, and the part that mirrors them. Their sizes are half the sum and
    // half the difference of the singular values.
    const double keeps = std::hypot(J(0, 0) + J(1, 1), J(1, 0) - J(0, 1));
    const double mirrors = std::hypot(J(0, 0) - J(1, 1), J(1, 0) + J(0, 1));
    ChartDistortion distortion{};
    distortion.isFlipped = !(TwiceAreaInPlane(corner, plane) > 0.0);
    distortion.angle =
      distortion.isFlipped ? 180.0 : 2.0 * std::asin(std::min(mirrors / keeps, 1.0)) / Degree;
    distortion.area =
      std::log2(std::max(std::abs(J.determinant()), std::numeric_limits<double>::min()));
    distortions.push_back(distortion);
  }
  return distortions;
}

double AreaInPlane(const Disk& disk, const MultiVector& plane)
{
  double area = 0.0;
  for (std::size_t t = 0; t < disk.triangles.size(); ++t)
  {
    area += disk.triangleOf[t] < 0 ? 0.0 : 0.5 * TwiceAreaInPlane(disk.triangles[t], plane);
  }
  return area;
}

} // namespace gridfem
