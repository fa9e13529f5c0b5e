// Paths along triangles: their lengths against exact ones, and that no path nearby is shorter.
#include "Distance/SurfacePath.h"

#include "Distance/WindowSearch.h"
#include "Largest.h"
#include "Meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr std::size_t Most = 10000000;

/// Both kinds of paths between points of a mesh.
struct Paths
{
  explicit Paths(const TriangleMesh& mesh)
    : graph(std::make_shared<const TriangleMesh>(mesh), true), search(graph), windows(graph)
  {
  }

  std::vector<PathSearch::Node> Way(Id from, Id to)
  {
    search.From({ graph.PlaceOf(from) }, { graph.PlaceOf(to) }, {});
    return search.WayTo(graph.PlaceOf(to));
  }

  SurfacePath Tight(Id from, Id to) { return PullTight(graph, this->Way(from, to)); }

  SurfacePath Shortest(Id from, Id to)
  {
    const Index target = graph.PlaceOf(to);
    const double bound = this->Tight(from, to).length;
    EXPECT_TRUE(windows.From({ graph.PlaceOf(from) }, { target }, bound, Most, {}));
    const SurfacePath path = PullTight(graph, windows.StripsTo(target));
    EXPECT_NEAR(path.length, windows.LengthTo(target), 1e-11 * path.length);
    return path;
  }

  PathGraph graph;
  PathSearch search;
  WindowSearch windows;
};

/// How much the smallest angle around a point of the mesh on the path is below π.
double LargestBend(const PathGraph& graph, const SurfacePath& path)
{
  double bend = 0.0;
  for (std::size_t k = 1; k + 1 < path.points.size(); ++k)
  {
    const PathPoint& point = path.points[k];
    const std::array<Index, 3> corner = graph.CornersOf(point.triangle);
    for (int c = 0; c < 3; ++c)
    {
      if (point.weights[c] == 1.0)
      {
        const auto toward = [&](const PathPoint& holder, const PathPoint& end) {
          return DirectionToward(graph, holder.triangle, corner[c], PositionOf(graph.Mesh(), end));
        };
        const StarRoute route = RouteAround(graph, corner[c], toward(point, path.points[k - 1]),
          toward(path.points[k + 1], path.points[k + 1]));
        bend = Larger(bend, Pi - route.angle);
      }
    }
  }
  return bend;
}

/// Checks every path: it joins its ends, lies in triangles that meet, and cannot be pulled tighter.
void RequireTight(const PathGraph& graph, const SurfacePath& path, Id from, Id to)
{
  const TriangleMesh& mesh = graph.Mesh();
  ASSERT_GE(path.points.size(), 2u);
  EXPECT_EQ(PositionOf(mesh, path.points.front()), mesh.points[from]);
  EXPECT_EQ(PositionOf(mesh, path.points.back()), mesh.points[to]);
  EXPECT_GE(path.length, (mesh.points[from] - mesh.points[to]).norm() * (1.0 - 1e-12));
  EXPECT_LT(LargestBend(graph, path), 1e-6);
  for (std::size_t k = 1; k < path.points.size(); ++k)
  {
    EXPECT_NEAR(path.points[k].weights.sum(), 1.0, 1e-15);
    // The triangle holds the point before, too: its distances to the corners determine a plane.
    const auto& corner = mesh.triangles[path.points[k].triangle];
    const Vec3 a = mesh.points[corner[0]];
    const Vec3 normal = (mesh.points[corner[1]] - a).cross(mesh.points[corner[2]] - a);
    const Vec3 before = PositionOf(mesh, path.points[k - 1]);
    EXPECT_NEAR(normal.normalized().dot(before - a), 0.0, 1e-9);
  }
}

/// A prism around z with `sides` flat sides around the unit circle, `rows` squares high, open.
TriangleMesh Prism(int sides, int rows, double height)
{
  TriangleMesh mesh;
  for (int row = 0; row <= rows; ++row)
  {
    for (int side = 0; side < sides; ++side)
    {
      const double angle = 2.0 * Pi * side / sides;
      mesh.points.emplace_back(std::cos(angle), std::sin(angle), height * row / rows);
    }
  }
  const auto at = [&](int row, int side) -> Id { return row * sides + side % sides; };
  for (int row = 0; row < rows; ++row)
  {
    for (int side = 0; side < sides; ++side)
    {
      mesh.triangles.push_back({ at(row, side), at(row, side + 1), at(row + 1, side + 1) });
      mesh.triangles.push_back({ at(row, side), at(row + 1, side + 1), at(row + 1, side) });
    }
  }
  return mesh;
}

