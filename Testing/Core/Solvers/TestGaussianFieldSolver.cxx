// The solver's stages, its units, statistics, observations and warnings. TestMaternField has the
// covariance, TestKriging the prediction.
#include "AtDepth.h"
#include "Dense.h"
#include "EachOption.h"
#include "ExpectOne.h"
#include "Meshes.h"
#include "Solvers/GaussianFieldSolver.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

SurfaceOptions At(int depth, ParameterUnits units = ParameterUnits::UnitArea)
{
  SurfaceOptions options = AtDepth<GaussianFieldSolver>(depth);
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

/// Observations of a wave with a large constant, at every `step`-th point.
GaussianFieldSolver::Input Observe(const TriangleMesh& mesh, Id step, double amplitude = 1.0)
{
  PointValues observed;
  for (Id point = 0; point < static_cast<Id>(mesh.points.size()); point += step)
  {
    observed.points.push_back(point);
  }
  observed.values.resize(static_cast<Id>(observed.points.size()), 1);
  for (Id row = 0; row < observed.values.rows(); ++row)
  {
    const Vec3& p = mesh.points[observed.points[row]];
    observed.values(row, 0) = 50.0 + amplitude * std::sin(2.0 * p[0] + p[1]);
  }
  GaussianFieldSolver::Input input;
  input.observations.find = [observed] { return observed; };
  return input;
}

/// The covariance of the field between all points, by the solver's own equations.
Eigen::MatrixXd CovarianceAtPoints(const std::shared_ptr<const TriangleMesh>& mesh,
  const GaussianFieldSolver::Options& options, const SurfaceOptions& surfaceOptions)
{
  Stages stages;
  LocalSurface surface(stages, mesh, surfaceOptions);
  surface.Prepare({});
  MaternOptions ofField{ options.equation };
  ofField.smoothness = options.smoothness;
  ofField.kappa = std::sqrt(8.0 * options.smoothness) * surface.Space().UnitLength() /
                  surface.LengthInWorldUnits(options.range);
  const MaternField field(surface.WholeSpace(), ofField);
  std::vector<Id> points(mesh->points.size());
  std::iota(points.begin(), points.end(), Id(0));
  const PointCovariances all(field, surface.WholeSpace()->RowsAtPoints(points));
  return options.standardDeviation * options.standardDeviation * all.BetweenPoints();
}

/// The standard deviation of the error of ordinary kriging, from the covariance of all points.
Eigen::VectorXd ExactDeviation(
  const Eigen::MatrixXd& S, const std::vector<Id>& observed, double noise)
{
  const Id n = static_cast<Id>(observed.size());
  // [C 1; 1ᵀ 0] and its right-hand sides, a column for each point.
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 1);
  Eigen::MatrixXd right = Eigen::MatrixXd::Ones(n + 1, S.cols());
  for (Id i = 0; i < n; ++i)
  {
    for (Id j = 0; j < n; ++j)
    {
      system(i, j) = S(observed[i], observed[j]) + (i == j ? noise * noise : 0.0);
    }
    system(i, n) = system(n, i) = 1.0;
    right.row(i) = S.row(observed[i]);
  }
  const Eigen::MatrixXd solved = LeastSquares(system, right);
  return (S.diagonal().transpose().array() - (solved.array() * right.array()).colwise().sum())
    .sqrt()
    .transpose();
}

double LargestDifference(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other)
{
  return (one - other).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

} // namespace

TEST(GaussianFieldSolver, EachOptionChangesTheResultAsInANewSolver)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  const GaussianFieldSolver::Options options = Of(3);
  const GaussianFieldSolver::Input input = Observe(*mesh, 50);
  Stages stages;
  LocalSurface surface(stages, mesh, At(4));
  GaussianFieldSolver solver;
  const MultiVector first = solver.Update(surface, input, options).atPoints;
  for (const auto& [name, changed] : EachChanged(options))
  {
    const MultiVector here = solver.Update(surface, input, changed).atPoints;
    EXPECT_EQ(here, GaussianFieldSolver::Solve(mesh, input, changed, At(4)).atPoints) << name;
    EXPECT_FALSE(here.cols() == first.cols() && here == first) << name;
    EXPECT_EQ(solver.Update(surface, input, options).atPoints, first) << name;
  }
}

