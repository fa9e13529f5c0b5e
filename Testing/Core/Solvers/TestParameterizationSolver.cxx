// Flat maps against exact ones, and surfaces that are no disks.
#include "Solvers/ParameterizationSolver.h"

#include "Base/Errors.h"
#include "Largest.h"
#include "Meshes.h"
#include "Shape/DiskMap.h"
#include "Shape/IsometricMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Pi = 3.14159265358979323846;

using Solver = ParameterizationSolver;

Solver::Options Type(MapType type)
{
  Solver::Options options;
  options.mapType = type;
  return options;
}

Solver::Result Flatten(
  const TriangleMesh& mesh, const Solver::Options& options, int threads = 1, bool welds = true)
{
  SurfaceOptions surface;
  surface.space.threads = threads;
  surface.space.weldCoincidentPoints = welds;
  return Solver::Solve(std::make_shared<const TriangleMesh>(mesh), options, surface);
}

Solver::Result Flatten(const TriangleMesh& mesh, MapType kind)
{
  return Flatten(mesh, Type(kind));
}

/// Moves every point of a rectangle with [0, 1] along both sides.
TriangleMesh Bent(int nx, int ny, const std::function<Vec3(double, double)>& place)
{
  return Mapped(FlatRectangle(nx, ny), [&](const Vec3& p) { return place(p[0], p[1]); });
}

/// A part of a sphere around its pole. Lines of the square become rays and circles.
TriangleMesh Cap(int n, double polarAngle)
{
  return Bent(n, n,
    [&](double x, double y)
    {
      const double u = 2.0 * x - 1.0;
      const double v = 2.0 * y - 1.0;
      const double radius = std::max(std::abs(u), std::abs(v));
      const double norm = std::hypot(u, v);
      const double angle = radius * polarAngle;
      const double scale = norm > 0.0 ? std::sin(angle) / norm : 0.0;
      return Vec3(scale * u, scale * v, std::cos(angle));
    });
}

double LargestSize(const std::vector<double>& values)
{
  double largest = 0.0;
  for (const double value : values)
  {
    largest = Larger(largest, std::abs(value));
  }
  return largest;
}

/// The logarithm of the change of the length of each side: half the length counts as much as the
/// double.
std::vector<double> Stretches(const TriangleMesh& mesh, const Solver::Result& result)
{
  std::vector<double> stretches;
  for (const auto& corner : result.flat.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Id a = corner[k];
      const Id b = corner[(k + 1) % 3];
      const double length =
        (mesh.points[result.flat.pointOf[a]] - mesh.points[result.flat.pointOf[b]]).norm();
      const double flat = (result.flat.points.row(a) - result.flat.points.row(b)).norm();
      stretches.push_back(std::log(flat / length));
    }
  }
  return stretches;
}

double LargestStretch(const TriangleMesh& mesh, const Solver::Result& result)
{
  return LargestSize(Stretches(mesh, result));
}

double MeanStretch(const TriangleMesh& mesh, const Solver::Result& result)
{
  double sum = 0.0;
  const std::vector<double> stretches = Stretches(mesh, result);
  for (const double stretch : stretches)
  {
    sum += std::abs(stretch);
  }
  return sum / double(stretches.size());
}

