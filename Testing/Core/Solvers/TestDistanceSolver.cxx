// Distances in one shot and in steps, and the stages that a changed option repeats.
#include "Solvers/DistanceSolver.h"

#include "AtDepth.h"
#include "Base/Errors.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

const auto Sphere = std::make_shared<const TriangleMesh>(GeodesicSphere(16));

const SurfaceOptions AtDepth4 = AtDepth<DistanceSolver>(4);

/// 1 where z is above a height, else 0.
GivenField Cap(const std::string& name, double height)
{
  Field field;
  field.values = MultiVector::Zero(static_cast<Id>(Sphere->points.size()), 1);
  for (Id point = 0; point < field.values.rows(); ++point)
  {
    field.values(point, 0) = Sphere->points[point][2] > height ? 1.0 : 0.0;
  }
  return GivenField::Of(name, std::move(field));
}

double AngleBetween(const Vec3& a, const Vec3& b)
{
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

class Stepwise : public ::testing::Test
{
protected:
  /// The stages that run.
  std::string Update()
  {
    std::map<std::string, std::int64_t> before;
    const auto names = { SpaceStage, SystemStage, DistanceSolver::CurveStage, HierarchyStage,
      SolveStage, DistanceSolver::NearestStage };
    for (const std::string name : names)
    {
      before[name] = stages_.Runs(name);
    }
    result = &solver_.Update(surface_, input, options);
    std::string runs;
    for (const std::string name : names)
    {
      runs += stages_.Runs(name) > before[name] ? name + " " : "";
    }
    return runs;
  }

  DistanceSolver::Input input;
  DistanceSolver::Options options;
  const DistanceSolver::Result* result = nullptr;

private:
  Stages stages_;
  LocalSurface surface_{ stages_, Sphere, AtDepth4 };
  DistanceSolver solver_;
};

} // namespace

/// Errors fall with the size of the functions, a sixteenth of the diameter.
TEST(DistanceSolver, TheAngleOnASphere)
{
  DistanceSolver::Input input;
  input.ids = { 7 };
  const DistanceSolver::Result result = DistanceSolver::Solve(Sphere, input, {}, AtDepth4);
  ASSERT_TRUE(result.report.converged);
  for (std::size_t point = 0; point < Sphere->points.size(); ++point)
  {
    EXPECT_NEAR(result.atPoints(static_cast<Id>(point), 0),
      AngleBetween(Sphere->points[7], Sphere->points[point]), 2.0 / 16);
  }
}

TEST_F(Stepwise, OneShotGivesTheSameBits)
{
  input.ids = { 3, 50 };
  options.nearestSource = true;
  this->Update();
  const DistanceSolver::Result once = DistanceSolver::Solve(Sphere, input, options, AtDepth4);
  EXPECT_EQ(once.atPoints, result->atPoints);
  EXPECT_EQ(once.nearest, result->nearest);
  EXPECT_EQ(result->nearest[3], 3);
  EXPECT_EQ(result->nearest[50], 50);
}

TEST_F(Stepwise, AChangeMakesAgainWhatDependsOnIt)
{
  EXPECT_EQ(this->Update(), "Space System Hierarchy Solve NearestSource ");
  EXPECT_EQ(this->Update(), "");
  input.ids = { 9 };
  EXPECT_EQ(this->Update(), "Solve NearestSource ");
  options.equation.solve.tolerance = 1e-6;
  EXPECT_EQ(this->Update(), "Solve NearestSource ");
  options.nearestSource = true;
  EXPECT_EQ(this->Update(), "NearestSource ");
  options.smoothing = 2.0;
  EXPECT_EQ(this->Update(), "Hierarchy Solve NearestSource ");
  options.insideLabel = 2; // of labels that are not there
  EXPECT_EQ(this->Update(), "");
}

TEST_F(Stepwise, SignedDistanceIsNegativeInside)
{
  options.isSigned = true;
  input.labels = Cap("cap", 0.2);
  EXPECT_EQ(this->Update(), "Space System Curve Hierarchy Solve NearestSource ");
  for (std::size_t point = 0; point < Sphere->points.size(); ++point)
  {
    const double height = Sphere->points[point][2];
    const double distance = result->atPoints(static_cast<Id>(point), 0);
    EXPECT_TRUE(height > 0.2 ? distance <= 0.0 : distance >= 0.0) << height << " " << distance;
  }
  options.insideLabel = 0;
  EXPECT_EQ(this->Update(), "Curve Solve NearestSource ");
}