/// A pyramid with its tip at point 0 and `sides` sides, each cut into rows.
TriangleMesh Pyramid(int sides, int rows, double height)
{
  TriangleMesh mesh;
  mesh.points.emplace_back(0.0, 0.0, height);
  for (int row = 1; row <= rows; ++row)
  {
    for (int side = 0; side < sides; ++side)
    {
      const double angle = 2.0 * Pi * side / sides;
      const double share = static_cast<double>(row) / rows;
      mesh.points.emplace_back(
        share * std::cos(angle), share * std::sin(angle), (1.0 - share) * height);
    }
  }
  const auto at = [&](int row, int side) -> Id
  { return row == 0 ? 0 : 1 + (row - 1) * sides + side % sides; };
  for (int row = 0; row < rows; ++row)
  {
    for (int side = 0; side < sides; ++side)
    {
      mesh.triangles.push_back({ at(row, side), at(row + 1, side), at(row + 1, side + 1) });
      if (row > 0)
      {
        mesh.triangles.push_back({ at(row, side), at(row + 1, side + 1), at(row, side + 1) });
      }
    }
  }
  return mesh;
}

/// The plate with a square hole in its middle third.
TriangleMesh PlateWithHole(int thirds)
{
  TriangleMesh plate = FlatRectangle(3 * thirds, 3 * thirds, 3.0, 3.0);
  const auto isInHole = [&](const std::array<Id, 3>& corner)
  {
    const Vec3 center =
      (plate.points[corner[0]] + plate.points[corner[1]] + plate.points[corner[2]]) / 3.0;
    return center[0] > 1.0 && center[0] < 2.0 && center[1] > 1.0 && center[1] < 2.0;
  };
  plate.triangles.erase(std::remove_if(plate.triangles.begin(), plate.triangles.end(), isInHole),
    plate.triangles.end());
  return plate;
}

Id PointAt(const TriangleMesh& mesh, const Vec3& place)
{
  const auto nearest = std::min_element(mesh.points.begin(), mesh.points.end(),
    [&](const Vec3& a, const Vec3& b) { return (a - place).norm() < (b - place).norm(); });
  EXPECT_LT((*nearest - place).norm(), 1e-9);
  return nearest - mesh.points.begin();
}

/// The distance on the unit cube from (0, 0, 0) to a point, through unfolded faces. The path is
/// straight on the three faces at the source. It crosses one edge to each of the other three faces.
/// A path over two faces in between is never shorter from a corner.
double FromCornerOfCube(const Vec3& p)
{
  double least = 10.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = p[(axis + 1) % 3];
    const double b = p[(axis + 2) % 3];
    if (p[axis] == 0.0)
    {
      least = std::min(least, std::hypot(a, b));
    }
    if (p[axis] == 1.0)
    {
      least = std::min({ least, std::hypot(a, 1.0 + b), std::hypot(1.0 + a, b) });
    }
  }
  return least;
}

} // namespace

TEST(SurfacePath, OnACube)
{
  for (const int n : { 1, 5, 8 })
  {
    const TriangleMesh cube = Box(n);
    Paths paths(cube);
    const Id from = PointAt(cube, { 0, 0, 0 });
    for (Id to = 0; to < static_cast<Id>(cube.points.size()); ++to)
    {
      if (to != from)
      {
        const SurfacePath path = paths.Shortest(from, to);
        RequireTight(paths.graph, path, from, to);
        EXPECT_NEAR(path.length, FromCornerOfCube(cube.points[to]), 1e-12) << n << " " << to;
        const SurfacePath tight = paths.Tight(from, to);
        RequireTight(paths.graph, tight, from, to);
        EXPECT_GE(tight.length, path.length - 1e-12);
      }
    }
  }
}

