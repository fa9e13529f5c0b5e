// Tests that triangles are made to face the same way. Random turns are undone, copies are left out,
// and a mesh that is already oriented stays as it is.
#include "Grid/OrientedMesh.h"

#include "Meshes.h"
#include "Shape/PrincipalCurvatures.h"
#include "Support/Largest.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

double VolumeOf(const TriangleMesh& mesh)
{
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    volume += mesh.points[a].cross(mesh.points[b]).dot(mesh.points[c]) / 6.0;
  }
  return volume;
}

/// Adds every triangle again, the same way round or the other.
TriangleMesh Double(TriangleMesh mesh, bool turned)
{
  const std::size_t count = mesh.triangles.size();
  for (std::size_t t = 0; t < count; ++t)
  {
    auto copy = mesh.triangles[t];
    if (turned)
    {
      std::reverse(copy.begin(), copy.end());
    }
    mesh.triangles.push_back(copy);
  }
  return mesh;
}

/// A strip with one half turn.
TriangleMesh Moebius(int around)
{
  TriangleMesh mesh;
  for (int k = 0; k < around; ++k)
  {
    const double angle = 2.0 * M_PI * k / around;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 across = std::cos(angle / 2) * out + std::sin(angle / 2) * Vec3(0.0, 0.0, 1.0);
    mesh.points.push_back(out - 0.2 * across);
    mesh.points.push_back(out + 0.2 * across);
  }
  for (Id k = 0; k < around; ++k)
  {
    const bool isLast = k + 1 == around;
    const Id low = isLast ? 1 : 2 * k + 2; // the ends are joined crosswise
    const Id high = isLast ? 0 : 2 * k + 3;
    mesh.triangles.push_back({ 2 * k, low, high });
    mesh.triangles.push_back({ 2 * k, high, 2 * k + 1 });
  }
  return mesh;
}

MultiVector MeanCurvatures(const TriangleMesh& mesh, CurvatureReport& report)
{
  const PrincipalCurvatures found = CurvaturesOfSurface(mesh, true, nullptr, {}, report);
  MultiVector mean(static_cast<Id>(found.minimum.size()), 1);
  for (Id point = 0; point < mean.rows(); ++point)
  {
    mean(point, 0) = 0.5 * (found.minimum[point] + found.maximum[point]);
  }
  return mean;
}

} // namespace

TEST(OrientedMesh, OneThatFacesAlikeStaysEvenInward)
{
  TriangleMesh inward = GeodesicSphere(2);
  for (auto& triangle : inward.triangles)
  {
    std::reverse(triangle.begin(), triangle.end());
  }
  for (const TriangleMesh& mesh : { GeodesicSphere(2), inward, Unweld(GeodesicSphere(2)),
         FlatRectangle(5, 7), Torus(20, 10, 1.0, 0.3), Box(3) })
  {
    const OrientedMesh oriented = Orient(mesh, true);
    EXPECT_FALSE(oriented.mesh.has_value());
    EXPECT_EQ(oriented.turned, 0);
  }
}

TEST(OrientedMesh, ClosedOnesFaceOutwardHoweverManyTrianglesAreTurned)
{
  for (const TriangleMesh& mesh :
    { GeodesicSphere(3), Torus(30, 16, 1.0, 0.3), Box(4), Join(GeodesicSphere(2), Box(3)) })
  {
    for (const double part : { 0.1, 0.5, 0.9 })
    {
      for (const bool isSoup : { false, true })
      {
        const TriangleMesh mixed = TurnSome(mesh, part, 5);
        const OrientedMesh oriented = Orient(isSoup ? Unweld(mixed) : mixed, true);
        ASSERT_TRUE(oriented.mesh.has_value());
        EXPECT_EQ(oriented.copies, 0);
        EXPECT_EQ(oriented.oneSided, 0);
        EXPECT_NEAR(VolumeOf(*oriented.mesh), VolumeOf(mesh), 1e-12);
        EXPECT_NEAR(double(oriented.turned), part * double(mesh.triangles.size()),
          0.1 * double(mesh.triangles.size()) + 20);
      }
    }
  }
}

TEST(OrientedMesh, OpenOnesFaceAsMostOfTheirArea)
{
  const TriangleMesh plate = FlatRectangle(12, 9);
  const OrientedMesh oriented = Orient(TurnSome(plate, 0.3, 2), true);
  ASSERT_TRUE(oriented.mesh.has_value());
  for (const auto& [a, b, c] : oriented.mesh->triangles)
  {
    const std::vector<Vec3>& p = oriented.mesh->points;
    EXPECT_GT((p[b] - p[a]).cross(p[c] - p[a])[2], 0.0);
  }
}

TEST(OrientedMesh, CopiesAreLeftOutWhicheverWayRound)
{
  const TriangleMesh sphere = GeodesicSphere(2);
  for (const bool turned : { false, true })
  {
    for (const bool isSoup : { false, true })
    {
      const TriangleMesh twice = Double(sphere, turned);
      const OrientedMesh oriented = Orient(isSoup ? Unweld(twice) : twice, true);
      ASSERT_TRUE(oriented.mesh.has_value());
      EXPECT_EQ(oriented.copies, static_cast<Id>(sphere.triangles.size()));
      EXPECT_EQ(oriented.turned, 0);
      EXPECT_NEAR(VolumeOf(*oriented.mesh), VolumeOf(sphere), 1e-12);
    }
  }
}

TEST(OrientedMesh, AMoebiusStripIsOneSided)
{
  const OrientedMesh oriented = Orient(Moebius(24), true);
  EXPECT_EQ(oriented.oneSided, 1);
  CurvatureReport report;
  EXPECT_TRUE(MeanCurvatures(Moebius(24), report).allFinite());
  EXPECT_EQ(report.oneSided, 1);
}

TEST(OrientedMesh, CurvaturesDoNotDependOnTheWayRoundOrOnCopies)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(3), Torus(40, 20, 1.0, 0.4) })
  {
    CurvatureReport report;
    const MultiVector expected = MeanCurvatures(mesh, report);
    EXPECT_EQ(report.turned, 0);
    for (const TriangleMesh& bad : { TurnSome(mesh, 0.4, 1), TurnSome(mesh, 0.7, 3),
           Double(mesh, false), Double(mesh, true), TurnSome(Double(mesh, true), 0.4, 4) })
    {
      const MultiVector found = MeanCurvatures(bad, report);
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-10);
    }
  }
}

TEST(OrientedMesh, PointsOfCopiesHaveTheCurvaturesAtTheirPlaces)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(3), Torus(40, 20, 1.0, 0.4) })
  {
    CurvatureReport report;
    const MultiVector expected = MeanCurvatures(mesh, report);
    const TriangleMesh twice = Join(mesh, TurnSome(mesh, 0.4, 2));
    const MultiVector found = MeanCurvatures(twice, report);
    ASSERT_EQ(found.rows(), 2 * expected.rows());
    const MultiVector error = found - expected.replicate(2, 1);
    EXPECT_LT(error.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-10);
  }
}
