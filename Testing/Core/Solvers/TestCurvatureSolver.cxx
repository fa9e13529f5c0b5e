// Curvatures of a surface, which need functions only where normals are smoothed.
#include "Solvers/CurvatureSolver.h"

#include "AtDepth.h"
#include "Base/Errors.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

std::shared_ptr<const TriangleMesh> Sphere(double radius)
{
  return std::make_shared<const TriangleMesh>(GeodesicSphere(12, radius));
}

const SurfaceOptions AtDepth4 = AtDepth<CurvatureSolver>(4);

} // namespace

TEST(CurvatureSolver, KnowsTheCurvaturesOfASphere)
{
  constexpr double Radius = 20.0;
  const double expected[] = { 1.0 / Radius, 1.0 / Radius, 1.0 / Radius, 1.0 / Radius / Radius, 1.0,
    0.5 };
  for (const double scale : { 0.0, 0.05 })
  {
    CurvatureSolver::Options options;
    options.smoothingScale = scale;
    const auto result =
      CurvatureSolver::Solve(Sphere(Radius), options, AtDepth<CurvatureSolver>(5));
    ASSERT_EQ(result.numbers.cols(), static_cast<Id>(CurvatureSolver::Numbers.size()));
    for (Id column = 0; column < result.numbers.cols(); ++column)
    {
      const double error = (result.numbers.col(column).array() - expected[column])
                             .abs()
                             .maxCoeff<Eigen::PropagateNaN>();
      EXPECT_LT(error, 0.02 * expected[column]) << CurvatureSolver::Numbers[column] << " " << scale;
    }
    EXPECT_EQ(result.isSmoothed, scale > 0.0);
    EXPECT_TRUE(result.warnings.empty());
  }
}

/// Most points are not on the surface, as with a mask. They change no value on it.
TEST(CurvatureSolver, PointsOffTheSurfaceCountInNothing)
{
  TriangleMesh mesh = GeodesicSphere(12);
  const auto onSurface = static_cast<Id>(mesh.points.size());
  const MultiVector alone =
    CurvatureSolver::Solve(std::make_shared<const TriangleMesh>(mesh), {}, AtDepth4).numbers;
  mesh.points.resize(3 * mesh.points.size(), Vec3(0.1, 0.2, 0.3));
  const MultiVector numbers =
    CurvatureSolver::Solve(std::make_shared<const TriangleMesh>(mesh), {}, AtDepth4).numbers;
  EXPECT_EQ(numbers.topRows(onSurface), alone);
  EXPECT_TRUE(numbers.bottomRows(numbers.rows() - onSurface).array().isNaN().all());
}

TEST(CurvatureSolver, FitsAgainOnlyAfterAChangeThatCounts)
{
  Stages stages;
  LocalSurface surface(stages, Sphere(1.0), AtDepth4);
  CurvatureSolver solver;
  CurvatureSolver::Options options;
  solver.Update(surface, options, {});
  options.equation.solve.tolerance = 1e-5; // of a smoothing that does not take place
  solver.Update(surface, options, {});
  EXPECT_EQ(stages.Runs(SolveStage), 1);
  EXPECT_EQ(stages.Runs(SpaceStage), 0);

  for (const double scale : { 0.1, 0.2, 0.2 })
  {
    options.smoothingScale = scale;
    solver.Update(surface, options, {});
  }
  EXPECT_EQ(stages.Runs(SolveStage), 3);
  EXPECT_EQ(stages.Runs(SystemStage), 1);
  const MultiVector oneShot = CurvatureSolver::Solve(Sphere(1.0), options, AtDepth4).numbers;
  EXPECT_EQ(solver.Update(surface, options, {}).numbers, oneShot);
}

TEST(CurvatureSolver, RefusesANegativeScaleAndWarnsOfAnEarlyEnd)
{
  CurvatureSolver::Options options;
  options.smoothingScale = -1.0;
  EXPECT_THROW(CurvatureSolver::Solve(Sphere(1.0), options, AtDepth4), InvalidInput);
  options.smoothingScale = 0.5;
  options.equation.solve.tolerance = 1e-12;
  options.equation.solve.maximumIterations = 1;
  EXPECT_EQ(CurvatureSolver::Solve(Sphere(1.0), options, AtDepth4).warnings.size(), 1u);
}
