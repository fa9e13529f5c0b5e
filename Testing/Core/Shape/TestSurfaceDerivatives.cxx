// Gradients and Laplacians against exact values, on both kinds of space.
#include "Shape/SurfaceDerivatives.h"

#include "Base/Errors.h"
#include "EitherSpace.h"
#include "Equations/EdgeConditions.h"
#include "Grid/TriangleArea.h"
#include "Largest.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

EquationOptions Options(int threads = 0)
{
  EquationOptions options;
  options.multigrid.threads = threads;
  options.solve.tolerance = 1e-9;
  return options;
}

std::unique_ptr<FiniteElementSpace> Build(
  const TriangleMesh& mesh, bool isOnHats, int depth, int threads = 0)
{
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.threads = threads;
  return BuildEither(mesh, isOnHats, options);
}

/// Relative root mean squares of the errors for f = x y on a sphere of radius 2. Its gradient is
/// (y, x, 0) without the normal part, and its Laplacian is -6 / r² f.
struct Errors
{
  double gradient = 0.0;
  double gradientOnTriangles = 0.0;
  double laplacian = 0.0;
};

Errors OnSphere(bool isOnHats, int depth, int fineness)
{
  constexpr double Radius = 2.0;
  const TriangleMesh mesh = Transform(GeodesicSphere(fineness, Radius), { 1, 2, 3 }, 0.4);
  const MultiVector points = PointCoordinates(mesh);
  const MultiVector f = points.col(0).cwiseProduct(points.col(1));
  const SurfaceDerivatives d = ComputeDerivatives(
    *Build(mesh, isOnHats, depth), mesh, { FieldAssociation::Points, f }, nullptr, Options());
  EXPECT_TRUE(d.report.converged);
  const auto exact = [](const Vec3& p)
  {
    const Vec3 normal = p.normalized();
    const Vec3 gradient(p[1], p[0], 0.0);
    return Vec3(gradient - normal.dot(gradient) * normal);
  };
  Errors error;
  double size = 0.0;
  for (Id i = 0; i < points.rows(); ++i)
  {
    const Vec3 expected = exact(points.row(i).transpose());
    error.gradient += (d.gradientAtPoints.row(i).transpose() - expected).squaredNorm();
    error.laplacian += std::pow(d.laplacianAtPoints(i, 0) + 6.0 / (Radius * Radius) * f(i, 0), 2);
    size += expected.squaredNorm();
  }
  error.gradient = std::sqrt(error.gradient / size);
  error.laplacian = std::sqrt(error.laplacian) / (6.0 / (Radius * Radius) * f.norm());
  size = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    const Vec3 expected =
      exact((mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]) / 3.0);
    error.gradientOnTriangles +=
      (d.gradientOnTriangles.row(static_cast<Id>(t)).transpose() - expected).squaredNorm();
    size += expected.squaredNorm();
  }
  error.gradientOnTriangles = std::sqrt(error.gradientOnTriangles / size);
  return error;
}

} // namespace

TEST(SurfaceDerivatives, OnAGridConvergeToThoseOfTheSphere)
{
  const Errors coarse = OnSphere(false, 3, 60);
  const Errors fine = OnSphere(false, 4, 60);
  EXPECT_LT(fine.gradient, 0.02);
  EXPECT_LT(fine.gradientOnTriangles, 0.03);
  EXPECT_LT(fine.laplacian, 0.05);
  EXPECT_LT(fine.gradient, 0.5 * coarse.gradient);
  EXPECT_LT(fine.laplacian, 0.35 * coarse.laplacian); // second order gives 0.25
}

TEST(SurfaceDerivatives, OnHatsConvergeToThoseOfTheSphere)
{
  const Errors coarse = OnSphere(true, 4, 12);
  const Errors fine = OnSphere(true, 5, 24);
  EXPECT_LT(fine.gradient, 0.02);
  EXPECT_LT(fine.laplacian, 0.05);
  EXPECT_LT(fine.gradient, 0.5 * coarse.gradient);
  EXPECT_LT(fine.laplacian, 0.5 * coarse.laplacian); // a second derivative of linear functions
}