/// The largest distance between the map of a cap and the best turned, scaled and moved copy of its
/// stereographic map, whose radius is 1.
double StereographicError(const TriangleMesh& mesh, const Solver::Result& result, double polarAngle)
{
  using Complex = std::complex<double>;
  std::vector<Complex> exact;
  std::vector<Complex> map;
  Complex meanExact = 0.0;
  Complex meanMap = 0.0;
  for (std::size_t v = 0; v < result.flat.pointOf.size(); ++v)
  {
    const Vec3& p = mesh.points[result.flat.pointOf[v]];
    exact.push_back(Complex(p[0], p[1]) / (1.0 + p[2]) / std::tan(polarAngle / 2.0));
    map.emplace_back(
      result.flat.points(static_cast<Id>(v), 0), result.flat.points(static_cast<Id>(v), 1));
    meanExact += exact.back() / double(mesh.points.size());
    meanMap += map.back() / double(mesh.points.size());
  }
  Complex product = 0.0;
  double square = 0.0;
  for (std::size_t v = 0; v < map.size(); ++v)
  {
    product += std::conj(map[v] - meanMap) * (exact[v] - meanExact);
    square += std::norm(map[v] - meanMap);
  }
  double largest = 0.0;
  for (std::size_t v = 0; v < map.size(); ++v)
  {
    largest =
      Larger(largest, std::abs(product / square * (map[v] - meanMap) - (exact[v] - meanExact)));
  }
  return largest;
}

/// Vertices - edges + triangles of a flat map.
Id EulerOf(const Solver::Flat& flat)
{
  std::set<std::array<Id, 2>> edges;
  std::set<Id> vertices;
  for (const auto& c : flat.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      edges.insert({ std::min(c[k], c[(k + 1) % 3]), std::max(c[k], c[(k + 1) % 3]) });
      vertices.insert(c[k]);
    }
  }
  return Id(vertices.size()) - Id(edges.size()) + Id(flat.triangles.size());
}

Id Flipped(const Solver::Result& result)
{
  return std::count(result.flat.angle.begin(), result.flat.angle.end(), 180.0);
}

TriangleMesh Tube(int around, int along, double height)
{
  return Bent(around, along,
    [&](double x, double y)
    {
      const double angle = 2.0 * Pi * (x < 1.0 ? x : 0.0);
      return Vec3(std::cos(angle), std::sin(angle), height * y);
    });
}

TriangleMesh MoebiusStrip(int along)
{
  TriangleMesh mesh = Bent(along, 4,
    [](double x, double y)
    {
      const double angle = 2.0 * Pi * x;
      const double r = 1.0 + 0.6 * (y - 0.5) * std::cos(angle / 2.0);
      return Vec3(
        r * std::cos(angle), r * std::sin(angle), 0.6 * (y - 0.5) * std::sin(angle / 2.0));
    });
  for (std::size_t a = 0; a < mesh.points.size(); ++a) // the ends coincide except for rounding
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      if ((mesh.points[a] - mesh.points[b]).norm() < 1e-9)
      {
        mesh.points[a] = mesh.points[b];
      }
    }
  }
  return mesh;
}

/// Joins coincident points. Those that are left over stay, without triangles.
TriangleMesh Welded(TriangleMesh mesh)
{
  const Array<Index> place = WeldCoincidentPoints(mesh.points, {}, 1);
  for (auto& corners : mesh.triangles)
  {
    for (Id& corner : corners)
    {
      corner = place[corner];
    }
  }
  return mesh;
}

TriangleMesh Without(TriangleMesh mesh, const std::set<Id>& triangles)
{
  std::vector<std::array<Id, 3>> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    if (triangles.count(static_cast<Id>(t)) == 0)
    {
      kept.push_back(mesh.triangles[t]);
    }
  }
  mesh.triangles = kept;
  return mesh;
}

/// Connects the first triangle by a tunnel with one near by, three edges away or a little more.
TriangleMesh WithHandle(const TriangleMesh& closed)
{
  const auto& a = closed.triangles.front();
  const double edge = (closed.points[a[1]] - closed.points[a[0]]).norm();
  const auto distance = [&](Id t)
  {
    const double length = (closed.points[a[0]] - closed.points[closed.triangles[t][0]]).norm();
    return length < 3.0 * edge ? 1e9 : length;
  };
  Id nearest = 1;
  for (Id t = 2; t < static_cast<Id>(closed.triangles.size()); ++t)
  {
    nearest = distance(t) < distance(nearest) ? t : nearest;
  }
  TriangleMesh mesh = Without(closed, { 0, nearest });
  const auto& b = closed.triangles[nearest];
  for (int k = 0; k < 3; ++k)
  {
    const Id from = b[(3 - k) % 3];
    mesh.triangles.push_back({ a[k], a[(k + 1) % 3], from });
    mesh.triangles.push_back({ a[k], from, b[(4 - k) % 3] });
  }
  return mesh;
}

