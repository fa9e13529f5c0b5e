// The solver's stages, its units, statistics and warnings. TestMaternField has the covariance.
#include "EachOption.h"
#include "Meshes.h"
#include "Solvers/GaussianFieldSolver.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

SurfaceOptions AtDepth(int depth, ParameterUnits units = ParameterUnits::UnitArea)
{
  SurfaceOptions options = GaussianFieldSolver::SurfaceDefaults();
  options.space.depth = depth;
  options.parameterUnits = units;
  return options;
}

GaussianFieldSolver::Options Of(int samples, bool statistics = false)
{
  GaussianFieldSolver::Options options;
  options.numberOfSamples = samples;
  options.statistics = statistics;
  return options;
}

} // namespace

TEST(GaussianFieldSolver, EachOptionChangesTheResultAsInANewSolver)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  const GaussianFieldSolver::Options options = Of(3);
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth(4));
  GaussianFieldSolver solver;
  const MultiVector first = solver.Update(surface, options).atPoints;
  for (const auto& [name, changed] : EachChanged(options))
  {
    const MultiVector here = solver.Update(surface, changed).atPoints;
    EXPECT_EQ(here, GaussianFieldSolver::Solve(mesh, changed, AtDepth(4)).atPoints) << name;
    EXPECT_FALSE(here.cols() == first.cols() && here == first) << name;
    EXPECT_EQ(solver.Update(surface, options).atPoints, first) << name;
  }
}

TEST(GaussianFieldSolver, AnotherSeedRepeatsOnlyTheSolves)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth(4));
  GaussianFieldSolver solver;
  GaussianFieldSolver::Options options = Of(1);
  for (options.seed = 0; options.seed < 3; ++options.seed)
  {
    solver.Update(surface, options);
  }
  EXPECT_EQ(stages.Runs(HierarchyStage), 1);
  EXPECT_EQ(stages.Runs(SolveStage), 3);
}

TEST(GaussianFieldSolver, StatisticsAreThoseOfTheSamples)
{
  constexpr int Samples = 21;
  const auto mesh = std::make_shared<const TriangleMesh>(FlatRectangle(10, 10));
  const MultiVector samples = GaussianFieldSolver::Solve(mesh, Of(Samples), AtDepth(4)).atPoints;
  ASSERT_EQ(samples.cols(), Samples);
  const MultiVector found =
    GaussianFieldSolver::Solve(mesh, Of(Samples, true), AtDepth(4)).atPoints;
  ASSERT_EQ(found.cols(), 2);
  for (Id i = 0; i < samples.rows(); ++i)
  {
    const double mean = samples.row(i).mean();
    const double squares = (samples.row(i).array() - mean).square().sum();
    ASSERT_NEAR(found(i, 0), mean, 1e-12);
    ASSERT_NEAR(found(i, 1), std::sqrt(squares / (Samples - 1)), 1e-12);
  }
  // More samples begin with the same ones.
  const MultiVector more = GaussianFieldSolver::Solve(mesh, Of(30), AtDepth(4)).atPoints;
  EXPECT_LT((more.leftCols(Samples) - samples).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-5);
}

/// The surface and the range in its unit of length grow together: the field stays the same.
TEST(GaussianFieldSolver, RangeIsInTheUnitsOfParameters)
{
  const TriangleMesh small = GeodesicSphere(8);
  GaussianFieldSolver::Options options = Of(2);
  const MultiVector expected =
    GaussianFieldSolver::Solve(std::make_shared<const TriangleMesh>(small), options, AtDepth(4))
      .atPoints;
  const auto large = std::make_shared<const TriangleMesh>(Transform(small, { 0, 0, 1 }, 0.0, 8.0));
  const auto difference = [&](ParameterUnits units)
  {
    const MultiVector found =
      GaussianFieldSolver::Solve(large, options, AtDepth(4, units)).atPoints;
    return (found - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  };
  EXPECT_LT(difference(ParameterUnits::UnitArea), 1e-5);
  EXPECT_GT(difference(ParameterUnits::World), 0.1);
  options.range *= std::sqrt(SurfaceArea(*large));
  EXPECT_LT(difference(ParameterUnits::World), 1e-5);
}

TEST(GaussianFieldSolver, WarnsOfARangeThatFunctionsDoNotResolve)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  GaussianFieldSolver::Options options = Of(1);
  EXPECT_TRUE(GaussianFieldSolver::Solve(mesh, options, AtDepth(5)).warnings.empty());
  options.range = 0.02;
  const std::vector<std::string> warnings =
    GaussianFieldSolver::Solve(mesh, options, AtDepth(5)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("Range is only"), std::string::npos);
}

TEST(GaussianFieldSolver, RefusesNoRangeAndStatisticsOfOneSample)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(4));
  for (const double range : { 0.0, -1.0, std::nan("") })
  {
    GaussianFieldSolver::Options options = Of(1);
    options.range = range;
    EXPECT_THROW(GaussianFieldSolver::Solve(mesh, options, AtDepth(3)), InvalidInput);
  }
  EXPECT_THROW(GaussianFieldSolver::Solve(mesh, Of(1, true), AtDepth(3)), InvalidInput);
}
