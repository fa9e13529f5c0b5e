// The solver against exact decay, and its steps: which of them a change makes again.
#include "EachOption.h"
#include "Meshes.h"
#include "Solvers/DiffusionSolver.h"
#include "Solvers/LocalSurface.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

DiffusionSolver::Input HeightOn(const TriangleMesh& mesh)
{
  DiffusionSolver::Input input;
  input.values = GivenField::Of("z", { FieldAssociation::Points, PointCoordinates(mesh).col(2) });
  return input;
}

SurfaceOptions InWorldUnits(int depth)
{
  SurfaceOptions options = DiffusionSolver::SurfaceDefaults();
  options.space.depth = depth;
  options.parameterUnits = ParameterUnits::World;
  return options;
}

DiffusionSolver::Options For(double time, int steps)
{
  DiffusionSolver::Options options;
  options.equation.solve.tolerance = 1e-10;
  options.equation.accuracy = 0.0;
  options.diffusionTime = time;
  options.numberOfSteps = steps;
  return options;
}

} // namespace

TEST(DiffusionSolver, LetsAHarmonicOfTheSphereDecay)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(40));
  const DiffusionSolver::Result result =
    DiffusionSolver::Solve(mesh, HeightOn(*mesh), For(0.2, 8), InWorldUnits(5));
  ASSERT_EQ(result.steps.size(), 8u);
  EXPECT_NEAR(result.stepLength, 0.025, 1e-12);
  const MultiVector exact = std::exp(-2.0 * 0.2) * PointCoordinates(*mesh).col(2);
  const double error =
    (result.steps.back().atPoints - exact).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  EXPECT_LT(error, 5e-3); // cells of side 0.06: second order
}

/// A constant that is far larger than the variation stays, and the variation spreads as without.
TEST(DiffusionSolver, KeepsTheVariationAboveALargeConstant)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(16));
  const DiffusionSolver::Input plain = HeightOn(*mesh);
  const MultiVector expected =
    DiffusionSolver::Solve(mesh, plain, For(0.5, 2), InWorldUnits(4)).steps.back().atPoints;
  for (const double constant : { 1e6, -1e9, 1e12 })
  {
    Field values = plain.values.read(NaNs::Refused);
    values.values.array() += constant;
    DiffusionSolver::Input input;
    input.values = GivenField::Of("f", values);
    MultiVector found =
      DiffusionSolver::Solve(mesh, input, For(0.5, 2), InWorldUnits(4)).steps.back().atPoints;
    found.array() -= constant;
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
      1e-6 + 4e-16 * std::abs(constant));
  }
}

TEST(DiffusionSolver, MoreStepsOfTheSameLengthGoOnFromTheLast)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(16));
  const DiffusionSolver::Input input = HeightOn(*mesh);
  Stages stages;
  LocalSurface surface(stages, mesh, InWorldUnits(4));
  DiffusionSolver solver;
  solver.Update(surface, input, For(0.25, 2), {});
  EXPECT_EQ(stages.Runs(SolveStage), 2);
  const MultiVector six = solver.Update(surface, input, For(0.75, 6), {}).steps.back().atPoints;
  EXPECT_EQ(stages.Runs(SolveStage), 6);
  EXPECT_EQ(stages.Runs(HierarchyStage), 1);
  const DiffusionSolver::Result fresh =
    DiffusionSolver::Solve(mesh, input, For(0.75, 6), InWorldUnits(4));
  EXPECT_EQ(six, fresh.steps.back().atPoints);
  solver.Update(surface, input, For(0.375, 6), {});
  EXPECT_EQ(stages.Runs(HierarchyStage), 2);
}

TEST(DiffusionSolver, EachOptionChangesTheResultAsInANewSolver)
{
  const auto mesh = std::make_shared<const TriangleMesh>(FlatRectangle(12, 12));
  DiffusionSolver::Input input;
  input.values = GivenField::Of("x", { FieldAssociation::Points, PointCoordinates(*mesh).col(0) });
  const DiffusionSolver::Options options = For(0.02, 2);
  Stages stages;
  LocalSurface surface(stages, mesh, InWorldUnits(4));
  DiffusionSolver solver;
  const auto last = [&](const DiffusionSolver::Options& with)
  {
    return solver.Update(surface, input, with, {})
      .steps.at(static_cast<std::size_t>(with.numberOfSteps) - 1)
      .atPoints;
  };
  const MultiVector first = last(options);
  for (const auto& [name, changed] : EachChanged(options))
  {
    const MultiVector here = last(changed);
    const MultiVector fresh =
      DiffusionSolver::Solve(mesh, input, changed, InWorldUnits(4)).steps.back().atPoints;
    EXPECT_EQ(here, fresh) << name;
    EXPECT_NE(here, first) << name;
    EXPECT_EQ(last(options), first) << name;
  }
}

TEST(DiffusionSolver, RefusesNoTimeAndAnotherNumberOfComponents)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  DiffusionSolver::Input input = HeightOn(*mesh);
  EXPECT_THROW(DiffusionSolver::Solve(mesh, input, For(0.0, 1), InWorldUnits(4)), InvalidInput);
  EXPECT_THROW(DiffusionSolver::Solve(mesh, input, For(-1.0, 1), InWorldUnits(4)), InvalidInput);
  input.source = GivenField::Of("s", { FieldAssociation::Points, PointCoordinates(*mesh) });
  EXPECT_THROW(DiffusionSolver::Solve(mesh, input, For(0.1, 1), InWorldUnits(4)), InvalidInput);
}