/// A plate of radius 1 with a closed finger in its middle, open at the border of the plate.
TriangleMesh Finger(int n, double radius, double height)
{
  return Bent(n, n,
    [&](double x, double y)
    {
      const double u = 2.0 * x - 1.0;
      const double v = 2.0 * y - 1.0;
      const double ring = std::max(std::abs(u), std::abs(v));
      const double norm = std::hypot(u, v);
      const double r = ring > 0.6   ? radius + (1.0 - radius) * (ring - 0.6) / 0.4
                       : ring > 0.1 ? radius
                                    : radius * ring / 0.1;
      const double z = ring > 0.6 ? 0.0 : ring > 0.1 ? height * (0.6 - ring) / 0.5 : height;
      return norm > 0.0 ? Vec3(r * u / norm, r * v / norm, z) : Vec3(0.0, 0.0, z);
    });
}

} // namespace

/// Faces of these surfaces are planar, and their edges straight in the plane.
TEST(ParameterizationSolver, DevelopableSurfacesKeepAllLengths)
{
  const std::map<std::string, TriangleMesh> surfaces{ { "rectangle",
                                                        FlatRectangle(9, 5, 3.0, 0.7) },
    { "wavy border", Bent(12, 8,
                       [](double x, double y)
                       {
                         const double u = x + 0.1 * std::sin(7 * y);
                         const double v = y + 0.1 * std::sin(8 * x);
                         return Vec3(u, v, 0.3 * u - v);
                       }) },
    { "cylinder", Bent(30, 7,
                    [](double x, double y)
                    { return Vec3(2 * std::cos(4 * x), 2 * std::sin(4 * x), 5 * y * y); }) },
    { "cone", Bent(30, 7,
                [](double x, double y)
                {
                  const double r = 0.2 + y;
                  return Vec3(r * std::cos(5 * x), r * std::sin(5 * x), 3 * r);
                }) } };
  for (const auto& [name, mesh] : surfaces)
  {
    for (const MapType kind : { MapType::Conformal, MapType::Isometric })
    {
      const Solver::Result result = Flatten(mesh, kind);
      EXPECT_LT(LargestStretch(mesh, result), 1e-8) << name;
      EXPECT_LT(LargestSize(result.flat.angle), 1e-4) << name; // degrees
      EXPECT_LT(LargestSize(result.flat.area), 1e-7) << name;
      EXPECT_EQ(Flipped(result), 0) << name;
      EXPECT_TRUE(result.warnings.empty());
      EXPECT_FALSE(result.splitsPoints);
    }
  }
}

/// The scale is the same along the boundary, a circle. The only such conformal map is the
/// stereographic one. Linear triangles bring an error of second order, and angles of first.
TEST(ParameterizationSolver, ACapTendsToItsStereographicMap)
{
  for (const double polarAngle : { 0.8, Pi / 2.0, 2.0 }) // beyond 120 degrees the cap is cut
  {
    std::vector<double> error;
    std::vector<double> angle;
    for (const int n : { 16, 32, 64 })
    {
      const TriangleMesh mesh = Cap(n, polarAngle);
      const Solver::Result result = Flatten(mesh, MapType::Conformal);
      error.push_back(StereographicError(mesh, result, polarAngle));
      angle.push_back(result.charts.front().angle);
      EXPECT_EQ(Flipped(result), 0);
    }
    EXPECT_LT(error[1], error[0] / 2.7) << polarAngle;
    EXPECT_LT(error[2], error[1] / 2.7) << polarAngle;
    EXPECT_LT(angle[1], angle[0] / 1.7) << polarAngle;
    EXPECT_LT(angle[2], angle[1] / 1.7) << polarAngle;
    EXPECT_LT(error[2], 2e-3) << polarAngle;
  }
}

