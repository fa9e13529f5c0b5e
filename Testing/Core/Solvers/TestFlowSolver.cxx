// The steps of a flow on a surface: made once, continued, and made again with the same bits.
#include "Solvers/FlowSolver.h"

#include "Base/Errors.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

std::shared_ptr<const TriangleMesh> Shared(TriangleMesh mesh)
{
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

std::shared_ptr<const TriangleMesh> TurnedTorus()
{
  return Shared(Transform(Torus(24, 12, 1.0, 0.4), { 1, 2, 0 }, 0.4));
}

SurfaceOptions At(int depth, FunctionKind kind = FunctionKind::Grid)
{
  SurfaceOptions options;
  options.space.depth = depth;
  options.choice.kind = kind;
  return options;
}

FlowSolver::Options Steps(int number, double timeStep = 1e-3)
{
  FlowSolver::Options options;
  options.numberOfSteps = number;
  options.timeStep = timeStep;
  return options;
}

} // namespace

TEST(FlowSolver, ContinuesWithTheBitsOfOneShot)
{
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    Stages stages;
    LocalSurface surface(stages, TurnedTorus(), At(4, kind));
    FlowSolver solver;
    solver.Update(surface, Steps(2), {});
    const auto second = solver.PointsAt(2, surface);
    EXPECT_EQ(solver.Update(surface, Steps(4), {}).steps.size(), 5u);
    EXPECT_EQ(stages.Runs(StepStage), 4);
    std::vector<Vec3> expected;
    FlowSolver::Solve(TurnedTorus(), Steps(4), expected, At(4, kind));
    EXPECT_EQ(solver.PointsAt(4, surface), expected);

    EXPECT_EQ(solver.Update(surface, Steps(2), {}).steps.size(), 3u);
    EXPECT_EQ(solver.PointsAt(2, surface), second);
    EXPECT_EQ(stages.Runs(StepStage), 4);
    solver.Update(surface, Steps(2, 2e-3), {});
    EXPECT_NE(solver.PointsAt(2, surface), second);
    EXPECT_EQ(stages.Runs(StepStage), 6);
    EXPECT_EQ(stages.Runs(SystemStage), 1);
  }
}

TEST(FlowSolver, ShowsAStepWithTheSameBitsWhetherItIsKeptOrNot)
{
  constexpr double OneShape = 1.0; // the last step alone is kept
  for (const bool isTracked : { true, false })
  {
    FlowSolver::Options options = Steps(5, 5e-3);
    options.trackMetric = isTracked;
    Stages stages;
    LocalSurface surface(stages, TurnedTorus(), At(4));
    FlowSolver keeping;
    keeping.Update(surface, options, {});
    Stages otherStages;
    LocalSurface other(otherStages, TurnedTorus(), At(4));
    FlowSolver forgetting(OneShape);
    forgetting.Update(other, options, {});
    for (const int step : { 3, 4, 1, 5, 2, 0, 5 })
    {
      EXPECT_EQ(forgetting.PointsAt(step, other), keeping.PointsAt(step, surface)) << step;
    }
    EXPECT_EQ(stages.Runs(StepStage), 5);
    EXPECT_GT(otherStages.Runs(StepStage), 5);
  }
}

TEST(FlowSolver, ShrinksASphereWithAnErrorThatFallsWithTheSquareOfItsEdges)
{
  constexpr double Step = 0.01;
  double radius = 1.0;
  for (int step = 0; step < 5; ++step)
  {
    radius /= 1.0 + 2.0 * Step / (radius * radius); // the Laplacian of x is -2 x / r²
  }
  SurfaceOptions surface = At(5);
  surface.parameterUnits = ParameterUnits::World;
  FlowSolver::Options options = Steps(5, Step);
  options.equation.solve.tolerance = 1e-6;
  std::vector<double> errors;
  for (const int subdivisions : { 16, 32 })
  {
    std::vector<Vec3> points;
    const auto result =
      FlowSolver::Solve(Shared(GeodesicSphere(subdivisions)), options, points, surface);
    EXPECT_NEAR(result.steps.back().time, 5 * Step, 1e-12);
    EXPECT_TRUE(result.warnings.empty());
    double sum = 0.0;
    for (const Vec3& point : points)
    {
      sum += point.norm();
    }
    errors.push_back(std::abs(sum / static_cast<double>(points.size()) - radius));
  }
  EXPECT_LT(errors[1], 1e-3);
  EXPECT_GT(errors[0] / errors[1], 3.5);
}

TEST(FlowSolver, RefusesOptionsThatContradictEachOther)
{
  Stages stages;
  LocalSurface surface(stages, TurnedTorus(), At(4));
  FlowSolver solver;
  FlowSolver::Options options = Steps(1);
  options.conformalized = true;
  options.trackMetric = false;
  EXPECT_THROW(solver.Update(surface, options, {}), InvalidInput);
  options = Steps(1);
  options.fixedBoundary = true;
  options.rescale = FlowSolver::Rescale::ConstantVolume;
  EXPECT_THROW(solver.Update(surface, options, {}), InvalidInput);
  for (const double timeStep : { 0.0, -1.0, std::nan(""), HUGE_VAL })
  {
    EXPECT_THROW(solver.Update(surface, Steps(1, timeStep), {}), InvalidInput) << timeStep;
  }
}
