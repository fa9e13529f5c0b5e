// Mean-curvature flow: exact solutions, quantities that never grow, and the end of flows that
// cannot go on.
#include "Largest.h"
#include "Shape/MeanCurvatureFlow.h"

#include "Base/Errors.h"
#include "PointAreas.h"
#include "Shape/MovedSurface.h"
#include "Spaces.h"
#include "Spaces/HatSpace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// The side of the cylinder x² + y² = 1, |z| < halfHeight.
TriangleMesh OpenCylinder(int around, int along, double halfHeight)
{
  TriangleMesh mesh = FlatRectangle(around, along, 2.0 * M_PI, 2.0 * halfHeight);
  for (Vec3& p : mesh.points)
  {
    p = Vec3(std::cos(p[0]), std::sin(p[0]), p[1] - halfHeight);
  }
  const auto column = static_cast<Id>(around) + 1; // the last column is the first
  for (auto& triangle : mesh.triangles)
  {
    for (Id& point : triangle)
    {
      point -= point % column == around ? around : 0;
    }
  }
  return mesh;
}

/// A flow on a mesh, with times in squared world units.
class FlowOnMesh
{
public:
  FlowOnMesh(const TriangleMesh& surface, bool isOnHats, int depth, int threads = 0)
    : mesh(std::make_shared<const TriangleMesh>(surface))
  {
    grid_.functions.depth = depth;
    grid_.functions.threads = threads;
    isOnHats_ = isOnHats;
    space = this->Build(surface);
    options.multigrid.threads = threads;
    options.solve.tolerance = 1e-8;
    this->SetTimeStep(0.01);
  }

  void SetTimeStep(double world) { options.timeStep = world / std::pow(space->UnitLength(), 2); }

  /// Sets the time step relative to the area.
  void SetRelativeTimeStep(double share) { this->SetTimeStep(share * SurfaceArea(*mesh)); }

  void ClipAgain()
  {
    options.rebuild = [this](const TriangleMesh& moved, const Job&) { return this->Build(moved); };
  }

  MeanCurvatureFlow Make() const { return { space, mesh, options }; }

  /// The area of the surface with this shape, as the space sees it.
  double AreaAt(const MultiVector& shape) const
  {
    const std::unique_ptr<FiniteElementSpace> copy = space->Copy();
    copy->SetMetric(shape);
    double area = 0.0;
    for (const double integral : copy->Integrals())
    {
      area += integral;
    }
    return area;
  }

  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const FiniteElementSpace> space;
  FlowOptions options;

private:
  std::unique_ptr<FiniteElementSpace> Build(const TriangleMesh& surface) const
  {
    if (isOnHats_)
    {
      return std::make_unique<HatSpace>(BuildHatSpace(surface, grid_));
    }
    return std::make_unique<GridSpace>(BuildGridSpace(surface, grid_));
  }

  GridSpaceOptions grid_;
  bool isOnHats_ = false;
};

double MeanSquareRadius(const std::vector<Vec3>& points)
{
  double sum = 0.0;
  for (const Vec3& point : points)
  {
    sum += point.squaredNorm();
  }
  return sum / double(points.size());
}

bool AllFinite(const std::vector<Vec3>& points)
{
  return std::all_of(
    points.begin(), points.end(), [](const Vec3& point) { return point.allFinite(); });
}

class MeanCurvatureFlows : public ::testing::TestWithParam<bool>
{
};

} // namespace

TEST_P(MeanCurvatureFlows, ASphereShrinksByItsLaw)
{
  FlowOnMesh on(GeodesicSphere(16), GetParam(), 4);
  const double end = 0.1;
  std::vector<double> errors;
  for (const int steps : { 5, 10, 20 })
  {
    on.SetTimeStep(end / steps);
    MeanCurvatureFlow flow = on.Make();
    for (int k = 0; k < steps; ++k)
    {
      const FlowStep step = flow.Advance({});
      ASSERT_EQ(step.end, FlowEnd::None);
      EXPECT_TRUE(step.converged);
      EXPECT_EQ(step.lockedSamples, 0);
      EXPECT_GT(step.sphericity, 0.99);
    }
    errors.push_back(MeanSquareRadius(flow.Points()) - (1.0 - 4.0 * end));
  }
  // First order in time. The differences are free of the error in space.
  EXPECT_LT(std::abs(errors[2]), 0.02);
  EXPECT_NEAR((errors[0] - errors[1]) / (errors[1] - errors[2]), 2.0, 0.25);
}