/// No map of a hemisphere keeps lengths. The isometric one changes areas less than the conformal.
TEST(ParameterizationSolver, IsometricMapsChangeAreasLess)
{
  const TriangleMesh mesh = Cap(24, Pi / 2.0);
  const Solver::Result conformal = Flatten(mesh, MapType::Conformal);
  const Solver::Result isometric = Flatten(mesh, MapType::Isometric);
  EXPECT_LT(isometric.charts[0].area, 0.7 * conformal.charts[0].area);
  EXPECT_LT(MeanStretch(mesh, isometric), 0.9 * MeanStretch(mesh, conformal));
  EXPECT_EQ(Flipped(isometric), 0);
}

/// The conformal map makes the finger's end a thousand times smaller than its root. Steps that stop
/// short of a flipped triangle, instead of being kept away from one, would leave it so.
TEST(ParameterizationSolver, IsometricMapsOpenThinParts)
{
  for (const double radius : { 0.3, 0.2 })
  {
    const TriangleMesh mesh = Finger(40, radius, 1.2);
    const Solver::Result conformal = Flatten(mesh, MapType::Conformal);
    const Solver::Result isometric = Flatten(mesh, MapType::Isometric);
    EXPECT_FALSE(isometric.splitsPoints); // no cuts
    EXPECT_LT(*std::min_element(conformal.flat.area.begin(), conformal.flat.area.end()), -9.0);
    EXPECT_GT(*std::min_element(isometric.flat.area.begin(), isometric.flat.area.end()), -4.5);
    EXPECT_LT(isometric.charts[0].area, 0.5 * conformal.charts[0].area);
    EXPECT_EQ(Flipped(isometric), 0);
    EXPECT_TRUE(isometric.charts[0].hasConverged);
    EXPECT_GT(isometric.charts[0].steps, 0);
    EXPECT_LT(isometric.charts[0].gain, 1e-3);
    EXPECT_TRUE(isometric.warnings.empty());
    EXPECT_EQ(conformal.charts[0].steps, 0);
  }
}

/// The end of this finger is smaller than the rounding of coordinates in any map that starts an
/// isometric one.
TEST(ParameterizationSolver, SaysThatAnIsometricMapHasNotConverged)
{
  const TriangleMesh mesh = Finger(100, 0.01, 1.0);
  const Solver::Result result = Flatten(mesh, MapType::Isometric);
  EXPECT_FALSE(result.charts[0].hasConverged);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings[0].find("has not converged"), std::string::npos);
  EXPECT_TRUE(result.flat.points.allFinite());
}

/// No step improves a map whose triangles are flipped, so no gain of a step is known.
TEST(IsometricMap, AFlippedStartIsReturnedWithoutAGain)
{
  const gridfem::Disk disk = OpenToDisks(FlatRectangle(4, 4), {}).front();
  MultiVector flipped(disk.NumberOfVertices(), 2);
  for (Index v = 0; v < disk.NumberOfVertices(); ++v)
  {
    flipped.row(v) << -disk.points[v].x(), disk.points[v].y();
  }
  const PlaneMap map = MapIsometrically(disk, DiskMap(disk).Sides(), flipped, {});
  EXPECT_FALSE(map.hasConverged);
  EXPECT_EQ(map.steps, 0);
  EXPECT_TRUE(std::isnan(map.gain));
  EXPECT_EQ(map.plane, flipped);
}

