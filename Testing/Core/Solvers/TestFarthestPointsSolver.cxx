// Points that are spread evenly, and the cost of more or fewer points.
#include "Solvers/FarthestPointsSolver.h"

#include "AtDepth.h"
#include "Base/Errors.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Cell = 2.0 / 16; // of the sphere at the depth below

const auto Sphere = std::make_shared<const TriangleMesh>(GeodesicSphere(16));

const SurfaceOptions AtDepth4 = AtDepth<FarthestPointsSolver>(4);

FarthestPointsSolver::Options Points(int number, int first = -1)
{
  FarthestPointsSolver::Options options;
  options.numberOfPoints = number;
  options.firstPointId = first;
  return options;
}

double Angle(Id a, Id b)
{
  return std::acos(std::clamp(Sphere->points[a].dot(Sphere->points[b]), -1.0, 1.0));
}

} // namespace

/// The second point is opposite to the first. The third is on the equator between them, and the
/// fourth opposite to the third. Errors of distances are some of a cell.
TEST(FarthestPointsSolver, OnASphere)
{
  const FarthestPointsSolver::Result result =
    FarthestPointsSolver::Solve(Sphere, Points(4, 20), AtDepth4);
  ASSERT_EQ(result.points.size(), 4u);
  EXPECT_EQ(result.points[0], 20);
  EXPECT_NEAR(Angle(result.points[0], result.points[1]), Pi, 3 * Cell);
  EXPECT_NEAR(Angle(result.points[0], result.points[2]), Pi / 2, 3 * Cell);
  EXPECT_NEAR(Angle(result.points[2], result.points[3]), Pi, 3 * Cell);
}

/// Points are no nearer to each other than the radius, and the distance is the distance to the
/// nearest point.
TEST(FarthestPointsSolver, PointsAreApartByTheRadius)
{
  const FarthestPointsSolver::Result result =
    FarthestPointsSolver::Solve(Sphere, Points(20), AtDepth4);
  for (const Id a : result.points)
  {
    EXPECT_EQ(result.atPoints(a, 0), 0.0);
    EXPECT_EQ(result.nearest[a], a);
    for (const Id b : result.points)
    {
      EXPECT_TRUE(a == b || Angle(a, b) > result.radius - 2 * Cell);
    }
  }
  for (Id point = 0; point < result.atPoints.rows(); ++point)
  {
    const auto& points = result.points;
    EXPECT_EQ(std::count(points.begin(), points.end(), result.nearest[point]), 1);
    EXPECT_NEAR(result.atPoints(point, 0), Angle(point, result.nearest[point]), 2 * Cell);
    EXPECT_LE(result.atPoints(point, 0), result.radius);
  }
}

/// The report is that of the worst distance, also after points that go on from others.
TEST(FarthestPointsSolver, ReportsADistanceThatHasNotConverged)
{
  FarthestPointsSolver::Options options = Points(3);
  EXPECT_TRUE(FarthestPointsSolver::Solve(Sphere, options, AtDepth4).report.converged);
  options.equation.solve.maximumIterations = 1;
  const FarthestPointsSolver::Result result =
    FarthestPointsSolver::Solve(Sphere, options, AtDepth4);
  EXPECT_FALSE(result.report.converged);
  EXPECT_FALSE(result.warnings.empty());
}

TEST(FarthestPointsSolver, MoreAndFewerPointsAreThoseOfOneShot)
{
  Stages stages;
  LocalSurface surface(stages, Sphere, AtDepth4);
  FarthestPointsSolver solver;
  const auto solves = [&](const FarthestPointsSolver::Options& options)
  {
    const auto before = stages.Runs(SolveStage);
    const FarthestPointsSolver::Result& result = solver.Update(surface, options);
    const FarthestPointsSolver::Result once =
      FarthestPointsSolver::Solve(Sphere, options, AtDepth4);
    EXPECT_EQ(result.points, once.points);
    EXPECT_EQ(result.atPoints, once.atPoints);
    EXPECT_EQ(result.nearest, once.nearest);
    return stages.Runs(SolveStage) - before;
  };
  EXPECT_EQ(solves(Points(3)), 1);
  EXPECT_EQ(solves(Points(3)), 0);
  const std::vector<Id> three = solver.GetResult().points;
  EXPECT_EQ(solves(Points(5)), 1);
  EXPECT_TRUE(std::equal(three.begin(), three.end(), solver.GetResult().points.begin()));
  EXPECT_EQ(solves(Points(2)), 1);
  EXPECT_EQ(solves(Points(2)), 0);
  EXPECT_EQ(solves(Points(2, 9)), 1);
  EXPECT_EQ(stages.Runs(HierarchyStage), 1);
}