TEST_P(MeanCurvatureFlows, TheAreaNeverGrows)
{
  FlowOnMesh on(Transform(Torus(30, 12, 1.0, 0.3), { 1, 2, 0 }, 0.4), GetParam(), 4);
  on.options.solve.tolerance = 1e-10;
  for (const double share : { 1e-6, 1e-4, 1e-2, 1.0 })
  {
    on.SetRelativeTimeStep(share);
    MeanCurvatureFlow flow = on.Make();
    double area = on.AreaAt(on.space->EmbeddingOfMesh());
    for (int k = 0; k < 4 && flow.Advance({}).end == FlowEnd::None; ++k)
    {
      const double now = on.AreaAt(flow.Shape());
      EXPECT_LT(now, area * (1.0 + 1e-9)) << share << " " << k;
      area = now;
    }
  }
}

TEST_P(MeanCurvatureFlows, TheTrackedMetricIsTheStaticOneAtTheStart)
{
  FlowOnMesh on(Torus(30, 12, 1.0, 0.3), GetParam(), 4);
  on.options.solve.tolerance = 1e-10;
  MeanCurvatureFlow fromMesh = on.Make();
  MeanCurvatureFlow fromEmbedding = on.Make();
  fromEmbedding.GoTo(1, on.space->EmbeddingOfMesh());
  fromMesh.Advance({});
  fromEmbedding.Advance({});
  EXPECT_LT(RelativeDifference(fromEmbedding.Shape(), fromMesh.Shape()), 1e-8);
}

TEST_P(MeanCurvatureFlows, TrackingIsNearClippingAgain)
{
  // The mesh is finer than the grid. Edges that a grid resolves flow faster than faces.
  FlowOnMesh on(Transform(Torus(60, 24, 1.0, 0.4), { 1, 2, 0 }, 0.4), GetParam(), 4);
  on.SetTimeStep(0.005);
  MeanCurvatureFlow tracked = on.Make();
  on.ClipAgain();
  MeanCurvatureFlow clipped = on.Make();
  for (int k = 0; k < 5; ++k)
  {
    const FlowStep one = tracked.Advance({});
    const FlowStep other = clipped.Advance({});
    ASSERT_EQ(other.end, FlowEnd::None);
    EXPECT_NEAR(one.area, other.area, 0.02 * one.area);
  }
  const std::vector<Vec3> a = tracked.Points();
  const std::vector<Vec3> b = clipped.Points();
  double largest = 0.0;
  double moved = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    largest = Larger(largest, (a[k] - b[k]).norm());
    moved = Larger(moved, (a[k] - on.mesh->points[k]).norm());
  }
  EXPECT_GT(moved, 0.05);
  EXPECT_LT(largest, 0.12 * moved);
}

TEST(MeanCurvatureFlow, SaysHowFarAStepIsOff)
{
  const TriangleMesh torus = Transform(Torus(60, 24, 1.0, 0.4), { 1, 2, 0 }, 0.4);
  const TriangleMesh box = Transform(Box(12), { 1, 2, 1 }, 0.4);
  const auto wayOf = [](const TriangleMesh& mesh, int depth, double share)
  {
    FlowOnMesh on(mesh, false, depth);
    on.SetRelativeTimeStep(share);
    MeanCurvatureFlow flow = on.Make();
    const FlowStep step = flow.Advance({});
    MultiVector way(static_cast<Id>(mesh.points.size()), 3);
    const std::vector<Vec3> points = flow.Points();
    for (Id i = 0; i < way.rows(); ++i)
    {
      way.row(i) = (points[i] - mesh.points[i]).transpose();
    }
    return std::make_pair(way, step.accuracy);
  };
  for (const TriangleMesh& mesh : { torus, box })
  {
    const Eigen::VectorXd area = AreasOfPoints(mesh);
    const auto norm = [&](const MultiVector& u)
    { return std::sqrt(area.dot(u.rowwise().squaredNorm())); };
    for (const double share : { 1e-4, 1e-3, 1e-2 })
    {
      SCOPED_TRACE(share);
      const auto [truth, unused] = wayOf(mesh, 6, share);
      const auto [way, accuracy] = wayOf(mesh, 4, share);
      const double error = norm(way - truth) / norm(truth);
      EXPECT_GT(accuracy.discretization, error / 4.0);
      EXPECT_LT(accuracy.discretization, error * 4.0);
      EXPECT_GT(accuracy.largest, (way - truth).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() / 4.0);
      EXPECT_TRUE(std::isnan(accuracy.algebraic));
    }
  }
}