/// A closed surface faces outward, whichever way most of its triangles face. Its map shows it from
/// outside, like all filters that ask for the side.
TEST(ParameterizationSolver, TheMapIsSeenFromOutside)
{
  for (const std::size_t every : { 2, 3, 7 })
  {
    TriangleMesh mesh = GeodesicSphere(6);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      if (t % every != 0)
      {
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      }
    }
    const Solver::Result result = Flatten(mesh, MapType::Conformal);
    ASSERT_EQ(Flipped(result), 0);
    Id outward = 0;
    for (const auto& corner : result.flat.triangles)
    {
      const Vec3& a = mesh.points[result.flat.pointOf[corner[0]]];
      const Vec3& b = mesh.points[result.flat.pointOf[corner[1]]];
      const Vec3& c = mesh.points[result.flat.pointOf[corner[2]]];
      outward += a.cross(b).dot(c) > 0.0 ? 1 : 0;
    }
    EXPECT_EQ(outward, Id(mesh.triangles.size())) << every;
  }
}

/// Thin triangles with negative cotangents would fold a harmonic map.
TEST(ParameterizationSolver, TheCircleHasNoFolds)
{
  TriangleMesh mesh = Bent(40, 6,
    [](double x, double y)
    {
      return Vec3(x + 0.3 * std::sin(40 * y) * y * (1 - y), 0.02 * y + 0.001 * std::sin(90 * x),
        0.3 * std::sin(20 * x) * std::sin(17 * y));
    });
  const Solver::Result result = Flatten(mesh, MapType::Circle);
  EXPECT_EQ(Flipped(result), 0);
  double area = 0.0;
  for (const auto& c : mesh.triangles)
  {
    area +=
      0.5 *
      (mesh.points[c[1]] - mesh.points[c[0]]).cross(mesh.points[c[2]] - mesh.points[c[0]]).norm();
  }
  // The polygon on the circle has an area a little smaller than the circle.
  const double radius = 0.5 * result.flat.points.col(0).maxCoeff<Eigen::PropagateNaN>();
  EXPECT_NEAR(Pi * radius * radius / area, 1.0, 0.01);
  int onCircle = 0;
  for (Id v = 0; v < result.flat.points.rows(); ++v)
  {
    const double distance = (result.flat.points.row(v) - Eigen::RowVector2d(radius, radius)).norm();
    EXPECT_LT(distance, 1.01 * radius);
    onCircle += distance > 0.9999 * radius ? 1 : 0;
  }
  EXPECT_EQ(onCircle, 2 * (40 + 6));
}

TEST(ParameterizationSolver, SurfacesThatAreNoDisksAreOpened)
{
  struct Case
  {
    std::string name;
    TriangleMesh mesh;
    Id euler;
    Id loops;
    Id filled = 0;
  };
  TriangleMesh holes = FlatRectangle(12, 12);
  holes.triangles.erase(holes.triangles.begin() + 150, holes.triangles.begin() + 154);
  holes.triangles.erase(holes.triangles.begin() + 50);
  const std::vector<Case> cases{ { "sphere", GeodesicSphere(6), 2, 0 },
    { "box of soup", Unweld(Box(4)), 2, 0 }, { "torus", Torus(30, 16, 2.0, 0.8), 0, 0 },
    { "knot", TrefoilTube(150, 8), 0, 0 }, { "tube", Tube(24, 8, 3.0), 0, 2 },
    { "plate with holes", holes, -1, 3, 2 }, { "pulley", Pulley(24, 0.3), 0, 0 } };
  for (const Case& c : cases)
  {
    for (const MapType kind : { MapType::Conformal, MapType::Isometric, MapType::Circle })
    {
      const Solver::Result result = Flatten(c.mesh, kind);
      ASSERT_EQ(result.charts.size(), 1u) << c.name;
      const Solver::Chart& chart = result.charts.front();
      EXPECT_EQ(chart.topology.euler, c.euler) << c.name;
      EXPECT_EQ(chart.topology.loops, c.loops) << c.name;
      EXPECT_EQ(result.flat.triangles.size(), c.mesh.triangles.size()) << c.name;
      EXPECT_EQ(EulerOf(result.flat), 1 - c.filled) << c.name;
      EXPECT_TRUE(result.flat.texture.allFinite());
      EXPECT_EQ(result.flat.texture.minCoeff<Eigen::PropagateNaN>(), 0.0);
      EXPECT_EQ(result.flat.texture.maxCoeff<Eigen::PropagateNaN>(), 1.0);
      EXPECT_EQ(Flipped(result), chart.flipped);
      EXPECT_EQ(Flipped(result), 0) << c.name << " " << int(kind);
    }
  }
}

