// Curvatures and their directions against exact values, on good, irregular and bad triangles.
#include "Largest.h"
#include "Shape/PrincipalCurvatures.h"

#include "Base/Errors.h"
#include "Dense.h"
#include "Spaces.h"
#include "Spaces/HatSpace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Pi = 3.14159265358979323846;

struct Exact
{
  double minimum;
  double maximum;
  Vec3 maximumDirection; // zero where both are equal
};

using ExactAt = std::function<Exact(const Vec3&)>;

PrincipalCurvatures Curvatures(const TriangleMesh& mesh, int threads = 0)
{
  HatOptions options;
  options.unitLength = 3.0;
  options.threads = threads;
  const HatFunctions hats = NumberHatFunctions(mesh, options);
  return ComputeCurvatures(mesh, hats, PointNormals(mesh, hats, threads), threads);
}

/// The largest error of the curvatures, relative to the larger curvature, and of the directions.
struct Errors
{
  double curvature = 0.0;
  double degrees = 0.0;
};

Errors Compare(
  const TriangleMesh& mesh, const PrincipalCurvatures& computed, const ExactAt& exact,
  const std::function<bool(const Vec3&)>& counts = [](const Vec3&) { return true; })
{
  Errors errors;
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    if (!counts(mesh.points[p]))
    {
      continue;
    }
    const Exact at = exact(mesh.points[p]);
    const double size = std::max(std::abs(at.minimum), std::abs(at.maximum));
    for (const double difference :
      { computed.minimum[p] - at.minimum, computed.maximum[p] - at.maximum })
    {
      errors.curvature = Larger(errors.curvature, std::abs(difference) / size);
    }
    if (!at.maximumDirection.isZero())
    {
      const double cosine =
        std::abs(computed.maximumDirection[p].dot(at.maximumDirection.normalized()));
      errors.degrees = Larger(errors.degrees, std::acos(cosine >= 1.0 ? 1.0 : cosine) * 180.0 / Pi);
    }
  }
  return errors;
}

/// A flat rectangle [-1, 1]² whose points are moved to other places. Jitter moves them in the
/// plane, in units of a square's side.
TriangleMesh Bend(int n, const std::function<Vec3(double, double)>& place, double jitter = 0.0)
{
  TriangleMesh mesh = FlatRectangle(n, n, 2.0, 2.0);
  const MultiVector random = RandomValues(static_cast<Id>(mesh.points.size()), 2);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    const auto row = static_cast<Id>(p);
    mesh.points[p] = place(mesh.points[p][0] - 1.0 + jitter * 2.0 / n * random(row, 0),
      mesh.points[p][1] - 1.0 + jitter * 2.0 / n * random(row, 1));
  }
  return mesh;
}

Vec3 OnCylinder(double x, double y)
{
  return { 2.0 * std::cos(x), 2.0 * std::sin(x), 2.0 * y };
}

Exact OfCylinder(const Vec3& p)
{
  return { 0.0, 0.5, Vec3(-p[1], p[0], 0.0) };
}

Vec3 OnSaddle(double x, double y)
{
  return { x, y, 0.5 * (x * x - y * y) };
}

/// Exact curvatures of the graph of (x² - y²) / 2, seen from above: negative where it opens
/// upward.
Exact OfSaddle(const Vec3& p)
{
  const Vec3 u(1.0, 0.0, p[0]);
  const Vec3 v(0.0, 1.0, -p[1]);
  const double length = u.cross(v).norm();
  Eigen::Matrix2d first;
  first << u.dot(u), u.dot(v), u.dot(v), v.dot(v);
  const Eigen::Matrix2d second = Eigen::Vector2d(-1.0, 1.0).asDiagonal();
  const DenseEigenPairs pairs = DenseEigen(second / length, first);
  const Eigen::Vector2d maximum = pairs.vectors.col(1);
  return { pairs.values[0], pairs.values[1], maximum[0] * u + maximum[1] * v };
}

Exact OfTorus(const Vec3& p)
{
  constexpr double Radius = 1.0;
  constexpr double TubeRadius = 0.3;
  const double distance = std::hypot(p[0], p[1]);
  const double cosine = (distance - Radius) / TubeRadius;
  const Vec3 outwards(p[0] / distance, p[1] / distance, 0.0);
  return { cosine / distance, 1.0 / TubeRadius,
    Vec3(-p[2] * outwards + Vec3(0.0, 0.0, distance - Radius)) };
}

bool IsInside(const Vec3& p)
{
  return std::abs(p[0]) < 0.9 && std::abs(p[1]) < 0.9;
}

} // namespace

TEST(PrincipalCurvatures, OfASphereAreExact)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(20, 2.0), LatLongSphere(60, 31, 2.0),
         Unweld(GeodesicSphere(20, 2.0)), LatLongSphere(400, 5, 2.0) }) // needles
  {
    const Errors errors = Compare(mesh, Curvatures(mesh),
      [](const Vec3&) {
        return Exact{ 0.5, 0.5, Vec3::Zero() };
      });
    EXPECT_LE(errors.curvature, 1e-8) << mesh.points.size(); // needles lose digits
  }
}

