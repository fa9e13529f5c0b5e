// Interpolation in one shot and in steps, and the stages that a changed option repeats.
#include "Solvers/InterpolationSolver.h"

#include "AtDepth.h"
#include "ExpectOne.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

const SurfaceOptions AtDepth4 = AtDepth<InterpolationSolver>(4);

/// Values at the points 0, 1, ...
InterpolationSolver::Input Values(const std::vector<double>& values)
{
  InterpolationSolver::Input input;
  input.values.find = [values]
  {
    PointValues known;
    known.values.resize(static_cast<Id>(values.size()), 1);
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      known.points.push_back(static_cast<Id>(k));
      known.values(static_cast<Id>(k), 0) = values[k];
    }
    return known;
  };
  return input;
}

} // namespace

/// The two short sides of a rectangle hold x, which is harmonic. The functions of the grid
/// reproduce it.
TEST(InterpolationSolver, BetweenTwoSidesOfARectangleIsLinear)
{
  const auto mesh = std::make_shared<const TriangleMesh>(FlatRectangle(24, 12, 2.0, 1.0));
  InterpolationSolver::Input input;
  input.values.find = [&mesh]
  {
    PointValues known;
    for (Id point = 0; point < static_cast<Id>(mesh->points.size()); ++point)
    {
      const double x = mesh->points[point][0];
      if (x < 1e-9 || x > 2.0 - 1e-9)
      {
        known.points.push_back(point);
        known.values.conservativeResize(static_cast<Id>(known.points.size()), 1);
        known.values(known.values.rows() - 1, 0) = x;
      }
    }
    return known;
  };
  const InterpolationSolver::Result result = InterpolationSolver::Solve(mesh, input, {}, AtDepth4);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_LT(result.misfit, 1e-6);
  for (std::size_t point = 0; point < mesh->points.size(); ++point)
  {
    EXPECT_NEAR(result.atPoints(static_cast<Id>(point), 0), mesh->points[point][0], 1e-4);
  }
}

/// A constant that is far larger than the variation changes nothing else.
TEST(InterpolationSolver, KeepsTheVariationAboveALargeConstant)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(12));
  InterpolationSolver::Options options;
  options.equation.solve.tolerance = 1e-10;
  for (const Smoothness smoothness : { Smoothness::Harmonic, Smoothness::Biharmonic })
  {
    options.smoothness = smoothness;
    const MultiVector expected =
      InterpolationSolver::Solve(mesh, Values({ 0.0, 1.0, 3.0 }), options, AtDepth4).atPoints;
    for (const double constant : { -1e9, 1e12 })
    {
      MultiVector found = InterpolationSolver::Solve(
        mesh, Values({ constant, constant + 1.0, constant + 3.0 }), options, AtDepth4)
                            .atPoints;
      found.array() -= constant;
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 3e-4);
    }
  }
}

TEST(InterpolationSolver, StepwiseUseGivesTheBitsOfOneShot)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(12));
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth4);
  InterpolationSolver solver;
  InterpolationSolver::Options options;
  const auto update = [&](const InterpolationSolver::Input& input)
  {
    const auto before = stages.Runs(SolveStage);
    const MultiVector stepwise = solver.Update(surface, input, options).atPoints;
    EXPECT_EQ(stepwise, InterpolationSolver::Solve(mesh, input, options, AtDepth4).atPoints);
    return stages.Runs(SolveStage) - before;
  };
  EXPECT_EQ(update(Values({ 1.0, 2.0 })), 1);
  EXPECT_EQ(update(Values({ 1.0, 2.0 })), 0);
  EXPECT_EQ(update(Values({ 1.0, 3.0 })), 1);
  options.smoothness = Smoothness::Biharmonic;
  EXPECT_EQ(update(Values({ 1.0, 3.0 })), 1);
  EXPECT_EQ(stages.Runs(SpaceStage), 1);
}

/// A point that no triangle uses cannot hold a value. The value changes nothing, and a warning
/// names the point.
TEST(InterpolationSolver, NamesGivenPointsThatNoFunctionReaches)
{
  TriangleMesh withPoint = GeodesicSphere(8);
  const auto alone = static_cast<Id>(withPoint.points.size());
  withPoint.points.emplace_back(0.0, 0.0, 0.5);
  const auto mesh = std::make_shared<const TriangleMesh>(withPoint);
  const auto values = [](const std::vector<Id>& points, const std::vector<double>& numbers)
  {
    InterpolationSolver::Input input;
    input.values.find = [=]
    {
      const auto rows = static_cast<Id>(numbers.size());
      return PointValues{ points, Eigen::Map<const Eigen::VectorXd>(numbers.data(), rows) };
    };
    return input;
  };
  for (const Smoothness smoothness : { Smoothness::Harmonic, Smoothness::Biharmonic })
  {
    InterpolationSolver::Options options;
    options.smoothness = smoothness;
    options.equation.solve.tolerance = 1e-10;
    const auto solve = [&](const InterpolationSolver::Input& input)
    { return InterpolationSolver::Solve(mesh, input, options, AtDepth4); };
    const auto without = solve(values({ 3, 40, 90 }, { 1.0, 2.0, 1.5 }));
    const auto with = solve(values({ 3, 40, 90, alone }, { 1.0, 2.0, 1.5, 1.8 }));
    EXPECT_TRUE(without.warnings.empty());
    ExpectOne(with.warnings, "at point " + std::to_string(alone) + " ");
    EXPECT_LT(with.misfit, 1e-3);
    const auto difference = (with.atPoints - without.atPoints).topRows(alone).cwiseAbs();
    EXPECT_LT(difference.maxCoeff<Eigen::PropagateNaN>(), 1e-5);
  }
}

/// A second component without a value is NaN, and a warning says so.
TEST(InterpolationSolver, ComponentsWithoutAValueAreUnknown)
{
  const TriangleMesh sphere = GeodesicSphere(8);
  const auto mesh = std::make_shared<const TriangleMesh>(
    Join(sphere, Transform(sphere, { 0, 0, 1 }, 0.0, 1.0, { 4, 0, 0 })));
  const InterpolationSolver::Result result =
    InterpolationSolver::Solve(mesh, Values({ 1.0, 2.0 }), {}, AtDepth4);
  const Id half = result.atPoints.rows() / 2;
  EXPECT_TRUE(result.atPoints.topRows(half).allFinite());
  EXPECT_TRUE(result.atPoints.bottomRows(half).array().isNaN().all());
  ASSERT_EQ(result.warnings.size(), 1u);
}
