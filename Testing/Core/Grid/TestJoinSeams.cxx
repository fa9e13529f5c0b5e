// Seams that coincide except for rounding, and hanging nodes: tests which points are joined and
// which stay apart.
#include "Grid/JoinSeams.h"

#include "Base/Errors.h"
#include "Largest.h"
#include "Meshes.h"
#include "SameSeams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

TriangleMesh InSinglePrecision(const TriangleMesh& mesh)
{
  return Mapped(mesh, [](const Vec3& p) -> Vec3 { return p.cast<float>().cast<double>(); });
}

/// A tube around z with a seam, computed in the precision of Real.
template<class Real>
TriangleMesh Tube(int around, int along)
{
  return Mapped(FlatRectangle(around, along),
    [](const Vec3& p)
    {
      const Real angle = Real(2 * M_PI) * Real(p[0]);
      return Vec3(std::cos(angle), std::sin(angle), Real(3 * p[1]));
    });
}

/// A sphere with a seam from pole to pole. Every meridian has its own poles.
template<class Real>
TriangleMesh SphereWithSeam(int around, int along)
{
  return Mapped(FlatRectangle(around, along),
    [](const Vec3& p)
    {
      const Real angle = Real(2 * M_PI) * Real(p[0]);
      const Real height = Real(M_PI) * Real(p[1]);
      const Real radius = std::sin(height);
      return Vec3(radius * std::cos(angle), radius * std::sin(angle), std::cos(height));
    });
}

/// Two squares side by side, with a gap between them.
TriangleMesh SquaresWithGap(int n, double gap)
{
  const TriangleMesh square = FlatRectangle(n, n);
  return Join(square, Transform(square, { 1, 0, 0 }, 0.0, 1.0, { 1.0 + gap, 0, 0 }));
}

std::size_t NumberOfOpen(const TriangleMesh& mesh)
{
  return FindOpenEdges(mesh).size();
}

/// The largest distance of a point from where it was before.
double LargestMove(const TriangleMesh& before, const TriangleMesh& after)
{
  double largest = 0.0;
  for (std::size_t point = 0; point < before.points.size(); ++point)
  {
    largest = Larger(largest, (after.points[point] - before.points[point]).norm());
  }
  return largest;
}

void ExpectSameMesh(const TriangleMesh& a, const TriangleMesh& b)
{
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

} // namespace

TEST(JoinSeams, LeavesCleanSurfacesAsTheyAre)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(6), Torus(20, 10, 1.0, 0.3), Unweld(Box(4)),
         FlatRectangle(5, 7), CubeArray(2, 2, 0.01), TriangleMesh() })
  {
    TriangleMesh joined = mesh;
    const JoinedSeams seams = JoinSeams(joined);
    EXPECT_TRUE(seams.moved.empty());
    EXPECT_TRUE(seams.sourceTriangle.empty());
    ExpectSameMesh(joined, mesh);
  }
  EXPECT_EQ(NumberOfOpen(Unweld(GeodesicSphere(3))), 0u);
  EXPECT_EQ(NumberOfOpen(FlatRectangle(4, 3)), 14u);
}

TEST(JoinSeams, ClosesSurfacesOfRevolution)
{
  const double box = 3.0; // at most, of these surfaces
  for (const auto& [mesh, open] : std::vector<std::pair<TriangleMesh, std::size_t>>{
         { Tube<double>(60, 30), 120 }, { Tube<float>(60, 30), 120 },
         { Tube<float>(700, 300), 1400 }, { Transform(Tube<float>(60, 30), { 1, 2, 3 }, 0.7), 120 },
         { SphereWithSeam<double>(40, 20), 0 }, { SphereWithSeam<float>(40, 20), 0 } })
  {
    EXPECT_GT(NumberOfOpen(mesh), open);
    TriangleMesh joined = mesh;
    const JoinedSeams seams = JoinSeams(joined);
    EXPECT_EQ(NumberOfOpen(joined), open);
    EXPECT_EQ(joined.triangles, mesh.triangles);
    EXPECT_LE(LargestMove(mesh, joined), 2.0 * SeamTolerance * box);
    for (const MovedPoint& moved : seams.moved)
    {
      EXPECT_EQ(joined.points[moved.point], joined.points[moved.twin]);
      EXPECT_EQ(joined.points[moved.twin], mesh.points[moved.twin]); // a twin stays
    }
  }
}