TEST(PrincipalCurvatures, OfCylinderTorusAndSaddleUpToTheBoundary)
{
  const TriangleMesh cylinder = Bend(60, OnCylinder);
  const Errors ofCylinder = Compare(cylinder, Curvatures(cylinder), OfCylinder);
  const TriangleMesh torus = Torus(200, 80, 1.0, 0.3);
  const Errors ofTorus = Compare(torus, Curvatures(torus), OfTorus);
  const TriangleMesh saddle = Bend(150, OnSaddle); // first order at its boundary
  const Errors ofSaddle = Compare(saddle, Curvatures(saddle), OfSaddle);
  for (const Errors& errors : { ofCylinder, ofTorus, ofSaddle })
  {
    EXPECT_LE(errors.curvature, 0.02);
    EXPECT_LE(errors.degrees, 2.0);
  }
}

/// The normals of irregular triangles have errors of the triangles' size, so finer meshes do not
/// improve the differences. A little smoothing removes these errors.
TEST(PrincipalCurvatures, OfIrregularTrianglesAreBetterSmoothed)
{
  constexpr int Squares = 60;
  const TriangleMesh saddle = Bend(Squares, OnSaddle, 0.1);
  const HatFunctions around = NumberHatFunctions(saddle);
  const MultiVector normals = PointNormals(saddle, around);
  const Errors raw =
    Compare(saddle, ComputeCurvatures(saddle, around, normals), OfSaddle, IsInside);
  GridSpaceOptions options;
  options.functions.depth = 6;
  const HatSpace hats = BuildHatSpace(saddle, options);
  NormalSmoothing smoothing;
  smoothing.scale = 2.0 / Squares;
  for (const FiniteElementSpace* space :
    { static_cast<const FiniteElementSpace*>(&hats), hats.NestedLevels() })
  {
    SolveReport report;
    const MultiVector smooth = SmoothNormals(*space, normals, smoothing, report);
    EXPECT_TRUE(report.converged);
    const Errors errors =
      Compare(saddle, ComputeCurvatures(saddle, around, smooth), OfSaddle, IsInside);
    EXPECT_LE(errors.curvature, 0.02);
    EXPECT_LE(errors.degrees, 0.5);
    EXPECT_GT(raw.curvature, 2.0 * errors.curvature);
  }
}

/// Noise of a hundredth of an edge in the points of a sphere.
TEST(PrincipalCurvatures, OfANoisySphereAreFoundWithSmoothing)
{
  TriangleMesh mesh = GeodesicSphere(40, 2.0); // edges of about 0.07
  const MultiVector noise = RandomValues(static_cast<Id>(mesh.points.size()), 1);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    mesh.points[p] *= 1.0 + 0.0007 / 2.0 * noise(static_cast<Id>(p), 0);
  }
  const HatFunctions around = NumberHatFunctions(mesh);
  const MultiVector normals = PointNormals(mesh, around);
  const auto exact = [](const Vec3&) { return Exact{ 0.5, 0.5, Vec3::Zero() }; };
  GridSpaceOptions options;
  options.functions.depth = 6;
  NormalSmoothing smoothing;
  smoothing.scale = 0.3;
  SolveReport report;
  const MultiVector smooth =
    SmoothNormals(BuildGridSpace(mesh, options), normals, smoothing, report);
  EXPECT_GT(Compare(mesh, ComputeCurvatures(mesh, around, normals), exact).curvature, 0.2);
  EXPECT_LE(Compare(mesh, ComputeCurvatures(mesh, around, smooth), exact).curvature, 0.1);
}

TEST(PrincipalCurvatures, DoNotDependOnOrderSizeOrThreads)
{
  const TriangleMesh torus = Torus(40, 20, 1.0, 0.3);
  const PrincipalCurvatures one = Curvatures(torus, 1);
  const PrincipalCurvatures two = Curvatures(torus, 2);
  EXPECT_EQ(one.minimum, two.minimum);
  EXPECT_EQ(one.maximum, two.maximum);
  EXPECT_EQ(one.maximumDirection, two.maximumDirection);

  TriangleMesh turned = Transform(torus, { 1, 2, 3 }, 0.8, 1e5, { 1e6, 0, 0 });
  std::reverse(turned.triangles.begin(), turned.triangles.end());
  const PrincipalCurvatures large = Curvatures(turned);
  TriangleMesh insideOut = torus;
  for (auto& triangle : insideOut.triangles)
  {
    std::swap(triangle[0], triangle[1]);
  }
  const PrincipalCurvatures concave = Curvatures(insideOut);
  for (std::size_t p = 0; p < torus.points.size(); ++p)
  {
    EXPECT_NEAR(large.minimum[p] * 1e5, one.minimum[p], 1e-7);
    EXPECT_NEAR(large.maximum[p] * 1e5, one.maximum[p], 1e-7);
    EXPECT_NEAR(concave.minimum[p], -one.maximum[p], 1e-12);
    EXPECT_NEAR(concave.maximum[p], -one.minimum[p], 1e-12);
  }
}