TEST_P(MeanCurvatureFlows, TheConformalisedFlowEndsRound)
{
  TriangleMesh ellipsoid = GeodesicSphere(12);
  for (Vec3& point : ellipsoid.points)
  {
    point = point.cwiseProduct(Vec3(0.8, 1.0, 2.5));
  }
  FlowOnMesh on(Transform(ellipsoid, { 1, 1, 0 }, 0.3), GetParam(), 4);
  on.options.conformalized = true;
  on.options.rescaling = Rescaling::ConstantArea;
  on.SetRelativeTimeStep(0.01);
  MeanCurvatureFlow flow = on.Make();
  const double area = SurfaceArea(*on.mesh);
  double sphericity = flow.Start().sphericity;
  EXPECT_LT(sphericity, 0.86);
  for (int k = 0; k < 20; ++k)
  {
    const FlowStep step = flow.Advance({});
    ASSERT_EQ(step.end, FlowEnd::None);
    EXPECT_NEAR(step.area, area, 1e-9 * area);
    // The first steps of this size make it thinner, because the lowest frequency is along its axis.
    EXPECT_TRUE(k < 3 || step.sphericity > sphericity - 1e-4) << k;
    sphericity = step.sphericity;
  }
  EXPECT_GT(sphericity, 0.99);
  const MapDistortion map = DistortionOf(*on.mesh, flow.Points());
  EXPECT_LT(MeanOverSurface(*on.mesh, map.stretchRatio), 1.25);
}

TEST_P(MeanCurvatureFlows, WhatIsToBeKeptIsKept)
{
  FlowOnMesh on(Torus(30, 12, 1.0, 0.4), GetParam(), 4);
  on.SetTimeStep(0.01);
  for (const Rescaling rescaling : { Rescaling::ConstantArea, Rescaling::ConstantVolume })
  {
    on.options.rescaling = rescaling;
    MeanCurvatureFlow flow = on.Make();
    const FlowStep start = flow.Start();
    for (int k = 0; k < 3; ++k)
    {
      const FlowStep step = flow.Advance({});
      const bool isArea = rescaling == Rescaling::ConstantArea;
      EXPECT_NEAR(
        (isArea ? step.area : step.volume) / (isArea ? start.area : start.volume), 1.0, 1e-9);
    }
    EXPECT_LT(SizeOf(flow.Points(), on.mesh->triangles).centroid.norm(), 1e-3);
  }
}

/// The volume is that of the surface, however its triangles face. On the grid, the clip cuts pieces
/// otherwise, and integrals have another error.
TEST_P(MeanCurvatureFlows, VolumesDoNotDependOnTheOrientationOfTriangles)
{
  const TriangleMesh torus = Torus(30, 12, 1.0, 0.4);
  const auto twoSteps = [this](const TriangleMesh& mesh)
  {
    FlowOnMesh on(mesh, GetParam(), 4);
    on.SetTimeStep(0.01);
    on.options.rescaling = Rescaling::ConstantVolume;
    MeanCurvatureFlow flow = on.Make();
    flow.Advance({});
    return std::make_pair(flow.Advance({}), flow.Points());
  };
  const double tolerance = GetParam() ? 1e-7 : 3e-4; // hats or grid
  const auto [step, points] = twoSteps(torus);
  EXPECT_NEAR(step.volume / SizeOf(torus.points, torus.triangles).volume, 1.0, 1e-9);
  for (const TriangleMesh& mixed : { TurnSome(torus, 0.3, 1), TurnSome(torus, 0.7, 2) })
  {
    const auto [ofMixed, mixedPoints] = twoSteps(mixed);
    EXPECT_NEAR(ofMixed.volume, step.volume, 1e-7);
    EXPECT_NEAR(ofMixed.sphericity, step.sphericity, tolerance);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      ASSERT_LT((mixedPoints[k] - points[k]).norm(), tolerance) << k;
    }
  }
}