TEST(GaussianFieldSolver, OtherObservationsGiveTheResultOfANewSolver)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  const GaussianFieldSolver::Options options = Of(2);
  Stages stages;
  LocalSurface surface(stages, mesh, At(4));
  GaussianFieldSolver solver;
  for (const GaussianFieldSolver::Input& input : { Observe(*mesh, 50), Observe(*mesh, 50, 2.0),
         GaussianFieldSolver::Input(), Observe(*mesh, 50, 2.0), Observe(*mesh, 41) })
  {
    const GaussianFieldSolver::Result expected =
      GaussianFieldSolver::Solve(mesh, input, options, At(4));
    const GaussianFieldSolver::Result& found = solver.Update(surface, input, options);
    EXPECT_EQ(found.atPoints, expected.atPoints);
    EXPECT_EQ(found.prediction.mean, expected.prediction.mean);
    EXPECT_EQ(found.prediction.logLikelihood, expected.prediction.logLikelihood);
  }
  EXPECT_EQ(stages.Runs(HierarchyStage), 1);
  EXPECT_EQ(stages.Runs(RightHandSideStage), 3); // other values and other noise need none
}

TEST(GaussianFieldSolver, AnotherSeedRepeatsOnlyTheSolves)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  Stages stages;
  LocalSurface surface(stages, mesh, At(4));
  GaussianFieldSolver solver;
  GaussianFieldSolver::Options options = Of(1);
  for (options.seed = 0; options.seed < 3; ++options.seed)
  {
    solver.Update(surface, {}, options);
  }
  EXPECT_EQ(stages.Runs(HierarchyStage), 1);
  EXPECT_EQ(stages.Runs(SolveStage), 3);
}

TEST(GaussianFieldSolver, StatisticsAreThoseOfTheSamples)
{
  constexpr int Samples = 21;
  const auto mesh = std::make_shared<const TriangleMesh>(FlatRectangle(10, 10));
  const MultiVector samples = GaussianFieldSolver::Solve(mesh, {}, Of(Samples), At(4)).atPoints;
  ASSERT_EQ(samples.cols(), Samples);
  const MultiVector found = GaussianFieldSolver::Solve(mesh, {}, Of(Samples, true), At(4)).atPoints;
  ASSERT_EQ(found.cols(), 2);
  for (Id i = 0; i < samples.rows(); ++i)
  {
    const double mean = samples.row(i).mean();
    const double squares = (samples.row(i).array() - mean).square().sum();
    ASSERT_NEAR(found(i, 0), mean, 1e-12);
    ASSERT_NEAR(found(i, 1), std::sqrt(squares / (Samples - 1)), 1e-12);
  }
  // More samples begin with the same ones.
  const MultiVector more = GaussianFieldSolver::Solve(mesh, {}, Of(30), At(4)).atPoints;
  EXPECT_LT((more.leftCols(Samples) - samples).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-5);
}