/// Unrolled, a prism is a strip of the plane, and there are two ways around it.
TEST(SurfacePath, OnAPrism)
{
  const int sides = 15;
  const TriangleMesh prism = Prism(sides, 7, 2.0);
  Paths paths(prism);
  const double side = 2.0 * std::sin(Pi / sides);
  for (Id to = 1; to < static_cast<Id>(prism.points.size()); ++to)
  {
    const auto around = static_cast<double>(std::min(to % sides, sides - to % sides));
    const double exact = std::hypot(side * around, prism.points[to][2]);
    const SurfacePath path = paths.Shortest(0, to);
    RequireTight(paths.graph, path, 0, to);
    EXPECT_NEAR(path.length, exact, 1e-12) << to;
  }
}

/// Unrolled, a pyramid is a sector of the plane. Paths never go over the tip, because it has less
/// than the full angle.
TEST(SurfacePath, OnAPyramid)
{
  const int sides = 11;
  const TriangleMesh pyramid = Pyramid(sides, 6, 1.5);
  Paths paths(pyramid);
  const double edge = std::hypot(1.0, 1.5);
  const double perSide = 2.0 * std::asin(std::sin(Pi / sides) / edge);
  const Id from = static_cast<Id>(pyramid.points.size()) - sides;
  for (Id to = from - 2 * sides; to < from; ++to)
  {
    const auto turned = static_cast<double>((to - 1) % sides);
    const double angle = perSide * std::min(turned, sides - turned);
    const double radius = edge * pyramid.points[to].head(2).norm();
    const double exact =
      std::sqrt(edge * edge + radius * radius - 2.0 * edge * radius * std::cos(angle));
    const SurfacePath path = paths.Shortest(from, to);
    RequireTight(paths.graph, path, from, to);
    EXPECT_NEAR(path.length, exact, 1e-12) << to;
  }
}

/// The shortest path bends at corners of the hole.
TEST(SurfacePath, AroundAHole)
{
  for (const int thirds : { 2, 5 })
  {
    const TriangleMesh plate = PlateWithHole(thirds);
    Paths paths(plate);
    const Id from = PointAt(plate, { 1, 0, 0 });
    const std::vector<std::pair<Vec3, double>> exact = {
      { { 1, 3, 0 }, 3.0 },                             // along the hole
      { { 0, 1, 0 }, std::sqrt(2.0) },                  // straight
      { { 2, 3, 0 }, 2.0 + std::sqrt(2.0) },            // one corner
      { { 3, 3, 0 }, std::sqrt(2.0) + std::sqrt(5.0) }, // the corner at (2, 1)
    };
    for (const auto& [place, length] : exact)
    {
      const Id to = PointAt(plate, place);
      const SurfacePath path = paths.Shortest(from, to);
      RequireTight(paths.graph, path, from, to);
      EXPECT_NEAR(path.length, length, 1e-12) << place.transpose();
      RequireTight(paths.graph, paths.Tight(from, to), from, to);
    }
  }
}

/// The triangles of a fine sphere are within a part of the square of the edges of the sphere.
TEST(SurfacePath, OnASphere)
{
  const TriangleMesh sphere = GeodesicSphere(48);
  Paths paths(sphere);
  const auto count = static_cast<Id>(sphere.points.size());
  for (Id to = 1; to < count; to += count / 40)
  {
    const double exact = std::acos(std::clamp(sphere.points[0].dot(sphere.points[to]), -1.0, 1.0));
    const SurfacePath path = paths.Shortest(0, to);
    RequireTight(paths.graph, path, 0, to);
    EXPECT_NEAR(path.length, exact, 1e-3 * exact) << to;
  }
}

/// A finer search may come close to the shortest path from above, but not below it.
TEST(SurfacePath, IsBelowEveryWay)
{
  for (const TriangleMesh& mesh : { Torus(30, 12, 2.0, 0.7), Pulley(24, 0.1) })
  {
    Paths paths(mesh);
    const TriangleMesh fine = SubdivideInPlane(SubdivideInPlane(SubdivideInPlane(mesh)));
    Paths ways(fine);
    const auto count = static_cast<Id>(mesh.points.size());
    for (Id to = 3; to < count; to += count / 12)
    {
      const SurfacePath path = paths.Shortest(1, to);
      RequireTight(paths.graph, path, 1, to);
      ways.Way(1, to);
      const double way = ways.search.LengthTo(static_cast<Index>(to));
      EXPECT_LE(path.length, way * (1.0 + 1e-12));
      EXPECT_GE(path.length, 0.8 * way); // longer by the zigzag in thin triangles
      EXPECT_LE(path.length, paths.Tight(1, to).length * (1.0 + 1e-12));
    }
  }
}