/// A linear function on a flat sheet with boundaries: the gradient is constant, the Laplacian 0 up
/// to the edge.
TEST(SurfaceDerivatives, OfALinearFunctionAreExactUpToTheBoundary)
{
  const TriangleMesh mesh = Transform(TwoSheets(8, 0.4), { 1, 2, 3 }, 0.5, 3.0, { 7, 8, 9 });
  const Eigen::AngleAxisd turn(0.5, Vec3(1, 2, 3).normalized());
  const Vec3 slope = turn * Vec3(2, -1, 0);
  const MultiVector f = PointCoordinates(mesh) * slope;
  for (const bool isOnHats : { false, true })
  {
    const SurfaceDerivatives d = ComputeDerivatives(
      *Build(mesh, isOnHats, 4), mesh, { FieldAssociation::Points, f }, nullptr, Options());
    for (Id i = 0; i < f.rows(); ++i)
    {
      ASSERT_LT((d.gradientAtPoints.row(i).transpose() - slope).norm(), 1e-5) << isOnHats;
      ASSERT_LT(std::abs(d.laplacianAtPoints(i, 0)), 1e-4) << isOnHats;
    }
    for (Id t = 0; t < d.gradientOnTriangles.rows(); ++t)
    {
      ASSERT_LT((d.gradientOnTriangles.row(t).transpose() - slope).norm(), 1e-5) << isOnHats;
    }
  }
}

/// The largest errors at points of a boundary, for f on a surface with this gradient and Laplacian.
struct BoundaryErrors
{
  double gradient = 0.0;
  double laplacian = 0.0;
};

/// f = cosh z on an open cylinder of radius 1 and height 1, which is its own Laplacian. The cells
/// have the side of the mesh's edges.
BoundaryErrors OnTheRimOfACylinder(bool isOnHats, bool isOnPoints, int depth)
{
  const int along = 1 << depth >> 1; // the diameter, 2, fills the cube
  const int around = 6 * along;
  TriangleMesh cylinder = Mapped(FlatRectangle(around, along, 2.0 * std::acos(-1.0), 1.0),
    [](const Vec3& p) { return Vec3(std::cos(p[0]), std::sin(p[0]), p[1]); });
  for (auto& triangle : cylinder.triangles) // closes the seam
  {
    for (Id& point : triangle)
    {
      point -= point % (around + 1) == around ? around : 0;
    }
  }
  const Eigen::AngleAxisd turn(0.4, Vec3(1, 2, 3).normalized());
  const TriangleMesh mesh = Transform(cylinder, { 1, 2, 3 }, 0.4);
  const auto rows = static_cast<Id>(isOnPoints ? mesh.points.size() : mesh.triangles.size());
  Field f{ isOnPoints ? FieldAssociation::Points : FieldAssociation::Triangles,
    MultiVector(rows, 1) };
  for (Id k = 0; k < rows; ++k)
  {
    double z = isOnPoints ? cylinder.points[k][2] : 0.0;
    for (const Id point : isOnPoints ? std::array<Id, 3>{} : mesh.triangles[k])
    {
      z += isOnPoints ? 0.0 : cylinder.points[point][2] / 3.0;
    }
    f.values(k, 0) = std::cosh(z);
  }
  const auto space = BuildEither(mesh, isOnHats, depth, 1e-2);
  const MultiVector one = MultiVector::Ones(static_cast<Id>(mesh.points.size()), 1);
  const BoundaryTerms boundary = TermsOnBoundary(*space, mesh, false, &one, nullptr);
  EXPECT_TRUE(boundary.isThere);
  const SurfaceDerivatives d = ComputeDerivatives(*space, mesh, f, &boundary.load, Options());
  EXPECT_TRUE(d.report.converged);
  BoundaryErrors error;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    const double z = cylinder.points[k][2];
    const bool isUsed = static_cast<int>(k) % (around + 1) != around;
    if (isUsed && (z < 1e-9 || z > 1.0 - 1e-9))
    {
      const auto row = static_cast<Id>(k);
      const Vec3 exact = turn * Vec3(0, 0, std::sinh(z));
      error.gradient =
        Larger(error.gradient, (d.gradientAtPoints.row(row).transpose() - exact).norm());
      error.laplacian =
        Larger(error.laplacian, std::abs(d.laplacianAtPoints(row, 0) - std::cosh(z)));
    }
  }
  return error;
}