/// The tube is cut along its height, and becomes a rectangle.
TEST(ParameterizationSolver, ATubeIsUnrolled)
{
  const TriangleMesh mesh = Tube(24, 8, 3.0);
  const Solver::Result result = Flatten(mesh, MapType::Conformal);
  EXPECT_EQ(result.flat.pointOf.size(), (24u + 1u) * 9u); // eight edges are cut
  EXPECT_LT(LargestStretch(mesh, result), 1e-8);
  const double around = 24 * 2.0 * std::sin(Pi / 24.0);
  EXPECT_NEAR(result.flat.points.col(0).maxCoeff<Eigen::PropagateNaN>(), around, 1e-8);
  EXPECT_NEAR(result.flat.points.col(1).maxCoeff<Eigen::PropagateNaN>(), 3.0, 1e-8);
  Solver::Options filled;
  filled.holeSize = 1.0;
  const Solver::Result capped = Flatten(Tube(24, 8, 1.0), filled);
  EXPECT_EQ(EulerOf(capped.flat), 0); // not cut
}

TEST(ParameterizationSolver, AStripWithOneSideIsCut)
{
  const Solver::Result result = Flatten(MoebiusStrip(40), MapType::Isometric);
  ASSERT_EQ(result.charts.size(), 1u);
  EXPECT_EQ(EulerOf(result.flat), 1);
  EXPECT_EQ(Flipped(result), 0);
}

/// Texture coordinates on points need one vertex for each point. It has to be a corner of the flat
/// triangles where the point is a corner of the triangles of the mesh.
TEST(ParameterizationSolver, SplitsPointsIfOneHasSeveralVertices)
{
  TriangleMesh book; // three pages
  book.points = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 1, 0, 1 }, { -1, 1, 0 }, { -1, 1, 1 },
    { -1, -1, 0 }, { -1, -1, 1 } };
  book.triangles = { { 0, 1, 2 }, { 1, 3, 2 }, { 0, 1, 4 }, { 1, 5, 4 }, { 0, 1, 6 }, { 1, 7, 6 } };
  TriangleMesh tie; // two triangles with one common point
  tie.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { -1, 0, 0 }, { -1, -1, 0 } };
  tie.triangles = { { 0, 1, 2 }, { 0, 3, 4 } };
  const std::map<std::string, std::pair<TriangleMesh, bool>> surfaces{
    { "plate", { FlatRectangle(4, 3), false } }, { "sphere", { GeodesicSphere(4), true } },
    { "soup of a box", { Unweld(Box(3)), false } }, { "strip", { Welded(MoebiusStrip(30)), true } },
    { "book", { book, true } }, { "tie", { tie, true } },
    { "loose pages", { Unweld(book), false } }, { "tube", { Welded(Tube(20, 5, 2.0)), true } }
  };
  for (const auto& [name, surface] : surfaces)
  {
    const auto& [mesh, isSplit] = surface;
    const Solver::Result result = Flatten(mesh, MapType::Conformal);
    EXPECT_EQ(result.splitsPoints, isSplit) << name;
    bool isOneVertex = true;
    for (std::size_t k = 0; k < result.flat.triangles.size(); ++k)
    {
      const auto& corners = mesh.triangles[result.flat.triangleOf[k]];
      const std::set<Id> wanted(result.flat.triangles[k].begin(), result.flat.triangles[k].end());
      const std::set<Id> noted{ result.flat.vertexOf[corners[0]], result.flat.vertexOf[corners[1]],
        result.flat.vertexOf[corners[2]] };
      isOneVertex = isOneVertex && wanted == noted;
    }
    EXPECT_EQ(isOneVertex, !isSplit) << name;
  }
}