/// The surface and the range in its unit of length grow together: the field stays the same.
TEST(GaussianFieldSolver, RangeIsInTheUnitsOfParameters)
{
  const TriangleMesh small = GeodesicSphere(8);
  GaussianFieldSolver::Options options = Of(2);
  const MultiVector expected =
    GaussianFieldSolver::Solve(std::make_shared<const TriangleMesh>(small), {}, options, At(4))
      .atPoints;
  const auto large = std::make_shared<const TriangleMesh>(Transform(small, { 0, 0, 1 }, 0.0, 8.0));
  const auto difference = [&](ParameterUnits units)
  {
    const MultiVector found = GaussianFieldSolver::Solve(large, {}, options, At(4, units)).atPoints;
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
  EXPECT_TRUE(GaussianFieldSolver::Solve(mesh, {}, options, At(5)).warnings.empty());
  options.range = 0.02;
  const std::vector<std::string> warnings =
    GaussianFieldSolver::Solve(mesh, {}, options, At(5)).warnings;
  ExpectOne(warnings, "Range is only");
}

/// On a sphere of area 1 the variance is the sum over the spherical harmonics. A range that makes
/// the standard deviation more than a tenth too large gives a warning.
TEST(GaussianFieldSolver, WarnsIfTheRangeMakesTheStandardDeviationTooLarge)
{
  const double pi = std::acos(-1.0);
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  GaussianFieldSolver::Options options = Of(1);
  for (const int smoothness : { 1, 3 })
  {
    options.smoothness = smoothness;
    for (const double range : { 0.2, 0.4, 0.8, 1.5, 3.0 })
    {
      const double kappa2 = 8.0 * smoothness / (range * range);
      double sum = 0.0;
      for (int l = 0; l < 2000; ++l)
      {
        sum += (2 * l + 1) / std::pow(kappa2 + 4.0 * pi * l * (l + 1), smoothness + 1);
      }
      const double deviation =
        std::sqrt(4.0 * pi * smoothness * std::pow(kappa2, smoothness) * sum);
      options.range = range;
      const std::vector<std::string> warnings =
        GaussianFieldSolver::Solve(mesh, {}, options, At(4)).warnings;
      EXPECT_EQ(warnings.empty(), deviation < 1.1) << smoothness << " " << range;
      // The prediction has an unknown mean anyway.
      EXPECT_TRUE(
        GaussianFieldSolver::Solve(mesh, Observe(*mesh, 50), options, At(4)).warnings.empty())
        << smoothness << " " << range;
    }
  }
}

/// A fragment is small beside the range, also if the surface is not.
TEST(GaussianFieldSolver, WarnsOfSmallComponents)
{
  const TriangleMesh sphere = GeodesicSphere(8);
  const auto mesh = std::make_shared<const TriangleMesh>(
    Join(sphere, Transform(sphere, { 0, 0, 1 }, 0.0, 0.1, { 2, 0, 0 })));
  for (const GaussianFieldSolver::Input& input :
    { GaussianFieldSolver::Input(), Observe(*mesh, 50) })
  {
    const std::vector<std::string> warnings =
      GaussianFieldSolver::Solve(mesh, input, Of(1), At(5)).warnings;
    ExpectOne(warnings, "1 of 2 connected components");
  }
}

/// The warning names the tolerance that was missed: of samples, or of covariances.
TEST(GaussianFieldSolver, WarnsWithTheToleranceThatWasMissed)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  GaussianFieldSolver::Options options = Of(1);
  for (const double tolerance : { 1e-2, 1e-5, 1e-12 })
  {
    options.equation.solve.tolerance = tolerance;
    options.equation.solve.maximumIterations = 1;
    const GaussianFieldSolver::Result result =
      GaussianFieldSolver::Solve(mesh, Observe(*mesh, 200), options, At(4));
    ASSERT_FALSE(result.warnings.empty());
    std::ostringstream used;
    used << "the Tolerance is " << std::min(tolerance, 1e-9) << ".";
    EXPECT_NE(result.warnings.back().find(used.str()), std::string::npos) << result.warnings.back();
    EXPECT_FALSE(result.report.converged);
  }
}

/// Unused points get values, too, so they count.
TEST(GaussianFieldSolver, RefusesSamplesThatDoNotFitIntoMemory)
{
  TriangleMesh sphere = GeodesicSphere(4);
  sphere.points.resize(2000000, Vec3::Zero());
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(sphere));
  try
  {
    GaussianFieldSolver::Solve(mesh, {}, Of(100000), At(3)); // 3.2 TB
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("fewer samples"), std::string::npos) << error.what();
  }
}