/// f and its derivatives are about 1.5 on the rim, and the cells have a side of 1/16 and 1/32 of
/// the height. Without the continuation, the Laplacian is off by 0.94 at points, at any depth. The
/// gradient of a field on triangles is off by 0.65.
TEST(SurfaceDerivatives, ConvergeUpToTheBoundary)
{
  for (const bool isOnHats : { false, true })
  {
    for (const bool isOnPoints : { true, false })
    {
      const BoundaryErrors coarse = OnTheRimOfACylinder(isOnHats, isOnPoints, 5);
      const BoundaryErrors fine = OnTheRimOfACylinder(isOnHats, isOnPoints, 6);
      EXPECT_LT(fine.gradient, isOnPoints ? 0.05 : 0.15) << isOnHats << isOnPoints;
      EXPECT_LT(fine.laplacian, isOnPoints ? 0.2 : 0.4) << isOnHats << isOnPoints;
      EXPECT_LT(fine.gradient, 0.7 * coarse.gradient) << isOnHats << isOnPoints;
      EXPECT_LT(fine.laplacian, (isOnPoints ? 0.7 : 0.9) * coarse.laplacian)
        << isOnHats << isOnPoints;
    }
  }
}

/// The Laplacian of x² is 2 on a flat strip, up to its edges.
TEST(SurfaceDerivatives, HaveTheLaplacianOfASquareUpToTheBoundary)
{
  const TriangleMesh flat = FlatRectangle(64, 16, 1.0, 0.25);
  const TriangleMesh mesh = Transform(flat, { 1, 2, 3 }, 0.6);
  const MultiVector f = PointCoordinates(flat).col(0).array().square();
  for (const bool isOnHats : { false, true })
  {
    const auto space = Build(mesh, isOnHats, 6);
    const MultiVector one = MultiVector::Ones(f.rows(), 1);
    const BoundaryTerms boundary = TermsOnBoundary(*space, mesh, false, &one, nullptr);
    const SurfaceDerivatives d =
      ComputeDerivatives(*space, mesh, { FieldAssociation::Points, f }, &boundary.load, Options());
    EXPECT_LT((d.laplacianAtPoints.array() - 2.0).abs().maxCoeff<Eigen::PropagateNaN>(), 0.1)
      << isOnHats;
    EXPECT_LT((d.laplacianOnTriangles.array() - 2.0).abs().maxCoeff<Eigen::PropagateNaN>(), 0.3)
      << isOnHats;
  }
}

TEST(SurfaceDerivatives, OfCellValuesAreThoseOfTheFieldTheySample)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(60), { 1, 2, 3 }, 0.4);
  MultiVector f(static_cast<Id>(mesh.triangles.size()), 1);
  for (Id t = 0; t < f.rows(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    f(t, 0) = (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]])[2] / 3.0;
  }
  const SurfaceDerivatives d = ComputeDerivatives(
    *Build(mesh, false, 5), mesh, { FieldAssociation::Triangles, f }, nullptr, Options());
  double error = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3 normal = mesh.points[i].normalized();
    const Vec3 expected = Vec3(0, 0, 1) - normal[2] * normal;
    error += (d.gradientAtPoints.row(static_cast<Id>(i)).transpose() - expected).squaredNorm();
    size += expected.squaredNorm();
  }
  EXPECT_LT(std::sqrt(error / size), 0.03);
}

TEST(SurfaceDerivatives, ScaleWithTheMeshAndTakeColumnsApart)
{
  const TriangleMesh mesh = Torus(30, 20, 1.0, 0.4);
  const TriangleMesh large = Transform(mesh, { 1, 0, 0 }, 0.0, 10.0);
  const MultiVector f = RandomValues(static_cast<Id>(mesh.points.size()), 2);
  const Field field{ FieldAssociation::Points, f };
  const Field second{ FieldAssociation::Points, f.rightCols(1) };
  for (const bool isOnHats : { false, true })
  {
    const auto space = Build(mesh, isOnHats, 4);
    const SurfaceDerivatives one = ComputeDerivatives(*space, mesh, field, nullptr, Options());
    const SurfaceDerivatives ten =
      ComputeDerivatives(*Build(large, isOnHats, 4), large, field, nullptr, Options());
    EXPECT_LT(RelativeDifference(10.0 * ten.gradientAtPoints, one.gradientAtPoints), 1e-6);
    EXPECT_LT(RelativeDifference(100.0 * ten.laplacianAtPoints, one.laplacianAtPoints), 1e-6);
    const SurfaceDerivatives alone = ComputeDerivatives(*space, mesh, second, nullptr, Options());
    EXPECT_LT(RelativeDifference(alone.gradientAtPoints, one.gradientAtPoints.rightCols(3)), 1e-5);
  }
}