/// Triangles without area, points without triangles, edges with three triangles, triangles of the
/// opposite orientation, a single triangle, and an empty mesh.
TEST(PrincipalCurvatures, OfBadMeshesAreFinite)
{
  TriangleMesh bad = GeodesicSphere(6);
  const PrincipalCurvatures good = Curvatures(bad);
  const auto points = static_cast<Id>(bad.points.size());
  bad.points.emplace_back(9, 9, 9);
  bad.points.emplace_back(0, 0, 3);
  bad.triangles.push_back({ 0, 0, 1 });
  bad.triangles.push_back({ bad.triangles[0][0], bad.triangles[0][1], points + 1 });
  std::swap(bad.triangles[20][0], bad.triangles[20][1]);
  const TriangleMesh alone = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } };
  for (const TriangleMesh& mesh : { bad, alone, TriangleMesh{} })
  {
    const PrincipalCurvatures c = Curvatures(mesh);
    ASSERT_EQ(c.minimum.size(), mesh.points.size());
    for (std::size_t p = 0; p < mesh.points.size(); ++p)
    {
      EXPECT_TRUE(std::isfinite(c.minimum[p]) && c.minimum[p] <= c.maximum[p]);
      EXPECT_TRUE(c.minimumDirection[p].allFinite() && c.maximumDirection[p].allFinite());
    }
  }
  const PrincipalCurvatures c = Curvatures(bad);
  EXPECT_EQ(c.maximum[points], 0.0);
  EXPECT_TRUE(c.maximumDirection[points].isZero(0.0));
  Id changed = 0;
  for (Id p = 0; p < points; ++p)
  {
    changed += std::abs(c.maximum[p] - good.maximum[p]) > 1e-9;
  }
  EXPECT_LE(changed, 20); // points around the two triangles
}

/// One point in a hundred is the end of a needle. Half of the others still lie beyond ±0.5.
TEST(PrincipalCurvatures, BendingShowsMostPointsWhateverTheExtremes)
{
  std::vector<double> curvature;
  for (int k = 1; k <= 99; ++k)
  {
    curvature.push_back(k % 2 ? k : -k);
  }
  curvature.push_back(1e9);
  const std::vector<double> bending = BendingOf(curvature, 1.0);
  const auto isStrong = [](double value) { return std::abs(value) >= 0.5; };
  EXPECT_NEAR(std::count_if(bending.begin(), bending.end(), isStrong), 50, 1);
  for (std::size_t k = 0; k < bending.size(); ++k)
  {
    EXPECT_LT(std::abs(bending[k]), 1.0);
    EXPECT_GT(bending[k] * curvature[k], 0.0);
  }
  EXPECT_NEAR(BendingOf({ 1e-9, -1e-9, 1e-9 }, 4.0).front(), 0.0, 1e-8); // flat up to rounding
  EXPECT_TRUE(BendingOf({}, 0.0).empty());
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(BendingOf({ infinity, 0.0, -infinity }, 0.0), (std::vector<double>{ 1.0, 0.0, -1.0 }));
}

TEST(PrincipalCurvatures, ShapeIndexTellsCupFromCap)
{
  EXPECT_DOUBLE_EQ(ShapeIndex(2, 2), 1.0);
  EXPECT_DOUBLE_EQ(ShapeIndex(0, 2), 0.5);
  EXPECT_DOUBLE_EQ(ShapeIndex(-2, 2), 0.0);
  EXPECT_DOUBLE_EQ(ShapeIndex(-2, 0), -0.5);
  EXPECT_DOUBLE_EQ(ShapeIndex(-2, -2), -1.0);
  EXPECT_DOUBLE_EQ(ShapeIndex(0, 0), 0.0);
}

TEST(PrincipalCurvatures, WhatDoesNotFitIsRefused)
{
  const TriangleMesh mesh = GeodesicSphere(3);
  const HatFunctions hats = NumberHatFunctions(mesh);
  EXPECT_THROW(PointNormals(GeodesicSphere(4), hats), InvalidInput);
  EXPECT_THROW(ComputeCurvatures(mesh, hats, MultiVector::Zero(3, 3)), InvalidInput);
  const GridSpace space = BuildGridSpace(mesh, {});
  SolveReport report;
  for (const double scale : { 0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity() })
  {
    NormalSmoothing smoothing;
    smoothing.scale = scale;
    EXPECT_THROW(SmoothNormals(space, PointNormals(mesh, hats), smoothing, report), InvalidInput);
  }
}