TEST_P(MeanCurvatureFlows, AVanishingSphereEndsTheFlowAndKeepsTheLastStep)
{
  FlowOnMesh on(GeodesicSphere(8), GetParam(), 4);
  on.SetTimeStep(0.2);
  MeanCurvatureFlow flow = on.Make();
  FlowStep step;
  int made = 0;
  while (made < 50 && (step = flow.Advance({})).end == FlowEnd::None)
  {
    ++made;
  }
  EXPECT_NE(step.end, FlowEnd::None);
  EXPECT_EQ(flow.Step(), made);
  EXPECT_GT(made, 1);
  EXPECT_TRUE(AllFinite(flow.Points()));
}

TEST_P(MeanCurvatureFlows, AnAbortedStepLeavesTheFlowWhereItIs)
{
  FlowOnMesh on(Torus(30, 12, 1.0, 0.3), GetParam(), 4);
  for (const bool conformalized : { false, true })
  {
    on.options.conformalized = conformalized;
    MeanCurvatureFlow undisturbed = on.Make();
    MeanCurvatureFlow flow = on.Make();
    undisturbed.Advance({});
    flow.Advance({});
    const MultiVector shape = flow.Shape();
    for (const int calls : { 0, 1, 3, 6 })
    {
      int left = calls;
      const Job job(0, Progress([&left](double) { return left-- > 0; }));
      EXPECT_THROW(flow.Advance(job), Aborted);
      EXPECT_EQ(flow.Step(), 1);
      EXPECT_EQ(flow.Shape(), shape);
    }
    undisturbed.Advance({});
    flow.Advance({});
    EXPECT_EQ(flow.Shape(), undisturbed.Shape());
  }
}

/// Triangles that have become flat give their points no function in the next clip.
TEST_P(MeanCurvatureFlows, APointThatLosesItsFunctionsStaysWhereItIs)
{
  static constexpr Id Lost = 100;
  FlowOnMesh on(Torus(30, 12, 1.0, 0.3), GetParam(), 4);
  on.ClipAgain();
  const auto rebuild = on.options.rebuild;
  on.options.rebuild = [&rebuild](TriangleMesh moved, const Job& job)
  {
    auto& triangles = moved.triangles;
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                      [](const auto& corners)
                      { return std::find(corners.begin(), corners.end(), Lost) != corners.end(); }),
      triangles.end());
    return rebuild(moved, job);
  };
  MeanCurvatureFlow flow = on.Make();
  flow.Advance({});
  const std::vector<Vec3> first = flow.Points();
  ASSERT_EQ(flow.Advance({}).end, FlowEnd::None);
  EXPECT_LT((flow.Points()[Lost] - first[Lost]).norm(), 1e-12);
  EXPECT_GT((flow.Points()[0] - first[0]).norm(), 1e-4);
}

TEST_P(MeanCurvatureFlows, BackAndForthAndThreadsGiveTheSameBits)
{
  const TriangleMesh mesh = Transform(Torus(30, 12, 1.0, 0.3), { 1, 2, 0 }, 0.4);
  for (const bool conformalized : { false, true })
  {
    std::vector<MultiVector> shapes;
    for (const int threads : { 1, 2 })
    {
      FlowOnMesh on(mesh, GetParam(), 4, threads);
      on.options.conformalized = conformalized;
      MeanCurvatureFlow flow = on.Make();
      for (int k = 0; k < 4; ++k)
      {
        flow.Advance(threads);
        if (threads == 1)
        {
          shapes.push_back(flow.Shape());
        }
        EXPECT_EQ(flow.Shape(), shapes[k]);
      }
      flow.GoTo(2, shapes[1]);
      flow.Advance(threads);
      EXPECT_EQ(flow.Shape(), shapes[2]);
      flow.GoToStart();
      flow.Advance(threads);
      EXPECT_EQ(flow.Shape(), shapes[0]);
      flow.Advance(threads);
      EXPECT_EQ(flow.Shape(), shapes[1]);
    }
  }
}

namespace
{

/// Flows on both kinds of functions, with the file of a real mesh.
class FlowsOfRealMesh : public ::testing::TestWithParam<std::tuple<bool, std::string>>
{
};

} // namespace

