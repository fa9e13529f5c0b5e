// Distances through space from points and segments, and the places where paths from sources begin.
#include "Distance/StraightDistance.h"
#include "Largest.h"
#include "Meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

Vec3 RandomPlace(std::mt19937& random)
{
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const double x = coordinate(random);
  const double y = coordinate(random);
  return { x, y, coordinate(random) };
}

/// Segments of all lengths down to 0, and many at one place.
std::vector<Segment> RandomSegments(int count, std::mt19937& random)
{
  std::vector<Segment> segments;
  for (int k = 0; k < count; ++k)
  {
    const Vec3 start = k % 5 == 0 ? Vec3(0.1, 0.2, 0.3) : RandomPlace(random);
    const double length = k % 3 == 0 ? 0.0 : 0.5 / (1 + k % 7);
    segments.push_back({ start, start + length * RandomPlace(random) });
  }
  return segments;
}

} // namespace

TEST(StraightDistance, IsThatOfTheNearestOfAllSegments)
{
  std::mt19937 random(5);
  for (const int count : { 1, 2, 8, 9, 100, 3000 })
  {
    std::vector<Segment> segments = RandomSegments(count, random);
    const SegmentTree tree(segments);
    for (int k = 0; k < 200; ++k)
    {
      const Vec3 place = 1.5 * RandomPlace(random);
      double least = 1e300;
      for (const Segment& segment : segments)
      {
        least = std::min(least, DistanceFromSegment(segment, place));
      }
      ASSERT_EQ(tree.DistanceFrom(place), least) << count; // the same bits
    }
  }
}

TEST(StraightDistance, OfASegmentIsThatOfItsNearestPoint)
{
  const Segment segment{ Vec3(0, 0, 0), Vec3(2, 0, 0) };
  EXPECT_DOUBLE_EQ(DistanceFromSegment(segment, { 1, 3, 4 }), 5.0);
  EXPECT_DOUBLE_EQ(DistanceFromSegment(segment, { -3, 4, 0 }), 5.0);
  EXPECT_DOUBLE_EQ(DistanceFromSegment(segment, { 5, 0, -4 }), 5.0);
  EXPECT_DOUBLE_EQ(DistanceFromSegment({ Vec3(1, 1, 1), Vec3(1, 1, 1) }, { 1, 1, 4 }), 3.0);
}

TEST(StraightDistance, IsZeroWithoutASegment)
{
  const std::vector<double> distance = DistancesThroughSpace(Box(1), {}, 1);
  EXPECT_EQ(distance, std::vector<double>(Box(1).points.size(), 0.0));
}

/// The distance from a square region in a square is that from its rim. It has to be the same for a
/// mesh without shared points.
TEST(StraightDistance, OfARegionIsThatFromItsRim)
{
  const TriangleMesh connected = FlatRectangle(20, 20);
  for (const TriangleMesh& mesh : { connected, Unweld(connected) })
  {
    std::vector<char> isSource;
    for (const Vec3& point : mesh.points)
    {
      isSource.push_back(std::max(point[0], point[1]) < 0.51);
    }
    const std::vector<double> found =
      DistancesThroughSpace(mesh, RimOfSources(mesh, isSource, 2), 2);
    double error = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      const Vec3 beyond = (mesh.points[k] - Vec3(0.5, 0.5, 0.0)).cwiseMax(0.0);
      error = Larger(error, isSource[k] ? 0.0 : std::abs(found[k] - beyond.norm()));
    }
    EXPECT_LT(error, 1e-12);
  }
  // The region's 10 by 10 squares have 21 points and 40 edges on the border of the rest and of the
  // square; its inside is left out.
  std::vector<char> isSource;
  for (const Vec3& point : connected.points)
  {
    isSource.push_back(std::max(point[0], point[1]) < 0.51);
  }
  EXPECT_EQ(RimOfSources(connected, isSource, 1).size(), 61u);
}

/// A line of sources is no region: paths begin at its points alone.
TEST(StraightDistance, OfALineOfPointsIsThatFromThePoints)
{
  const TriangleMesh mesh = FlatRectangle(10, 10);
  std::vector<char> isSource;
  for (const Vec3& point : mesh.points)
  {
    isSource.push_back(std::abs(point[0] - 0.5) < 0.01);
  }
  for (const Segment& segment : RimOfSources(mesh, isSource, 1))
  {
    EXPECT_EQ(segment[0], segment[1]);
  }
  EXPECT_EQ(RimOfSources(mesh, isSource, 1).size(), 11u);
}
