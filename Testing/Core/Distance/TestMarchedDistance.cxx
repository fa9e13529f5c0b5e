// Distances by a marching front against exact distances, and the limit where it stops.
#include "Largest.h"
#include "Meshes.h"

#include "Distance/MarchedDistance.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Far = 1e3;

std::vector<double> DistanceFrom(
  const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& isSource, double limit = Far)
{
  std::vector<char> sources;
  for (const Vec3& point : mesh.points)
  {
    sources.push_back(isSource(point));
  }
  return MarchDistance(mesh, NumberHatFunctions(mesh), sources, limit);
}

} // namespace

/// A straight front stays straight on any triangles, even on needles.
TEST(MarchedDistance, FromAnEdgeOfAPlaneIsExact)
{
  for (const TriangleMesh& mesh : { FlatRectangle(20, 20), FlatRectangle(40, 5),
         Unweld(FlatRectangle(9, 13)), Transform(FlatRectangle(10, 10), { 1, 2, 3 }, 0.7) })
  {
    const Vec3 corner = mesh.points.front();
    const Vec3 across = (mesh.points[mesh.triangles[0][1]] - corner).normalized();
    const std::vector<double> distance =
      DistanceFrom(mesh, [&](const Vec3& p) { return std::abs((p - corner).dot(across)) < 1e-12; });
    for (std::size_t i = 0; i < distance.size(); ++i)
    {
      ASSERT_NEAR(distance[i], (mesh.points[i] - corner).dot(across), 1e-12) << i;
    }
  }
}

/// The error of a front that starts at a point is of first order, and falls with the mesh size.
TEST(MarchedDistance, FromAPointOfASphereConverges)
{
  double last = 1.0;
  for (const int subdivisions : { 8, 16, 32 })
  {
    const TriangleMesh mesh = Transform(GeodesicSphere(subdivisions), { 1, 2, 3 }, 0.3);
    const Vec3 source = mesh.points[0];
    const std::vector<double> distance =
      DistanceFrom(mesh, [&](const Vec3& p) { return p == source; });
    double worst = 0.0;
    for (std::size_t i = 0; i < distance.size(); ++i)
    {
      const Vec3& p = mesh.points[i];
      ASSERT_GE(distance[i], (p - source).norm() - 1e-12);
      worst =
        Larger(worst, std::abs(distance[i] - std::acos(std::clamp(p.dot(source), -1.0, 1.0))));
    }
    EXPECT_LT(worst, 0.75 * last);
    last = worst;
  }
  EXPECT_LT(last, 0.06);
}

TEST(MarchedDistance, EndsAtTheLimit)
{
  const TriangleMesh mesh = GeodesicSphere(16);
  const auto atPole = [](const Vec3& p) { return p[2] > 0.999; };
  const std::vector<double> all = DistanceFrom(mesh, atPole);
  const std::vector<double> near = DistanceFrom(mesh, atPole, 0.5);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    EXPECT_EQ(near[i], all[i] <= 0.5 ? all[i] : INFINITY) << i;
  }
  const std::vector<double> none = DistanceFrom(mesh, atPole, 0.0);
  EXPECT_EQ(std::count(none.begin(), none.end(), 0.0), 1);
  EXPECT_EQ(std::count(none.begin(), none.end(), INFINITY), std::ptrdiff_t(none.size() - 1));
}

/// The front runs along the surface and not through space. A welded triangle soup is one surface.
TEST(MarchedDistance, StaysOnTheSurface)
{
  const TriangleMesh sheets = TwoSheets(8, 0.01);
  const Vec3 source = sheets.points[0];
  const std::vector<double> distance =
    DistanceFrom(sheets, [&](const Vec3& p) { return p == source; });
  for (std::size_t i = 0; i < distance.size(); ++i)
  {
    EXPECT_EQ(std::isfinite(distance[i]), sheets.points[i][2] == source[2]) << i;
  }

  const TriangleMesh soup = Unweld(GeodesicSphere(8));
  const auto atPole = [](const Vec3& p) { return p[2] > 0.999; };
  const std::vector<double> welded = DistanceFrom(soup, atPole);
  EXPECT_TRUE(std::all_of(welded.begin(), welded.end(), [](double d) { return d < 4.0; }));
  HatOptions apart;
  apart.weldCoincidentPoints = false;
  std::vector<char> first(soup.points.size(), 0);
  first[0] = 1;
  const std::vector<double> triangle =
    MarchDistance(soup, NumberHatFunctions(soup, apart), first, Far);
  EXPECT_EQ(
    std::count(triangle.begin(), triangle.end(), INFINITY), std::ptrdiff_t(soup.points.size() - 3));
}