TEST_P(FlowsOfRealMesh, StayFinite)
{
  const auto [isOnHats, name] = GetParam();
  const std::string path = RealMesh(name);
  if (path.empty())
  {
    GTEST_SKIP() << "no real mesh " << name;
  }
  FlowOnMesh on(ReadMesh(path), isOnHats, 6);
  on.options.solve.tolerance = 5e-4;
  for (const double share : { 1e-5, 5e-4 })
  {
    on.SetRelativeTimeStep(share);
    MeanCurvatureFlow flow = on.Make();
    double area = flow.Start().area;
    for (int k = 0; k < 5; ++k)
    {
      const FlowStep step = flow.Advance({});
      ASSERT_EQ(step.end, FlowEnd::None);
      EXPECT_TRUE(step.converged || isOnHats); // slivers of moved hats may take long
      EXPECT_LT(step.area, area * (1.0 + 1e-3));
      area = step.area;
    }
    EXPECT_TRUE(AllFinite(flow.Points()));
  }
}

INSTANTIATE_TEST_SUITE_P(Files, FlowsOfRealMesh,
  ::testing::Combine(::testing::Bool(),
    ::testing::Values("rocker_arm.ply", "stanford_bunny.ply", "neptune_30k.ply")));

TEST_P(MeanCurvatureFlows, ASoupOfOpenPiecesStaysFinite)
{
  const TriangleMesh soup =
    Join(Unweld(Transform(GeodesicSphere(6), { 1, 0, 1 }, 0.3)), FlatRectangle(6, 4));
  FlowOnMesh on(soup, GetParam(), 4);
  for (const bool conformalized : { false, true })
  {
    on.options.conformalized = conformalized;
    on.options.rescaling = conformalized ? Rescaling::ConstantArea : Rescaling::None;
    MeanCurvatureFlow flow = on.Make();
    for (int k = 0; k < 30 && flow.Advance({}).end == FlowEnd::None; ++k)
    {
      ASSERT_TRUE(AllFinite(flow.Points()));
    }
    const MapDistortion map = DistortionOf(soup, flow.Points());
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    {
      ASSERT_TRUE(std::isfinite(map.areaRatio[t]) && map.stretchRatio[t] >= 1.0);
    }
  }
}

/// The soap film between two circles is a catenoid.
TEST_P(MeanCurvatureFlows, AFixedBoundaryHoldsACatenoid)
{
  constexpr double HalfHeight = 0.5;
  // Neck solves Neck cosh(HalfHeight / Neck) = 1, the radius of the circles.
  constexpr double Neck = 0.848338;
  const double area =
    2.0 * M_PI * Neck * (HalfHeight + 0.5 * Neck * std::sinh(2.0 * HalfHeight / Neck));
  FlowOnMesh on(Transform(OpenCylinder(64, 24, HalfHeight), { 0, 1, 0 }, 0.3), GetParam(), 4);
  on.SetTimeStep(0.1);
  on.options.solve.tolerance = 1e-5;
  on.options.fixed = BoundaryOf(*on.mesh, true);
  ASSERT_EQ(on.options.fixed.points.size(), 128u);
  MeanCurvatureFlow flow = on.Make();
  double before = flow.Start().area;
  for (int step = 0; step < 12; ++step)
  {
    const FlowStep done = flow.Advance({});
    ASSERT_EQ(done.end, FlowEnd::None);
    EXPECT_TRUE(done.converged);
    EXPECT_LE(done.area, before * (1.0 + 1e-6));
    before = done.area;
  }
  EXPECT_NEAR(before, area, 4e-3 * area); // area of the cylinder: 2 π, 5 % more
  const std::vector<Vec3> points = flow.Points();
  for (const Id point : on.options.fixed.points)
  {
    EXPECT_EQ(points[point], on.mesh->points[point]);
  }
  const std::vector<char> isUsed = UsedPoints(*on.mesh);
  const std::vector<Vec3> upright = Transform({ points, {} }, { 0, 1, 0 }, -0.3).points;
  for (std::size_t k = 0; k < upright.size(); ++k)
  {
    const double radius = std::hypot(upright[k][0], upright[k][1]);
    EXPECT_TRUE(!isUsed[k] || std::abs(radius - Neck * std::cosh(upright[k][2] / Neck)) < 0.01);
  }
}

TEST_P(MeanCurvatureFlows, AFlatSurfaceWithAFixedBoundaryStays)
{
  FlowOnMesh on(Transform(FlatRectangle(32, 24, 2.0, 1.5), { 1, 0.4, 0 }, 0.5), GetParam(), 4);
  on.SetTimeStep(0.05);
  on.options.solve.tolerance = 1e-5;
  on.options.fixed = BoundaryOf(*on.mesh, true);
  MeanCurvatureFlow flow = on.Make();
  for (int step = 0; step < 3; ++step)
  {
    ASSERT_EQ(flow.Advance({}).end, FlowEnd::None);
  }
  const std::vector<Vec3> points = flow.Points();
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    EXPECT_LT((points[k] - on.mesh->points[k]).norm(), 1e-5);
  }
}

