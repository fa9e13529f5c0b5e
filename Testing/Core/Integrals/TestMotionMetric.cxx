// Tests the metric of a mesh with moved points, and the maps of gradients between both meshes.
#include "Integrals/MotionMetric.h"

#include "Base/Errors.h"
#include "Meshes.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Returns a function of the points, which the motion does not change.
Field ValuesOf(const TriangleMesh& mesh)
{
  Field f;
  f.values.resize(static_cast<Id>(mesh.points.size()), 2);
  for (Id k = 0; k < f.values.rows(); ++k)
  {
    f.values(k, 0) = std::sin(3.0 * mesh.points[k][0]) + mesh.points[k][2];
    f.values(k, 1) = mesh.points[k][1] * mesh.points[k][2];
  }
  return f;
}

class MotionMetric : public ::testing::TestWithParam<const char*>
{
protected:
  MotionMetric()
    : mesh(
        Transform(std::string(GetParam()) == "sphere" ? GeodesicSphere(6) : Torus(24, 12, 1.0, 0.3),
          { 1, 2, 3 }, 0.4)),
      moved(Mapped(mesh, Bend))
  {
  }

  TriangleMesh mesh;
  TriangleMesh moved;
};

} // namespace

TEST_P(MotionMetric, HasTheAreaOfTheMovedMesh)
{
  const auto metric = MetricOfMotion(mesh, moved);
  ASSERT_TRUE(metric);
  EXPECT_NEAR(metric->AreaOf(mesh), SurfaceArea(moved), 1e-12 * SurfaceArea(moved));
}

TEST_P(MotionMetric, OfARigidMotionIsThatOfTheMesh)
{
  const auto metric = MetricOfMotion(mesh, Transform(mesh, { 0, 1, 1 }, 1.1, 1.0, { 5, 0, 2 }));
  ASSERT_TRUE(metric);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    EXPECT_NEAR(metric->area[t], 1.0, 1e-12);
    EXPECT_NEAR(metric->tensor[t].trace(), 2.0, 1e-12); // the identity of the plane
    EXPECT_NEAR((metric->tensor[t] * metric->tensor[t] - metric->tensor[t]).norm(), 0.0, 1e-12);
  }
}

/// Compares ∫ |∇u|² on the moved mesh with an integral over the original mesh.
TEST_P(MotionMetric, HasTheEnergyOfTheMovedMesh)
{
  const auto metric = MetricOfMotion(mesh, moved);
  ASSERT_TRUE(metric);
  const Field f = ValuesOf(mesh);
  const Field here = GradientsOf(mesh, f);
  const Field there = GradientsOf(moved, f);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Vec3 before = here.values.row(static_cast<Id>(t)).head<3>();
    const Vec3 after = there.values.row(static_cast<Id>(t)).head<3>();
    EXPECT_NEAR(before.dot(metric->tensor[t] * before), metric->area[t] * after.squaredNorm(),
      1e-11 * (1.0 + after.squaredNorm()));
  }
}

TEST_P(MotionMetric, GradientsGoBack)
{
  const Field f = ValuesOf(mesh);
  const Field here = GradientsOf(mesh, f);
  const Field there = GradientsOf(moved, f);
  EXPECT_LT(
    (PullBack(mesh, moved, there).values - here.values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    1e-11);
  // Vectors at points are mapped to corners.
  Field constant;
  constant.values = MultiVector::Ones(static_cast<Id>(mesh.points.size()), 3);
  const Field back = PullBack(mesh, mesh, constant);
  EXPECT_EQ(back.association, FieldAssociation::Corners);
  EXPECT_LT((back.values.array() - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);
}

TEST_P(MotionMetric, IsNoneWhereATriangleLosesItsAreaOrAPointItsPlace)
{
  const auto corner = mesh.triangles[5];
  for (const Vec3& place : { moved.points[corner[0]], Vec3(std::nan(""), 0, 0) })
  {
    TriangleMesh broken = moved;
    broken.points[corner[1]] = place;
    EXPECT_FALSE(MetricOfMotion(mesh, broken));
    EXPECT_FALSE(MetricOfMotion(broken, moved));
  }
  TriangleMesh other = moved;
  std::swap(other.triangles[0], other.triangles[1]);
  EXPECT_THROW(MetricOfMotion(mesh, other), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Meshes, MotionMetric, ::testing::Values("sphere", "torus"));