TEST(JoinSeams, ClosesRotatedSectorsAndMirroredHalves)
{
  const TriangleMesh sector = Mapped(FlatRectangle(10, 20),
    [](const Vec3& p)
    {
      const double radius = std::sin(M_PI * (0.05 + 0.9 * p[1]));
      return Vec3(radius * std::cos(p[0] * M_PI / 4), radius * std::sin(p[0] * M_PI / 4), p[1]);
    });
  TriangleMesh whole;
  for (int k = 0; k < 8; ++k)
  {
    whole = Join(whole, Transform(sector, { 0, 0, 1 }, k * M_PI / 4));
  }
  JoinSeams(whole);
  EXPECT_EQ(NumberOfOpen(whole), 160u); // the two rings

  const TriangleMesh half = Transform(FlatRectangle(6, 6), { 3, 1, 2 }, 0.5);
  const Vec3 normal = (half.points[1] - half.points[0]).normalized();
  const TriangleMesh mirrored = Mapped(
    half, [&](const Vec3& p) -> Vec3 { return p - 2.0 * normal.dot(p - half.points[0]) * normal; });
  TriangleMesh both = Join(half, mirrored);
  JoinSeams(both);
  EXPECT_EQ(NumberOfOpen(both), 36u);
}

TEST(JoinSeams, KeepsApartWhatIsTenTimesTheToleranceApart)
{
  // With 10 squares per side, the box determines the tolerance. With 600 it is that of the edges.
  for (const int n : { 10, 600 })
  {
    const double tolerance = std::min(2.0 * SeamTolerance, SeamShare / n);
    const auto around = static_cast<std::size_t>(6 * n);
    TriangleMesh near = SquaresWithGap(n, 0.5 * tolerance);
    JoinSeams(near);
    EXPECT_EQ(NumberOfOpen(near), around);
    const TriangleMesh apart = SquaresWithGap(n, 10.0 * tolerance);
    TriangleMesh joined = apart;
    JoinSeams(joined);
    ExpectSameMesh(joined, apart);
  }
}

TEST(JoinSeams, NeverClosesWhatTheMeshResolves)
{
  // A strip narrower than the tolerance of the box: its two sides are open edges.
  for (const double width : { 1e-7, 1e-9, 1e-12 })
  {
    const TriangleMesh strip =
      Transform(FlatRectangle(10, 1, 1.0, width), { 1, 2, 3 }, 0.3, 1.0, { 0.1, 0.2, 0.3 });
    TriangleMesh joined = strip;
    JoinSeams(joined);
    ExpectSameMesh(joined, strip);
  }
}

TEST(JoinSeams, DividesTrianglesAtHangingNodes)
{
  for (const auto& [left, right] :
    std::vector<std::pair<int, int>>{ { 4, 8 }, { 4, 6 }, { 10, 14 }, { 2, 64 }, { 6, 6 } })
  {
    for (const double angle : { 0.0, 0.7 })
    {
      const TriangleMesh halves = Transform(Halves(left, right), { 1, 2, 3 }, angle);
      for (const TriangleMesh& mesh : { halves, InSinglePrecision(halves) })
      {
        TriangleMesh joined = mesh;
        const JoinedSeams seams = JoinSeams(joined);
        const int border = 2 * (left / 2 + right / 2) + left + right;
        EXPECT_EQ(NumberOfOpen(joined), static_cast<std::size_t>(border));
        EXPECT_NEAR(SurfaceArea(joined), SurfaceArea(mesh), 1e-6);
        if (left == right)
        {
          EXPECT_TRUE(seams.sourceTriangle.empty());
          continue;
        }
        // Every node of one side that the other lacks divides one triangle.
        const int shared = std::gcd(left, right);
        const int added = left + right - 2 * shared;
        EXPECT_EQ(joined.triangles.size(), mesh.triangles.size() + added);
        ASSERT_EQ(seams.sourceTriangle.size(), joined.triangles.size());
        EXPECT_TRUE(std::is_sorted(seams.sourceTriangle.begin(), seams.sourceTriangle.end()));
      }
    }
  }
}