/// A flat square shrinks in its plane as it does when it is turned, however it lies in the grid.
TEST_P(MeanCurvatureFlows, AFlatSurfaceInAPlaneOfTheGridFlowsAsATurnedOne)
{
  const TriangleMesh flat = FlatRectangle(20, 20);
  const auto areaAfter = [&](const Vec3& axis, double angle)
  {
    FlowOnMesh surface(Transform(flat, axis, angle), GetParam(), 5);
    surface.options.solve.tolerance = FlowOptions().solve.tolerance;
    surface.SetTimeStep(1e-3);
    MeanCurvatureFlow flow = surface.Make();
    FlowStep step;
    for (int k = 0; k < 3; ++k)
    {
      step = flow.Advance({});
      EXPECT_EQ(step.end, FlowEnd::None);
      EXPECT_TRUE(step.converged);
      EXPECT_LE(step.iterations, 8);
    }
    const Vec3 normal = Eigen::AngleAxisd(angle, axis.normalized()) * Vec3::UnitZ();
    double off = 0.0;
    for (const Vec3& point : flow.Points())
    {
      off = Larger(off, std::abs(normal.dot(point)));
    }
    EXPECT_LT(off, 1e-4); // a fifth of the tolerance
    return step.area;
  };
  const double turned = areaAfter({ 1, 2, 3 }, 0.7);
  EXPECT_LT(turned, 0.99);
  const double half = 0.5 * std::acos(-1.0);
  for (const Vec3& axis : { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1) })
  {
    EXPECT_NEAR(areaAfter(axis, half), turned, 0.005);
    EXPECT_NEAR(areaAfter(axis, 0.0), turned, 0.005);
  }
}

/// A dented plane becomes flatter within its boundary. A sphere next to it shrinks as if alone.
TEST_P(MeanCurvatureFlows, WhatIsHeldIsAComponentsOwnMatter)
{
  TriangleMesh dented = FlatRectangle(24, 24);
  for (Vec3& p : dented.points)
  {
    p[2] = 0.2 * std::sin(M_PI * p[0]) * std::sin(2.0 * M_PI * p[1]);
  }
  const auto first = static_cast<Id>(dented.points.size());
  TriangleMesh sphere = GeodesicSphere(12, 0.3);
  for (Vec3& p : sphere.points)
  {
    p += Vec3(0.5, 0.5, 2.0);
  }
  const TriangleMesh both = Join(dented, sphere);
  FlowOnMesh on(both, GetParam(), 5);
  on.SetTimeStep(5e-3);
  on.options.fixed = BoundaryOf(*on.mesh, true);
  MeanCurvatureFlow flow = on.Make();
  for (int step = 0; step < 3; ++step)
  {
    ASSERT_EQ(flow.Advance({}).end, FlowEnd::None);
  }
  const std::vector<Vec3> points = flow.Points();
  Vec3 center = Vec3::Zero();
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (static_cast<Id>(k) < first)
    {
      EXPECT_LT(std::abs(points[k][2]), 0.6 * 0.2); // of small waves, 1.25^-3 would be left
    }
    else
    {
      center += (points[k] - on.mesh->points[k]) / double(points.size() - first);
    }
  }
  EXPECT_LT(center.norm(), 1e-3); // the sphere shrinks in place
  double radius = 0.3;
  for (int step = 0; step < 3; ++step)
  {
    radius /= 1.0 + 2.0 * 5e-3 / (radius * radius); // effect of a step on a sphere
  }
  EXPECT_NEAR((points.back() - Vec3(0.5, 0.5, 2.0)).norm(), radius, 0.01 * radius);
}

INSTANTIATE_TEST_SUITE_P(Kinds, MeanCurvatureFlows, ::testing::Values(false, true),
  [](const auto& kind) { return std::string(kind.param ? "hats" : "grid"); });