/// A mask, ids and found points are sources together; the first point is one where nothing is
/// given.
TEST_F(Stepwise, SourcesOfAllKinds)
{
  this->Update();
  EXPECT_EQ(result->atPoints(0, 0), 0.0);
  input.ids = { 0 };
  input.mask = Cap("cap", 0.99);
  input.points = { { "a Selection", "The Selection takes no point", [] {
                      return std::vector<Id>{ 5, 5 };
                    } } };
  this->Update();
  for (const Id source : { 0, 5 })
  {
    EXPECT_EQ(result->atPoints(source, 0), 0.0);
  }
  const MultiVector mask = input.mask.read(NaNs::Refused).values;
  for (Id point = 0; point < mask.rows(); ++point)
  {
    EXPECT_TRUE(mask(point, 0) == 0.0 || result->atPoints(point, 0) == 0.0);
  }
}

TEST_F(Stepwise, RefusesWhatIsNoSource)
{
  input.ids = { static_cast<Id>(Sphere->points.size()) };
  EXPECT_THROW(this->Update(), InvalidInput);
  input.ids = {};
  input.mask = Cap("cap", 2.0); // 0 everywhere
  EXPECT_THROW(this->Update(), InvalidInput);
  options.isSigned = true; // of points
  EXPECT_THROW(this->Update(), InvalidInput);
  input.mask = {}; // neither labels nor a curve
  EXPECT_THROW(this->Update(), InvalidInput);
  input.labels = Cap("cap", 0.0);
  for (const double smoothing : { std::nan(""), 0.5, 0.89, 1001.0 })
  {
    options.smoothing = smoothing;
    EXPECT_THROW(this->Update(), InvalidInput) << smoothing;
  }
}

namespace
{

/// The only warning of distances at a low depth; empty if there is none.
std::string WarningOf(const TriangleMesh& mesh, const DistanceSolver::Input& input,
  const DistanceSolver::Options& options = {})
{
  const DistanceSolver::Result result =
    DistanceSolver::Solve(std::make_shared<const TriangleMesh>(mesh), input, options, AtDepth4);
  EXPECT_LE(result.warnings.size(), 1u);
  return result.warnings.empty() ? std::string() : result.warnings.front();
}

TriangleMesh Crumb()
{
  TriangleMesh crumb;
  crumb.points = { { 3, 0, 0 }, { 3.01, 0, 0 }, { 3, 0.01, 0 } };
  crumb.triangles = { { 0, 1, 2 } };
  return crumb;
}

} // namespace

/// The first point is the point with the least id, for any order of the triangles.
TEST(DistanceSolver, RefusesAStabilizationThatMakesTheHeatOscillate)
{
  SurfaceOptions options = AtDepth<DistanceSolver>(3);
  EXPECT_NO_THROW(DistanceSolver::Solve(Sphere, {}, {}, options));
  options.choice.normalStabilization = 0.05;
  EXPECT_THROW(DistanceSolver::Solve(Sphere, {}, {}, options), InvalidInput);
}

TEST(DistanceSolver, StartsAtTheFirstPointWhereNoSourceIsChosen)
{
  TriangleMesh mesh = *Sphere;
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  const DistanceSolver::Result result =
    DistanceSolver::Solve(std::make_shared<const TriangleMesh>(mesh), {}, {}, AtDepth4);
  EXPECT_EQ((result.atPoints.array() == 0.0).count(), 1);
  EXPECT_EQ(result.atPoints(0, 0), 0.0);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(DistanceSolver, TellsWhenMostPointsHaveNoDistance)
{
  const TriangleMesh crumbFirst = Join(Crumb(), *Sphere);
  EXPECT_NE(WarningOf(crumbFirst, {}).find("No source is chosen"), std::string::npos);
  DistanceSolver::Input chosen;
  chosen.ids = { 1 }; // of the crumb
  const std::string warning = WarningOf(crumbFirst, chosen);
  EXPECT_NE(warning.find("% of the points have no distance"), std::string::npos);
  EXPECT_EQ(warning.find("No source is chosen"), std::string::npos);
  chosen.ids = { 7 }; // of the sphere: three points have no distance
  EXPECT_EQ(WarningOf(crumbFirst, chosen), "");
  EXPECT_EQ(WarningOf(Join(*Sphere, Crumb()), {}), "");
  chosen.ids = { 1, 7 };
  EXPECT_EQ(WarningOf(crumbFirst, chosen), "");
}

TEST(DistanceSolver, NamesALabelThatIsNowhereOrEverywhere)
{
  DistanceSolver::Options options;
  options.isSigned = true;
  DistanceSolver::Input input;
  input.labels = Cap("cap", 0.2);
  const auto message = [&](int label) -> std::string
  {
    options.insideLabel = label;
    try
    {
      DistanceSolver::Solve(Sphere, input, options, AtDepth4);
    }
    catch (const InvalidInput& error)
    {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message(77).find("no point or cell has the Inside Label 77"), std::string::npos);
  EXPECT_NE(message(77).find("from 0 to 1"), std::string::npos);
  EXPECT_EQ(message(1), "");
  input.labels = Cap("cap", -2.0);
  EXPECT_NE(message(1).find("all points or cells have the Inside Label 1"), std::string::npos);
}
