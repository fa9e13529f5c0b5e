// The solver of signatures: exact values on a sphere, given modes, and the stages that a change
// repeats.
#include "Meshes.h"

#include "Solvers/LocalSurface.h"
#include "Solvers/SignatureSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

class Signatures : public ::testing::Test
{
protected:
  Signatures()
  {
    asked.space.depth = 5;
    options.numberOfModes = 25;
    options.numberOfScales = 4;
    input.sources = { 7 };
  }

  GivenField PointField(MultiVector values) const
  {
    return GivenField::Of("p", Field{ FieldAssociation::Points, std::move(values) });
  }

  const std::shared_ptr<const TriangleMesh> mesh =
    std::make_shared<const TriangleMesh>(GeodesicSphere(16));
  SurfaceOptions asked = SignatureSolver::SurfaceDefaults();
  SignatureSolver::Options options;
  SignatureSolver::Input input;
  Stages stages;
  SignatureSolver solver;
};

TEST_F(Signatures, ASphereHasItsSeriesEverywhere)
{
  const SignatureSolver::Result result = SignatureSolver::Solve(mesh, input, options, asked);
  ASSERT_EQ(result.heatKernel.cols(), 4);
  ASSERT_EQ(result.heatKernel.rows(), static_cast<Id>(mesh->points.size()));
  for (Id scale = 0; scale < 4; ++scale)
  {
    double series = 0.0;
    for (int l = 0; l < 5; ++l)
    {
      series += (2 * l + 1) * std::exp(-l * (l + 1) * result.heatTimes[scale]);
    }
    // 1,000 flat triangles and cells of 1/16 of the radius: 2 % for the fourth degree
    EXPECT_LT(
      (result.heatKernel.col(scale).array() / series - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(),
      0.02);
    EXPECT_LT(
      (result.waveKernel.col(scale).array() - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 0.02);
  }
  EXPECT_EQ(result.biharmonicDistance[7], 0.0);
  EXPECT_EQ(result.diffusionDistance[7], 0.0);
  EXPECT_EQ(result.filtered.cols(), 0);
  EXPECT_TRUE(result.warnings.empty());
}

TEST_F(Signatures, OneShotIsStepwiseAndGivenModesAreTaken)
{
  options.filterType = ModeFilter::LowPass;
  const SignatureSolver::Result once = SignatureSolver::Solve(mesh, input, options, asked);
  LocalSurface surface(stages, mesh, asked);
  input.modes = { mesh, once.modes, {} };
  const SignatureSolver::Result given = solver.Update(surface, input, options, {});
  EXPECT_EQ(stages.Runs(SpaceStage), 0);
  EXPECT_EQ(stages.Runs(SolveStage), 0);
  input.modes = {};
  const SignatureSolver::Result stepwise = solver.Update(surface, input, options, {});
  EXPECT_EQ(stages.Runs(SolveStage), 1);
  for (const SignatureSolver::Result* result : { &given, &stepwise })
  {
    EXPECT_EQ(result->heatKernel, once.heatKernel);
    EXPECT_EQ(result->waveKernel, once.waveKernel);
    EXPECT_EQ(result->biharmonicDistance, once.biharmonicDistance);
    EXPECT_EQ(result->diffusionDistance, once.diffusionDistance);
    EXPECT_EQ(result->filtered, once.filtered);
  }
}

TEST_F(Signatures, OnlyWhatDependsOnAChangeRunsAgain)
{
  LocalSurface surface(stages, mesh, asked);
  const auto runs = [&]
  {
    solver.Update(surface, input, options, {});
    return std::array<std::int64_t, 4>{ stages.Runs(SolveStage), stages.Runs("Signatures"),
      stages.Runs("Distances"), stages.Runs("Filter") };
  };
  using Runs = std::array<std::int64_t, 4>;
  EXPECT_EQ(runs(), (Runs{ 1, 1, 1, 1 }));
  EXPECT_EQ(runs(), (Runs{ 1, 1, 1, 1 }));
  options.numberOfScales = 9;
  EXPECT_EQ(runs(), (Runs{ 1, 2, 1, 1 }));
  input.sources.push_back(3);
  EXPECT_EQ(runs(), (Runs{ 1, 2, 2, 1 }));
  options.filterType = ModeFilter::HighPass;
  EXPECT_EQ(runs(), (Runs{ 1, 2, 2, 2 }));
  options.numberOfModes = 16;
  EXPECT_EQ(runs(), (Runs{ 2, 3, 3, 3 }));
}

TEST_F(Signatures, LowAndHighPassAddUpAndAModePasses)
{
  LocalSurface surface(stages, mesh, asked);
  const PointModes modes = *solver.Update(surface, input, options, {}).modes;
  MultiVector values(modes.values.rows(), 2);
  for (Id point = 0; point < values.rows(); ++point)
  {
    values(point, 0) = std::sin(3.0 * mesh->points[point].x());
  }
  values.col(1) = modes.values.col(7);
  input.values = this->PointField(values);
  options.filterType = ModeFilter::LowPass;
  options.lastMode = 7;
  const MultiVector low = solver.Update(surface, input, options, {}).filtered;
  options.filterType = ModeFilter::HighPass;
  options.firstMode = 8;
  const MultiVector high = solver.Update(surface, input, options, {}).filtered;
  EXPECT_LT((low + high - values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);
  EXPECT_LT(
    high.col(1).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-8); // shares are exact to rounding
}

/// Also beside a large constant, which stays.
TEST_F(Signatures, SurrogatesHaveTheEnergyOfTheValues)
{
  LocalSurface surface(stages, mesh, asked);
  const PointModes modes = *solver.Update(surface, input, options, {}).modes;
  MultiVector values(modes.values.rows(), 2);
  values.col(0) = 2.0 * modes.values.col(2) + modes.values.col(6);
  values.col(1) = modes.values.col(3).array() + 1e9;
  input.values = this->PointField(values);
  options.filterType = ModeFilter::Surrogates;
  options.numberOfSurrogates = 3;
  const MultiVector surrogates = solver.Update(surface, input, options, {}).surrogates;
  ASSERT_EQ(surrogates.cols(), 6);
  EXPECT_EQ(solver.Update(surface, input, options, {}).filtered.cols(), 0);
  const double tolerance[2] = { 1e-8, 1e-5 };
  for (Id k = 0; k < surrogates.cols(); ++k)
  {
    MultiVector deviation = surrogates.col(k);
    deviation.array() -= k % 2 == 1 ? 1e9 : 0.0;
    const MultiVector shares = ExpandInModes(*mesh, modes, deviation).shares;
    const double energies[2] = { k % 2 == 1 ? 1.0 : 4.0, k % 2 == 1 ? 0.0 : 1.0 };
    EXPECT_NEAR(shares(0, 0), 0.0, tolerance[k % 2]);
    EXPECT_NEAR(shares.middleRows(1, 3).squaredNorm(), energies[0], tolerance[k % 2]);
    EXPECT_NEAR(shares.middleRows(4, 5).squaredNorm(), energies[1], tolerance[k % 2]);
    EXPECT_NEAR(shares.bottomRows(shares.rows() - 9).norm(), 0.0, tolerance[k % 2]);
  }
  EXPECT_TRUE(solver.Update(surface, input, options, {}).warnings.empty());
  for (Id point = 0; point < values.rows(); ++point)
  {
    values(point, 0) = std::sin(20.0 * mesh->points[point].x());
  }
  SignatureSolver::Input ofWild = input;
  ofWild.values = GivenField::Of("wild", Field{ FieldAssociation::Points, values }, 1);
  EXPECT_EQ(solver.Update(surface, ofWild, options, {}).warnings.size(), 1u);
  const auto runs = stages.Runs(SolveStage);
  options.seed = 2;
  EXPECT_NE(solver.Update(surface, input, options, {}).surrogates, surrogates);
  EXPECT_EQ(stages.Runs(SolveStage), runs);
  input.values = {};
  EXPECT_THROW(solver.Update(surface, input, options, {}), InvalidInput);
}

/// Modes that are 0 on the boundary, of the unit square. None of them is a constant.
TEST_F(Signatures, ErrorsAreRelativeToTheValuesIfNoModeIsConstant)
{
  const auto square = std::make_shared<const TriangleMesh>(FlatRectangle(40, 40));
  auto modes = std::make_shared<PointModes>();
  modes->area = 1.0;
  modes->values.resize(static_cast<Id>(square->points.size()), 3);
  constexpr int Waves[3][2] = { { 1, 1 }, { 1, 2 }, { 2, 1 } };
  for (int mode = 0; mode < 3; ++mode)
  {
    const auto [p, q] = Waves[mode];
    modes->eigenvalues.push_back(M_PI * M_PI * (p * p + q * q));
    for (Id point = 0; point < modes->values.rows(); ++point)
    {
      const Vec3& at = square->points[point];
      modes->values(point, mode) = 2.0 * std::sin(p * M_PI * at.x()) * std::sin(q * M_PI * at.y());
    }
  }
  input.modes = { square, modes, {} };
  MultiVector values(modes->values.rows(), 2);
  values.col(0) = 3.0 * modes->values.col(0) + 4.0 * modes->values.col(1);
  values.col(1).setConstant(1e7); // its share in the first mode is 8e7 / π²
  input.values = this->PointField(values);
  options.filterType = ModeFilter::LowPass;
  options.lastMode = 0;
  LocalSurface surface(stages, square, asked);
  const SignatureSolver::Result result = solver.Update(surface, input, options, {});
  EXPECT_NEAR(result.remaining(0, 0), 0.8, 1e-3);
  EXPECT_NEAR(result.remaining(1, 0), 0.0, 1e-6);
  const double share = 8.0 / (M_PI * M_PI);
  EXPECT_NEAR(result.remaining(0, 1), std::sqrt(1.0 - share * share), 1e-3);
  EXPECT_LT((result.filtered.col(0) - 3.0 * modes->values.col(0))
              .cwiseAbs()
              .maxCoeff<Eigen::PropagateNaN>(),
    0.01);
  EXPECT_LT((result.filtered.col(1) - 1e7 * share * modes->values.col(0))
              .cwiseAbs()
              .maxCoeff<Eigen::PropagateNaN>(),
    3e4);
}

TEST_F(Signatures, WrongInputIsRefused)
{
  options.filterType = ModeFilter::LowPass;
  const auto triangles = static_cast<Id>(mesh->triangles.size());
  input.values =
    GivenField::Of("c", Field{ FieldAssociation::Triangles, MultiVector::Zero(triangles, 1) });
  EXPECT_THROW(SignatureSolver::Solve(mesh, input, options, asked), InvalidInput);
  options.diffusionTime = -1.0;
  EXPECT_THROW(SignatureSolver::Solve(mesh, {}, options, asked), InvalidInput);
}

TEST_F(Signatures, BandsBeyondTheModesAreToldAndEmptyOnesRefused)
{
  LocalSurface surface(stages, mesh, asked);
  options.filterType = ModeFilter::LowPass;
  options.lastMode = 20;
  EXPECT_TRUE(solver.Update(surface, input, options, {}).warnings.empty());
  options.lastMode = 500;
  EXPECT_EQ(solver.Update(surface, input, options, {}).warnings.size(), 1u);
  EXPECT_EQ(solver.Update(surface, input, options, {}).warnings.size(), 1u);
  options.filterType = ModeFilter::HighPass;
  options.firstMode = 26; // removes all 25 modes, and no other
  EXPECT_EQ(solver.Update(surface, input, options, {}).warnings.size(), 1u);
  options.firstMode = 25;
  EXPECT_TRUE(solver.Update(surface, input, options, {}).warnings.empty());
  options.filterType = ModeFilter::BandPass;
  options.lastMode = 50;
  EXPECT_THROW(solver.Update(surface, input, options, {}), InvalidInput);
  options.firstMode = 10;
  options.lastMode = 5;
  EXPECT_THROW(solver.Update(surface, input, options, {}), InvalidInput);
}

} // namespace
} // namespace gridfem