/// The vectors p + w x p at points p are linear, so both spaces contain them. On every surface
/// their divergence is 2, from p alone, and n · rot is 2 w · n, from the rotation alone.
TEST(SurfaceDerivatives, OfARotationAndAScalingAreItsAxisAndTwo)
{
  const Vec3 axis(0.3, -0.5, 0.8);
  for (const TriangleMesh& mesh :
    { GeodesicSphere(24), Transform(Box(6), { 1, 2, 3 }, 0.4), Torus(40, 24, 1.0, 0.4) })
  {
    MultiVector vectors = PointCoordinates(mesh);
    for (Id i = 0; i < vectors.rows(); ++i)
    {
      SetRow(vectors, i, mesh.points[i] + axis.cross(mesh.points[i]));
    }
    for (const bool isOnHats : { false, true })
    {
      const SurfaceDerivatives d = ComputeDerivatives(
        *Build(mesh, isOnHats, 4), mesh, { FieldAssociation::Points, vectors }, nullptr, Options());
      EXPECT_LT((d.divergenceOnTriangles.array() - 2.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-5)
        << isOnHats;
      EXPECT_LT((d.divergenceAtPoints.array() - 2.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-5)
        << isOnHats;
      for (Id t = 0; t < d.curlOnTriangles.rows(); ++t)
      {
        const Vec3 normal = AreaVector(mesh.points, mesh.triangles[t]).normalized();
        ASSERT_NEAR(d.curlOnTriangles(t, 0), 2.0 * axis.dot(normal), 1e-5) << isOnHats;
      }
    }
  }
}

/// At points, the curl comes from smoothed gradients along mean normals.
TEST(SurfaceDerivatives, HaveTheCurlOfARotationAtPointsOfASphere)
{
  const Vec3 axis(0.3, -0.5, 0.8);
  const TriangleMesh mesh = GeodesicSphere(40);
  MultiVector vectors = PointCoordinates(mesh);
  for (Id i = 0; i < vectors.rows(); ++i)
  {
    SetRow(vectors, i, axis.cross(mesh.points[i]));
  }
  for (const bool isOnHats : { false, true })
  {
    const SurfaceDerivatives d = ComputeDerivatives(
      *Build(mesh, isOnHats, 5), mesh, { FieldAssociation::Points, vectors }, nullptr, Options());
    const MultiVector exact = 2.0 * PointCoordinates(mesh) * axis;
    EXPECT_LT(RelativeDifference(d.curlAtPoints, exact), 0.02) << isOnHats;
  }
}

TEST(SurfaceDerivatives, DoNotDependOnThreadsAndStopWhenAsked)
{
  const TriangleMesh mesh = GeodesicSphere(20);
  const Field f{ FieldAssociation::Points, RandomValues(static_cast<Id>(mesh.points.size()), 1) };
  const SurfaceDerivatives one =
    ComputeDerivatives(*Build(mesh, false, 5, 1), mesh, f, nullptr, Options(1), 1);
  const SurfaceDerivatives three =
    ComputeDerivatives(*Build(mesh, false, 5, 3), mesh, f, nullptr, Options(3), 3);
  EXPECT_EQ(one.gradientAtPoints, three.gradientAtPoints);
  EXPECT_EQ(one.laplacianAtPoints, three.laplacianAtPoints);
  const Job stop(0, Progress([](double done) { return done < 0.5; }));
  EXPECT_THROW(
    ComputeDerivatives(*Build(mesh, false, 5), mesh, f, nullptr, Options(), stop), Aborted);
}

TEST(SurfaceDerivatives, RefuseFieldsThatDoNotFit)
{
  const TriangleMesh mesh = GeodesicSphere(4);
  EXPECT_THROW(ComputeDerivatives(*Build(mesh, false, 3), mesh,
                 { FieldAssociation::Points, MultiVector::Ones(3, 1) }, nullptr, Options()),
    InvalidInput);
}