/// After an abort only the missing points are found, with fewer reports of progress.
TEST(FarthestPointsSolver, GoesOnAfterAnAbort)
{
  Stages stages;
  LocalSurface surface(stages, Sphere, AtDepth4);
  FarthestPointsSolver solver;
  const Progress abort([](double fraction) { return fraction < 0.8; });
  EXPECT_THROW(solver.Update(surface, Points(10), { 0, abort }), Aborted);
  const std::vector<Id> found = solver.GetResult().points;
  EXPECT_GT(found.size(), 5u);
  int reports = 0;
  const Progress count(
    [&](double /*fraction*/)
    {
      ++reports;
      return true;
    });
  const std::vector<Id> all = solver.Update(surface, Points(10), { 0, count }).points;
  EXPECT_TRUE(std::equal(found.begin(), found.end(), all.begin()));
  const int afterAbort = reports;
  reports = 0;
  EXPECT_EQ(solver.Update(surface, Points(10, 0), { 0, count }).points.size(), 10u); // all anew
  EXPECT_LT(afterAbort, reports);
}

/// Each component gets a point before any gets a second one. There are no more found
/// points than points of the mesh.
TEST(FarthestPointsSolver, ComponentsAndTheLastPoint)
{
  const TriangleMesh sphere = GeodesicSphere(1);
  const auto mesh = std::make_shared<const TriangleMesh>(
    Join(sphere, Transform(sphere, { 0, 0, 1 }, 0.0, 1.0, { 4, 0, 0 })));
  const auto half = static_cast<Id>(sphere.points.size());
  const FarthestPointsSolver::Result two = FarthestPointsSolver::Solve(mesh, Points(2), AtDepth4);
  EXPECT_TRUE(two.atPoints.allFinite());
  EXPECT_NE(two.points[0] < half, two.points[1] < half);
  FarthestPointsSolver::Result all = FarthestPointsSolver::Solve(mesh, Points(100), AtDepth4);
  std::sort(all.points.begin(), all.points.end());
  EXPECT_EQ(all.points.size(), mesh->points.size());
  EXPECT_TRUE(std::adjacent_find(all.points.begin(), all.points.end()) == all.points.end());
  EXPECT_EQ(all.radius, 0.0);
}

/// With fewer points than components there is no distance on some of them. A warning tells their
/// share. Further points continue from there.
TEST(FarthestPointsSolver, ComponentsWithoutAPointHaveNoDistance)
{
  const TriangleMesh sphere = GeodesicSphere(2);
  TriangleMesh three = Join(sphere, Transform(sphere, { 0, 0, 1 }, 0.0, 1.0, { 4, 0, 0 }));
  three = Join(three, Transform(sphere, { 0, 0, 1 }, 0.0, 0.5, { 0, 4, 0 }));
  const auto mesh = std::make_shared<const TriangleMesh>(three);
  const auto part = static_cast<Id>(sphere.points.size());
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth4);
  FarthestPointsSolver solver;
  for (const int number : { 1, 2, 3, 4, 1 })
  {
    const FarthestPointsSolver::Result& result = solver.Update(surface, Points(number));
    const auto isUnknown = result.atPoints.array().isNaN();
    EXPECT_EQ(isUnknown.count(), std::max(3 - number, 0) * part);
    EXPECT_EQ((result.atPoints.array().isFinite()).count(), std::min(number, 3) * part);
    EXPECT_TRUE(std::isfinite(result.radius));
    EXPECT_GT(result.radius, 0.5);
    for (Id point = 0; point < result.atPoints.rows(); ++point)
    {
      EXPECT_EQ(result.nearest[point] == -1, isUnknown(point, 0)) << number << " " << point;
    }
    ASSERT_EQ(result.warnings.size(), number < 3 ? 1u : 0u);
    if (number < 3)
    {
      EXPECT_EQ(result.warnings[0].find(number == 1 ? "66.7 %" : "33.3 %"), 0u)
        << result.warnings[0];
    }
  }
}

TEST(FarthestPointsSolver, RefusesAFirstPointThatIsNone)
{
  const int beyond = static_cast<int>(Sphere->points.size());
  EXPECT_THROW(FarthestPointsSolver::Solve(Sphere, Points(2, beyond), AtDepth4), InvalidInput);
}