/// Sheets that touch, edges of three triangles, triangles that face against each other, and
/// triangles without area.
TEST(ParameterizationSolver, EveryPieceIsAChart)
{
  TriangleMesh mesh = FlatRectangle(4, 4);
  const TriangleMesh other = Transform(FlatRectangle(3, 3), { 1, 0, 0 }, 1.0);
  mesh = Join(mesh, other); // shares an edge of the border
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  mesh.points.push_back({ 0.1, 0.2, 5.0 });
  const auto first = mesh.triangles[10];
  mesh.triangles.push_back({ first[0], first[1], Id(mesh.points.size()) - 1 });
  mesh.triangles.push_back({ first[0], first[0], first[1] });
  const Solver::Result result = Flatten(mesh, MapType::Conformal);
  EXPECT_EQ(result.charts.size(), 3u);
  EXPECT_EQ(result.flat.triangles.size(), mesh.triangles.size() - 1);
  EXPECT_EQ(Flipped(result), 0);
  EXPECT_TRUE(std::is_sorted(result.flat.triangleOf.begin(), result.flat.triangleOf.end()));
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    const Id vertex = result.flat.vertexOf[p];
    ASSERT_GE(vertex, 0) << p;
    EXPECT_EQ(mesh.points[result.flat.pointOf[vertex]], mesh.points[p]);
  }
  EXPECT_TRUE(std::is_sorted(result.flat.pointOf.begin(), result.flat.pointOf.end()));
}

/// A surface that was appended to itself has every triangle and every point twice.
TEST(ParameterizationSolver, CopiesOfTrianglesAreLeftOut)
{
  const TriangleMesh plate = FlatRectangle(5, 5);
  TriangleMesh turned = plate;
  for (auto& triangle : turned.triangles)
  {
    std::swap(triangle[0], triangle[1]);
  }
  for (const TriangleMesh& copy : { plate, turned, Unweld(plate) })
  {
    const Solver::Result result = Flatten(Join(plate, copy), MapType::Conformal);
    EXPECT_EQ(result.charts.size(), 1u);
    EXPECT_EQ(result.flat.triangles.size(), plate.triangles.size());
    EXPECT_EQ(Flipped(result), 0);
    EXPECT_FALSE(result.splitsPoints);
    const std::vector<Vec3> points = Join(plate, copy).points;
    for (std::size_t p = 0; p < points.size(); ++p)
    {
      const Id vertex = result.flat.vertexOf[p];
      ASSERT_GE(vertex, 0) << p;
      EXPECT_EQ(points[result.flat.pointOf[vertex]], points[p]);
    }
  }
}

/// Squares of lengths of a part of 1e-300 are 0, so nothing tells where to cut it. It has no chart.
TEST(ParameterizationSolver, PartsWithoutAMeasurableAreaAreLeftOut)
{
  const TriangleMesh sheet = FlatRectangle(4, 4);
  const TriangleMesh both = Join(sheet, GeodesicSphere(3, 1e-300));
  const Solver::Result result = Flatten(both, MapType::Conformal);
  EXPECT_EQ(result.charts.size(), 1u);
  EXPECT_EQ(Flatten(sheet, MapType::Conformal).charts.size(), 1u);
}

TEST(ParameterizationSolver, SameBitsOnAnyNumberOfThreads)
{
  const TriangleMesh mesh = Torus(60, 40, 2.0, 0.8);
  for (const MapType kind : { MapType::Conformal, MapType::Isometric, MapType::Circle })
  {
    const Solver::Result one = Flatten(mesh, Type(kind), 1);
    const Solver::Result three = Flatten(mesh, Type(kind), 3);
    EXPECT_TRUE(one.flat.points == three.flat.points);
    EXPECT_EQ(one.flat.triangles, three.flat.triangles);
    EXPECT_EQ(one.flat.area, three.flat.area);
  }
}