TEST(MeanCurvatureFlow, RefusesWhatMakesNoSense)
{
  FlowOnMesh on(FlatRectangle(6, 6), false, 3);
  on.options.rescaling = Rescaling::ConstantVolume;
  EXPECT_THROW(on.Make(), InvalidInput);
  on.options.rescaling = Rescaling::None;
  for (const double step : { 0.0, -1.0, std::nan(""), HUGE_VAL })
  {
    on.options.timeStep = step;
    EXPECT_THROW(on.Make(), InvalidInput);
  }
  on.options.timeStep = 1.0;
  on.options.fixed = BoundaryOf(*on.mesh, true);
  on.options.rescaling = Rescaling::ConstantArea;
  EXPECT_THROW(on.Make(), InvalidInput);
  on.options.rescaling = Rescaling::None;
  on.options.fixed = {};
  on.ClipAgain();
  on.options.conformalized = true;
  EXPECT_THROW(on.Make(), InvalidInput);
}

TEST(MovedSurface, MeasuresAreExactForLinearMaps)
{
  const TriangleMesh sphere = GeodesicSphere(40);
  const SurfaceSize size = SizeOf(sphere.points, sphere.triangles);
  EXPECT_NEAR(size.volume, 4.0 * M_PI / 3.0, 5e-3);
  EXPECT_NEAR(size.Sphericity(), 1.0, 2e-3);
  EXPECT_LE(size.Sphericity(), 1.0);

  const TriangleMesh flat = Transform(FlatRectangle(4, 3), { 1, 2, 3 }, 0.9);
  const Vec3 along = Transform({ { { 1, 0, 0 } }, {} }, { 1, 2, 3 }, 0.9).points[0];
  std::vector<Vec3> stretched = flat.points;
  for (Vec3& point : stretched)
  {
    point += 2.0 * along.dot(point) * along + Vec3(5, 6, 7);
  }
  const MapDistortion map = DistortionOf(flat, stretched);
  for (std::size_t t = 0; t < flat.triangles.size(); ++t)
  {
    EXPECT_NEAR(map.areaRatio[t], 3.0, 1e-12);
    EXPECT_NEAR(map.stretchRatio[t], 3.0, 1e-12);
  }
  for (const double mean : MeansAtPoints(flat, map.stretchRatio, 0.0))
  {
    EXPECT_NEAR(mean, 3.0, 1e-12);
  }
  const MapDistortion collapsed =
    DistortionOf(flat, std::vector<Vec3>(flat.points.size(), Vec3(1, 2, 3)));
  EXPECT_EQ(collapsed.areaRatio[0], 0.0);
  EXPECT_EQ(collapsed.stretchRatio[0], MapDistortion::LargestRatio);
}

TEST(MovedSurface, KnowsItsBoundary)
{
  EXPECT_TRUE(BoundaryOf(GeodesicSphere(4), true).points.empty());
  EXPECT_EQ(BoundaryOf(FlatRectangle(4, 3), true).points.size(), 14u);
  EXPECT_EQ(BoundaryOf(FlatRectangle(4, 3), true).edges.size(), 14u);
  const TriangleMesh soup = Unweld(GeodesicSphere(2));
  EXPECT_TRUE(BoundaryOf(soup, true).points.empty());
  EXPECT_EQ(BoundaryOf(soup, false).points.size(), soup.points.size());
  const TriangleMesh cut = Unweld(FlatRectangle(2, 2));
  const std::vector<Id> points = BoundaryOf(cut, true).points;
  for (std::size_t k = 0; k < cut.points.size(); ++k)
  {
    const bool isInside = cut.points[k] == Vec3(0.5, 0.5, 0);
    EXPECT_EQ(std::count(points.begin(), points.end(), Id(k)), isInside ? 0 : 1);
  }
}

TEST(MovedSurface, KnowsWhatIsLikeASphere)
{
  const TriangleMesh sphere = GeodesicSphere(5);
  EXPECT_TRUE(IsLikeASphere(sphere));
  EXPECT_TRUE(IsLikeASphere(Unweld(sphere)));
  EXPECT_TRUE(IsLikeASphere(Box(3)));
  EXPECT_FALSE(IsLikeASphere(Torus(12, 8, 1.0, 0.3)));
  EXPECT_FALSE(IsLikeASphere(FlatRectangle(3, 3)));
  EXPECT_FALSE(IsLikeASphere(Join(sphere, Transform(sphere, { 0, 0, 1 }, 0.3, 1.0, { 3, 0, 0 }))));
}