/// Finer triangles in the same planes have the same paths.
TEST(SurfacePath, IsThatOfDividedTriangles)
{
  const TriangleMesh mesh = Torus(12, 7, 2.0, 0.7);
  Paths paths(mesh);
  Paths fine(SubdivideInPlane(mesh));
  for (Id to = 1; to < static_cast<Id>(mesh.points.size()); to += 5)
  {
    const double length = paths.Shortest(0, to).length;
    EXPECT_NEAR(fine.Shortest(0, to).length, length, 1e-11 * length) << to;
  }
}

TEST(SurfacePath, CrossesSeamsOfAnStlFile)
{
  const TriangleMesh cube = Unweld(Box(4));
  Paths paths(cube);
  const SurfacePath path = paths.Shortest(PointAt(cube, { 0, 0, 0 }), PointAt(cube, { 1, 1, 1 }));
  EXPECT_NEAR(path.length, std::sqrt(5.0), 1e-12);
}

/// Three half planes with a common edge: each pair is flat after unfolding. Copies of triangles and
/// triangles with two corners in one place change nothing.
TEST(SurfacePath, AcrossAnEdgeOfThreeTriangles)
{
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 0, 0, 2 }, { 1, 0, 1 }, { -1, 1, 1 }, { -1, -2, 1 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 }, { 1, 0, 3 }, { 2, 2, 0 }, { 0, 1, 3 } };
  Paths paths(mesh);
  for (const auto& [from, to] :
    std::vector<std::pair<Id, Id>>{ { 2, 3 }, { 3, 4 }, { 2, 4 }, { 4, 2 } })
  {
    const double exact = mesh.points[from].head(2).norm() + mesh.points[to].head(2).norm();
    const SurfacePath path = paths.Shortest(from, to);
    EXPECT_NEAR(path.length, exact, 1e-12);
    EXPECT_EQ(path.points.size(), 3u);
  }
}

/// Two squares that share a corner point alone.
TEST(SurfacePath, ThroughASinglePoint)
{
  const TriangleMesh square = FlatRectangle(3, 3);
  const TriangleMesh mesh =
    Join(square, Transform(square, { 0, 0, 1 }, 0.0, 1.0, { 1.0, 1.0, 0.0 }));
  Paths paths(mesh);
  const Id from = PointAt(mesh, { 0, 1.0 / 3, 0 });
  const SurfacePath path = paths.Shortest(from, PointAt(mesh, { 2, 1.0 + 1.0 / 3, 0 }));
  EXPECT_NEAR(path.length, std::hypot(1.0, 2.0 / 3) + std::hypot(1.0, 1.0 / 3), 1e-12);
}

/// A search that needs more windows than allowed reports it. Its ways are still paths.
TEST(SurfacePath, ASearchThatGivesUp)
{
  const TriangleMesh torus = Torus(40, 16, 2.0, 0.7);
  Paths paths(torus);
  const double shortest = paths.Shortest(0, 300).length;
  EXPECT_FALSE(paths.windows.From({ 0 }, { 300 }, 2.0 * shortest, 100, {}));
  EXPECT_GE(paths.windows.LengthTo(300), shortest * (1.0 - 1e-12));
}

/// On scans, the length is between the straight line and the way through corners and midpoints, and
/// the path is tight everywhere.
TEST(SurfacePath, OnRealMeshes)
{
  for (const char* name : { "rocker_arm.ply", "elephant_106_holes_4k.ply", "small/prim.off" })
  {
    const std::string file = RealMesh(name);
    if (file.empty())
    {
      continue;
    }
    const TriangleMesh mesh = ReadMesh(file);
    Paths paths(mesh);
    const auto count = static_cast<Id>(mesh.points.size());
    for (Id to = count / 7; to < count; to += count / 5)
    {
      const auto way = paths.Way(3, to);
      if (way.size() > 1)
      {
        const double longest = paths.search.LengthTo(paths.graph.PlaceOf(to));
        const SurfacePath path = paths.Shortest(3, to);
        RequireTight(paths.graph, path, 3, to);
        EXPECT_LE(path.length, longest * (1.0 + 1e-12));
      }
    }
  }
}