/// Three sides with nodes at once, and polygons around one that is coarser.
TEST(JoinSeams, DividesAllSidesOfATriangle)
{
  TriangleMesh coarse;
  coarse.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.3, 1, 0 } };
  coarse.triangles = { { 0, 1, 2 } };
  TriangleMesh mesh = coarse;
  for (int k = 0; k < 3; ++k) // a mirror image of the triangle at each side, in 16 parts
  {
    const Vec3 from = coarse.points[k];
    const Vec3 along = (coarse.points[(k + 1) % 3] - from).normalized();
    TriangleMesh image = SubdivideInPlane(SubdivideInPlane(coarse));
    for (Vec3& point : image.points)
    {
      const Vec3 arm = point - from;
      point = from + 2.0 * along.dot(arm) * along - arm;
    }
    mesh = Join(mesh, image);
  }
  const double area = SurfaceArea(mesh);
  JoinSeams(mesh);
  EXPECT_EQ(mesh.triangles.size(), 3u * 16u + 10u); // nine nodes
  EXPECT_EQ(NumberOfOpen(mesh), 3u * 8u);
  EXPECT_NEAR(SurfaceArea(mesh), area, 1e-12);
  for (std::size_t t = 0; t < 10; ++t)
  {
    const auto& corner = mesh.triangles[t];
    const Vec3 normal = (mesh.points[corner[1]] - mesh.points[corner[0]])
                          .cross(mesh.points[corner[2]] - mesh.points[corner[0]]);
    EXPECT_GT(normal[2], 1e-3); // no part is flat or turned
  }
}

TEST(JoinSeams, HangingNodesNeedAnEdgeAlongTheSide)
{
  // The tip of a triangle touches the middle of the other's side. They share no edge.
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.5, 0, 0 }, { 0.4, -1, 0 },
    { 0.6, -1, 0 } };
  mesh.triangles = { { 0, 1, 2 }, { 3, 4, 5 } };
  const TriangleMesh given = mesh;
  JoinSeams(mesh);
  ExpectSameMesh(mesh, given);
}

/// Surfaces of any size that solvers accept, and larger ones, which they refuse for their size.
TEST(JoinSeams, DoesNotDependOnTheUnitOfLength)
{
  for (const double scale : { 1e-300, 1e-70, 1e-3, 1e70, 1e200, 1e307 })
  {
    TriangleMesh tube = Transform(Tube<double>(60, 30), { 0, 0, 1 }, 0.0, scale);
    JoinSeams(tube);
    EXPECT_EQ(NumberOfOpen(tube), 120u) << scale;
    TriangleMesh halves = Transform(Halves(4, 6), { 0, 0, 1 }, 0.0, scale);
    const std::size_t triangles = halves.triangles.size();
    EXPECT_EQ(JoinSeams(halves).sourceTriangle.size(), triangles + 6) << scale;
    const TriangleMesh sheet = Transform(FlatRectangle(3, 3), { 0, 0, 1 }, 0.0, scale);
    TriangleMesh joined = sheet;
    JoinSeams(joined);
    ExpectSameMesh(joined, sheet);
  }
}

TEST(JoinSeams, DoesNotDependOnThreads)
{
  for (const TriangleMesh& mesh : { Tube<float>(300, 200),
         Join(Halves(20, 64), Tube<double>(100, 60)), SphereWithSeam<float>(200, 100) })
  {
    TriangleMesh one = mesh;
    const JoinedSeams ofOne = JoinSeams(one, 1);
    TriangleMesh four = mesh;
    const JoinedSeams ofFour = JoinSeams(four, 4);
    ExpectSameMesh(one, four);
    EXPECT_EQ(ofOne.sourceTriangle, ofFour.sourceTriangle);
  }
}

TEST(FindSeams, DoNotDependOnTheOrderOfEdges)
{
  const TriangleMesh mesh = Join(Halves(4, 6), Tube<float>(60, 30));
  std::vector<OpenEdge> open = FindOpenEdges(mesh);
  const std::vector<double> shortest = ShortestSides(mesh, NumberEnds(open));
  const Seams seams = FindSeams(open, shortest, 3.0);
  EXPECT_FALSE(seams.moves.empty());
  EXPECT_FALSE(seams.divisions.empty());
  std::shuffle(open.begin(), open.end(), std::mt19937(1));
  const Seams other = FindSeams(open, shortest, 3.0);
  ExpectSameSeams(other, seams);
}

TEST(JoinSeams, RefusesWhatIsNoSurface)
{
  TriangleMesh mesh = FlatRectangle(2, 2);
  mesh.triangles[3][1] = 99;
  EXPECT_THROW(JoinSeams(mesh), InvalidInput);
  mesh = FlatRectangle(2, 2);
  mesh.points[4][2] = std::nan("");
  EXPECT_THROW(JoinSeams(mesh), InvalidInput);
}
