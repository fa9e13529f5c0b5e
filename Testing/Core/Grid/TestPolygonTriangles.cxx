#include "Base/Errors.h"
#include "Grid/PolygonTriangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

/// Returns a regular polygon in which every second corner is moved inward by a fraction of the
/// radius.
std::vector<Vec3> Star(int size, double depth)
{
  std::vector<Vec3> corners;
  for (int k = 0; k < size; ++k)
  {
    const double angle = 2.0 * M_PI * k / size;
    corners.push_back((1.0 - depth * (k % 2)) * Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  return corners;
}

std::vector<Triangle> TrianglesOf(const std::vector<Vec3>& corners)
{
  std::vector<Id> ids(corners.size());
  std::iota(ids.begin(), ids.end(), Id{ 0 });
  return TrianglesOfPolygon(corners, 0, ids);
}

/// Returns signed areas along z, positive for triangles with the orientation of the polygon.
std::vector<double> AreasOf(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles)
{
  std::vector<double> areas;
  for (const Triangle& t : triangles)
  {
    areas.push_back(0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).z());
  }
  return areas;
}

TEST(PolygonTriangles, FillThePolygonWithoutOverlap)
{
  for (const double depth : { 0.0, 0.2, 0.7 })
  {
    for (const int size : { 4, 6, 10, 200 })
    {
      const std::vector<Vec3> corners = Star(size, depth);
      const std::vector<Triangle> triangles = TrianglesOf(corners);
      ASSERT_EQ(triangles.size(), static_cast<std::size_t>(size - 2));
      double sum = 0.0;
      for (const double area : AreasOf(corners, triangles))
      {
        EXPECT_GT(area, 0.0);
        sum += area;
      }
      EXPECT_NEAR(sum, 0.5 * size * (1.0 - depth) * std::sin(2.0 * M_PI / size), 1e-12);
    }
  }
}

TEST(PolygonTriangles, FillANarrowZigzag)
{
  constexpr int Size = 4000; // nearly every ear is blocked
  std::vector<Vec3> corners(2 * Size);
  for (int k = 0; k < Size; ++k)
  {
    const double x = static_cast<double>(k) / (Size - 1);
    const double y = 0.5 * std::cos(40.0 * x) + 0.3 * (k % 2);
    corners[k] = { x, y - 0.01, 0.0 };
    corners[2 * Size - 1 - k] = { x, y, 0.0 };
  }
  const std::vector<double> areas = AreasOf(corners, TrianglesOf(corners));
  ASSERT_EQ(areas.size(), corners.size() - 2);
  EXPECT_GT(*std::min_element(areas.begin(), areas.end()), 0.0);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 0.01, 1e-12);
}

TEST(PolygonTriangles, QuadrilateralsAreCutAlongTheShorterDiagonalInside)
{
  const std::vector<Vec3> kite = { { -2, 0, 0 }, { 0, -1, 0 }, { 2, 0, 0 }, { 0, 1, 0 } };
  EXPECT_EQ(TrianglesOf(kite)[0], (Triangle{ 0, 1, 3 }));

  const std::vector<Vec3> arrow = { { 0, 0, 0 }, { 4, -1, 0 }, { 3, 0, 0 }, { 4, 1, 0 } };
  for (const double area : AreasOf(arrow, TrianglesOf(arrow)))
  {
    EXPECT_GT(area, 0.0);
  }
}

TEST(PolygonTriangles, DegeneratePolygonsBecomeFans)
{
  const std::vector<Vec3> line = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 },
    { 4, 0, 0 } };
  const std::vector<Triangle> fan = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 } };
  EXPECT_EQ(TrianglesOf(line), fan);
}

TEST(PolygonTriangles, TooManyInwardCornersAreRefused)
{
  EXPECT_EQ(TrianglesOf(Star(100000, 0.0)).size(), 99998u);
  EXPECT_THROW(TrianglesOf(Star(100000, 0.2)), InvalidInput);
}

} // namespace
} // namespace gridfem