TEST(ParameterizationSolver, MoreCutsDistortLess)
{
  const TriangleMesh mesh = GeodesicSphere(12);
  Solver::Options more = Type(MapType::Isometric);
  const double eight = Flatten(mesh, more).charts.front().area; // a closed surface has so many
  more.extraCuts = 32;
  const Solver::Result result = Flatten(mesh, more);
  EXPECT_LT(result.charts.front().area, 0.8 * eight);
  EXPECT_EQ(EulerOf(result.flat), 1);
}

/// A surface with holes that are small for its area, or with a small handle, needs the cuts of a
/// closed one. One hole alone leaves a disk, whose conformal map is a hundred times smaller in its
/// middle.
TEST(ParameterizationSolver, SmallHolesAndHandlesHardlyChangeTheDistortion)
{
  struct Case
  {
    std::string name;
    TriangleMesh mesh;
    double holeSize;
    Id genus = 0;
  };
  for (const TriangleMesh& closed : { GeodesicSphere(14), Box(14) })
  {
    const auto last = static_cast<Id>(closed.triangles.size()) - 1;
    const std::vector<Case> cases{ { "one hole", Without(closed, { 7 }), 0.5 },
      { "one hole, none filled", Without(closed, { 7 }), 0.0 },
      { "two holes", Without(closed, { 3, 33 }), 0.5 },
      { "three holes", Without(closed, { 0, last / 2, last }), 0.5 },
      { "handle", WithHandle(closed), 0.5, 1 } };
    for (const MapType kind : { MapType::Conformal, MapType::Isometric })
    {
      const double usual = Flatten(closed, kind).charts.front().area;
      for (const Case& c : cases)
      {
        Solver::Options options = Type(kind);
        options.holeSize = c.holeSize;
        const Solver::Result result = Flatten(c.mesh, options);
        ASSERT_EQ(result.charts.size(), 1u) << c.name;
        EXPECT_EQ(result.charts.front().topology.Genus(), c.genus) << c.name;
        EXPECT_LT(result.charts.front().area, 1.6 * usual) << c.name << " " << int(kind);
        EXPECT_EQ(Flipped(result), 0) << c.name << " " << int(kind);
      }
    }
  }
}

TEST(ParameterizationSolver, RefusesWhatHasNoTriangles)
{
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0 } };
  mesh.triangles = { { 0, 1, 1 } };
  EXPECT_THROW(Flatten(mesh, MapType::Conformal), InvalidInput);
  Solver::Options options;
  options.holeSize = 1.5;
  EXPECT_THROW(Flatten(Box(2), options), InvalidInput);
}

/// Halves of scans: the map flips no triangle.
TEST(ParameterizationSolver, HalvesOfScansHaveNoFolds)
{
  for (const std::string name : { "stanford_bunny.ply", "rocker_arm.ply", "armadillo_100k.ply" })
  {
    const std::string path = RealMesh(name);
    if (path.empty())
    {
      GTEST_SKIP() << "needs GRIDFEM_DATA_DIR";
    }
    TriangleMesh mesh = ReadMesh(path);
    const Bounds bounds = BoundsOf(mesh.points);
    const double middle = 0.5 * (bounds.low[1] + bounds.high[1]);
    mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                           [&](const auto& c) { return mesh.points[c[0]][1] < middle; }),
      mesh.triangles.end());
    for (const MapType kind : { MapType::Conformal, MapType::Isometric, MapType::Circle })
    {
      const Solver::Result result = Flatten(mesh, kind);
      EXPECT_EQ(Flipped(result), 0) << name << " " << int(kind);
    }
  }
}