TEST(GaussianFieldSolver, StatisticsOfOneSampleTakeAHundred)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(4));
  for (const GaussianFieldSolver::Input& input :
    { GaussianFieldSolver::Input(), Observe(*mesh, 50) })
  {
    EXPECT_EQ(GaussianFieldSolver::Solve(mesh, input, Of(1, true), At(3)).atPoints,
      GaussianFieldSolver::Solve(mesh, input, Of(100, true), At(3)).atPoints);
  }
}

TEST(GaussianFieldSolver, RefusesNoRange)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(4));
  for (const double range : { 0.0, -1.0, std::nan("") })
  {
    GaussianFieldSolver::Options options = Of(1);
    options.range = range;
    EXPECT_THROW(GaussianFieldSolver::Solve(mesh, {}, options, At(3)), InvalidInput);
  }
}

/// Samples honor the observations: their spread at an observed point is at most the noise.
TEST(GaussianFieldSolver, PredictionAndSamplesMeetTheObservations)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(10));
  const GaussianFieldSolver::Input input = Observe(*mesh, 60);
  const PointValues observed = input.observations.find();
  GaussianFieldSolver::Options options = Of(20);
  for (const double noise : { 0.0, 0.1 })
  {
    options.observationNoise = noise;
    const double allowed = 5.0 * std::max(noise, GaussianFieldSolver::LeastNoise);
    const GaussianFieldSolver::Result result =
      GaussianFieldSolver::Solve(mesh, input, options, At(5));
    const MultiVector& samples = result.atPoints;
    for (Id k = 0; k < observed.values.rows(); ++k)
    {
      const Id point = observed.points[k];
      EXPECT_NEAR(result.prediction.mean[point], observed.values(k, 0), allowed);
      for (Id c = 0; c < samples.cols(); ++c)
      {
        ASSERT_NEAR(samples(point, c), result.prediction.mean[point], allowed);
      }
    }
    const MultiVector spread = samples.colwise() - result.prediction.mean;
    EXPECT_GT(spread.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1.0); // far from the observations
  }
}

/// The standard deviation of 1,000 samples against the exact one. Its estimate has a relative
/// standard error of 1 / √2000.
TEST(GaussianFieldSolver, HasTheDeviationOfThePosterior)
{
  constexpr int Samples = 1000;
  const double standardError = 1.0 / std::sqrt(2.0 * Samples);
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(6));
  SurfaceOptions surface = At(4);
  surface.choice.kind = FunctionKind::Hats;
  GaussianFieldSolver::Options options = Of(Samples, true);
  options.range = 0.4;
  options.smoothness = 1;
  options.standardDeviation = 3.0;
  const GaussianFieldSolver::Input input = Observe(*mesh, 61);
  const PointValues observed = input.observations.find();
  for (const double noise : { 0.3, 2.0 })
  {
    options.observationNoise = noise;
    const GaussianFieldSolver::Result result =
      GaussianFieldSolver::Solve(mesh, input, options, surface);
    EXPECT_EQ(result.atPoints.col(0), result.prediction.mean);
    // The covariance of the same field at all points, from which the exact deviation follows.
    const Eigen::MatrixXd S = CovarianceAtPoints(mesh, options, surface);
    const Eigen::VectorXd exact = ExactDeviation(S, observed.points, noise);
    const Eigen::ArrayXd ratio = result.atPoints.col(1).array() / exact.array();
    EXPECT_LT((ratio - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 5.5 * standardError);
    EXPECT_NEAR(std::sqrt((ratio - 1.0).square().mean()), 0.0, 1.3 * standardError);
  }
}

