// Voronoi regions against the regions of exact distances.
#include "Distance/NearestSource.h"
#include "Largest.h"

#include "Base/Errors.h"
#include "Distance/GeodesicDistance.h"
#include "EitherSpace.h"
#include "Meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Exact = std::function<double(const Vec3& a, const Vec3& b)>;

double InSpace(const Vec3& a, const Vec3& b)
{
  return (a - b).norm();
}

double OnSphere(const Vec3& a, const Vec3& b)
{
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

std::vector<Id> SpreadSources(const TriangleMesh& mesh, int count)
{
  std::vector<Id> sources;
  for (int k = 0; k < count; ++k)
  {
    sources.push_back(static_cast<Id>((k + 0.5) / count * double(mesh.points.size())));
  }
  return sources;
}

std::vector<double> ExactDistances(
  const TriangleMesh& mesh, const std::vector<Id>& sources, const Exact& exact)
{
  std::vector<double> distance;
  for (const Vec3& point : mesh.points)
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Id source : sources)
    {
      least = std::min(least, exact(mesh.points[source], point));
    }
    distance.push_back(least);
  }
  return distance;
}

/// The largest excess of the distance from a point's source over that from its nearest source.
double LargestDetour(const TriangleMesh& mesh, const std::vector<Id>& nearest,
  const std::vector<Id>& sources, const Exact& exact)
{
  const std::vector<double> least = ExactDistances(mesh, sources, exact);
  double largest = 0.0;
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    largest = Larger(largest, exact(mesh.points[nearest[i]], mesh.points[i]) - least[i]);
  }
  return largest;
}

} // namespace

TEST(NearestSource, OfExactDistancesIsRightToAnEdge)
{
  const TriangleMesh square = FlatRectangle(60, 60);
  const TriangleMesh sphere = GeodesicSphere(30);
  for (const int count : { 1, 2, 3, 7, 40 })
  {
    const std::vector<Id> onSquare = SpreadSources(square, count);
    const std::vector<Id> ofSquare =
      NearestSources(square, ExactDistances(square, onSquare, InSpace), onSquare, true);
    EXPECT_LT(LargestDetour(square, ofSquare, onSquare, InSpace), 1.5 / 60) << count;
    const std::vector<Id> onSphere = SpreadSources(sphere, count);
    const std::vector<Id> ofSphere =
      NearestSources(sphere, ExactDistances(sphere, onSphere, OnSphere), onSphere, true);
    EXPECT_LT(LargestDetour(sphere, ofSphere, onSphere, OnSphere), 1.5 * 1.2 / 30) << count;
    EXPECT_EQ(std::set<Id>(ofSphere.begin(), ofSphere.end()),
      std::set<Id>(onSphere.begin(), onSphere.end()));
  }
}

TEST(NearestSource, OfComputedDistancesIsRightToThreeCells)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(40));
  const GeodesicDistance distance(BuildEither(*mesh, false, 6, 0.1), mesh, {});
  for (const int count : { 2, 5, 20 })
  {
    const std::vector<Id> sources = SpreadSources(*mesh, count);
    SolveOptions solve;
    solve.tolerance = 1e-4;
    const DistanceField field = distance.From(sources, solve);
    EXPECT_LT(
      LargestDetour(*mesh, NearestSources(*mesh, field.atPoints, sources, true), sources, OnSphere),
      3.0 * 2.0 / 64)
      << count;
  }
}

/// Distances around the second source were negative and are set to 0. No point there comes after
/// the source.
TEST(NearestSource, KnowsASourceWhoseSurroundingsAreAsNear)
{
  const TriangleMesh mesh = FlatRectangle(40, 1, 1.0, 0.025);
  const std::vector<Id> sources = { 12, 41 + 36 }; // at 0.3 and 0.9
  std::vector<double> distance = ExactDistances(mesh, sources, InSpace);
  for (std::size_t i = 0; i < distance.size(); ++i)
  {
    distance[i] *= mesh.points[i][0] > 0.74 && mesh.points[i][0] < 0.91 ? 0.0 : 1.0;
  }
  const std::vector<Id> nearest = NearestSources(mesh, distance, sources, true);
  EXPECT_LT(LargestDetour(mesh, nearest, sources, InSpace), 0.05);
}

/// Neither the order of points nor unwelded edges matter.
TEST(NearestSource, GoesAcrossUnweldedEdgesWhereTheyAreWelded)
{
  const TriangleMesh mesh = FlatRectangle(20, 20);
  const TriangleMesh soup = Unweld(mesh);
  const std::vector<Id> sources = SpreadSources(soup, 3);
  const std::vector<double> distance = ExactDistances(soup, sources, InSpace);
  const std::vector<Id> nearest = NearestSources(soup, distance, sources, true);
  EXPECT_LT(LargestDetour(soup, nearest, sources, InSpace), 1.5 / 20);
  const std::vector<Id> torn = NearestSources(soup, distance, sources, false);
  EXPECT_GT(std::count(torn.begin(), torn.end(), -1), 1000); // no triangle is connected to another
}

TEST(NearestSource, GoesThroughAPointThatLiesOnAnotherSheet)
{
  // The first of two points in one place belongs to a surface without a source.
  const TriangleMesh mesh =
    Join(FlatRectangle(2, 2), Transform(FlatRectangle(2, 2), { 0, 0, 1 }, std::acos(-1.0)));
  std::vector<double> distance(9, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t point = 9; point < mesh.points.size(); ++point)
  {
    distance.push_back((mesh.points[point] - mesh.points[17]).norm());
  }
  ASSERT_EQ(mesh.points[0], mesh.points[9]);
  const std::vector<Id> nearest = NearestSources(mesh, distance, { 17 }, true);
  for (std::size_t point = 0; point < nearest.size(); ++point)
  {
    EXPECT_EQ(nearest[point], point < 9 ? -1 : 17) << point;
  }
}

TEST(NearestSource, IsNoneWhereNoDistanceIs)
{
  const TriangleMesh mesh = TwoSheets(8, 0.1);
  std::vector<double> distance = ExactDistances(mesh, { 3 }, InSpace);
  const std::size_t half = distance.size() / 2;
  std::fill(distance.begin() + static_cast<long>(half), distance.end(), std::nan(""));
  const std::vector<Id> nearest = NearestSources(mesh, distance, { 3 }, true);
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    ASSERT_EQ(nearest[i], i < half ? 3 : -1);
  }
  EXPECT_THROW(NearestSources(mesh, { 1.0 }, { 3 }, true), InvalidInput);
  EXPECT_THROW(NearestSources(mesh, distance, { -1 }, true), InvalidInput);
  EXPECT_THROW(NearestSources(mesh, distance, { 100000 }, true), InvalidInput);
}