/// The surface, the values, the noise and the standard deviation in another unit.
TEST(GaussianFieldSolver, ThePredictionScalesWithTheValues)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  const auto large = std::make_shared<const TriangleMesh>(Transform(*mesh, { 0, 0, 1 }, 0.0, 8.0));
  GaussianFieldSolver::Options options = Of(2);
  options.observationNoise = 0.2;
  const GaussianFieldSolver::Input input = Observe(*mesh, 50);
  const GaussianFieldSolver::Result one = GaussianFieldSolver::Solve(mesh, input, options, At(4));
  GaussianFieldSolver::Input scaled;
  scaled.observations.find = [&]
  {
    PointValues values = input.observations.find();
    values.values *= 10.0;
    return values;
  };
  options.observationNoise *= 10.0;
  options.standardDeviation *= 10.0;
  const GaussianFieldSolver::Result other =
    GaussianFieldSolver::Solve(large, scaled, options, At(4));
  EXPECT_LT(LargestDifference(10.0 * one.prediction.mean, other.prediction.mean), 1e-4);
  EXPECT_NEAR(one.prediction.leaveOneOutRatio, other.prediction.leaveOneOutRatio, 1e-6);
}

TEST(GaussianFieldSolver, RefusesObservationsThatItCannotUse)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(4));
  const auto refuses = [&](const PointValues& observed, const GaussianFieldSolver::Options& options)
  {
    GaussianFieldSolver::Input input;
    input.observations.find = [&] { return observed; };
    EXPECT_THROW(GaussianFieldSolver::Solve(mesh, input, options, At(3)), InvalidInput);
  };
  refuses({ {}, MultiVector(0, 1) }, Of(1));
  refuses({ { 3 }, MultiVector::Ones(1, 2) }, Of(1));
  const Id tooMany = GaussianFieldSolver::MostObservations + 1;
  refuses({ std::vector<Id>(tooMany, 7), MultiVector::Ones(tooMany, 1) }, Of(1));
  GaussianFieldSolver::Options without = Of(1);
  without.standardDeviation = 0.0;
  refuses({ { 3 }, MultiVector::Ones(1, 1) }, without);
}

/// Observations of one place with different values are met in the mean.
TEST(GaussianFieldSolver, SeveralObservationsOfOnePlaceAreMetInTheMean)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(6));
  GaussianFieldSolver::Input input;
  input.observations.find = []
  {
    PointValues observed{ { 3, 100, 3, 3 }, MultiVector(4, 1) };
    observed.values << 1.0, 0.0, 2.0, 6.0;
    return observed;
  };
  const GaussianFieldSolver::Result result = GaussianFieldSolver::Solve(mesh, input, Of(4), At(4));
  EXPECT_NEAR(result.prediction.mean[3], 3.0, 0.01);
  EXPECT_NEAR(result.prediction.mean[100], 0.0, 0.01);
  for (Id c = 0; c < 4; ++c)
  {
    EXPECT_NEAR(result.atPoints(3, c), 3.0, 0.02);
  }
}

/// Each is predicted from the others of its place, too. The place has the mean of their errors.
TEST(GaussianFieldSolver, SeveralObservationsOfOnePlaceHaveTheMeanOfTheirErrors)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(6));
  const auto solve = [&](const std::vector<Id>& points, const std::vector<double>& values)
  {
    PointValues observed{ points, MultiVector(static_cast<Id>(values.size()), 1) };
    std::copy(values.begin(), values.end(), observed.values.data());
    GaussianFieldSolver::Input input;
    input.observations.find = [observed] { return observed; };
    GaussianFieldSolver::Options options = Of(2);
    options.observationNoise = 0.4;
    return GaussianFieldSolver::Solve(mesh, input, options, At(4)).prediction;
  };
  const double first = 1.0 - solve({ 100, 3 }, { 0.0, 2.5 }).mean[3];
  const double second = 2.5 - solve({ 100, 3 }, { 0.0, 1.0 }).mean[3];
  EXPECT_NEAR(
    solve({ 3, 100, 3 }, { 1.0, 0.0, 2.5 }).leaveOneOutError[3], 0.5 * (first + second), 1e-6);
}
