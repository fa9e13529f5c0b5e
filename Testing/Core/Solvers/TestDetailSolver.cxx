// Detail of a surface: the effect of scales, and the stages that a change of an option repeats.
#include "EachOption.h"
#include "Largest.h"
#include "Meshes.h"
#include "Solvers/DetailSolver.h"
#include "Solvers/LocalSurface.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A closed surface with curvatures of both signs.
std::shared_ptr<const TriangleMesh> Ring()
{
  return std::make_shared<const TriangleMesh>(Transform(Torus(24, 12, 1.0, 0.4), { 1, 2, 3 }, 0.3));
}

/// A selection of the half with x > 0, and a curve for Custom.
DetailSolver::Input HalfSelected(const TriangleMesh& mesh)
{
  DetailSolver::Input input;
  input.hasSelection = true;
  for (const Vec3& point : mesh.points)
  {
    input.selected.push_back(point.x() > 0.0 ? 1 : 0);
  }
  input.custom = [](double curvature) { return std::min(std::abs(curvature), 1.0); };
  return input;
}

SurfaceOptions Coarse()
{
  SurfaceOptions options = DetailSolver::SurfaceDefaults();
  options.space.depth = 4;
  return options;
}

DetailSolver::Options ByCurvature()
{
  DetailSolver::Options options;
  options.equation.solve.tolerance = 1e-11;
  options.transferFunction = CurvatureTransfer::LargeAbsolute;
  options.outsideScale = 0.7;
  options.transitionWidth = 0.1;
  return options;
}

double LargestMove(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
  double largest = 0.0;
  for (std::size_t point = 0; point < a.size(); ++point)
  {
    largest = Larger(largest, (a[point] - b[point]).norm());
  }
  return largest;
}

} // namespace

TEST(DetailSolver, AScaleOfOneChangesNothing)
{
  const auto mesh = Ring();
  DetailSolver::Options options;
  options.detailScale = 1.0;
  const DetailSolver::Result result = DetailSolver::Solve(mesh, {}, options, Coarse());
  EXPECT_LT(LargestMove(result.points, mesh->points), 1e-12);
}

TEST(DetailSolver, AnArrayOfOnesChangesNothingInAnyMetricAndSpace)
{
  const auto mesh = Ring();
  DetailSolver::Input input;
  input.scale = GivenField::Of("ones",
    { FieldAssociation::Points, MultiVector::Ones(static_cast<Id>(mesh->points.size()), 1) });
  DetailSolver::Options options = ByCurvature();
  options.detailScale = 1.0;
  for (const FunctionKind kind :
    { FunctionKind::Grid, FunctionKind::Hats, FunctionKind::SmoothGrid })
  {
    SurfaceOptions surface = Coarse();
    surface.choice.kind = kind;
    const DetailSolver::Result result = DetailSolver::Solve(mesh, input, options, surface);
    EXPECT_LT(LargestMove(result.points, mesh->points), 1e-8) << static_cast<int>(kind);
  }
}

/// A point that no triangle uses is at rest, whatever happens to the surface.
TEST(DetailSolver, KeepingTheVolumeMovesNoPointOffTheSurface)
{
  TriangleMesh mesh = *Ring();
  const Vec3 apart(3.0, 2.0, 1.0);
  mesh.points.push_back(apart);
  DetailSolver::Options options;
  options.detailScale = 0.0;
  options.keepVolume = true;
  const auto given = std::make_shared<const TriangleMesh>(mesh);
  const std::vector<Vec3> points = DetailSolver::Solve(given, {}, options, Coarse()).points;
  EXPECT_EQ(points.back(), apart);
  EXPECT_GT(LargestMove(points, mesh.points), 0.01);
}

/// Transfer functions of signed curvatures, and the volume that is kept. On the grid, the clip cuts
/// pieces otherwise, and integrals have another error.
TEST(DetailSolver, TheOrientationOfTrianglesChangesNothing)
{
  const auto mesh = Ring();
  const auto mixed = std::make_shared<const TriangleMesh>(TurnSome(*mesh, 0.4, 1));
  DetailSolver::Options options = ByCurvature();
  options.detailScale = 3.0;
  options.keepVolume = true;
  for (const auto& [transfer, kind, tolerance] :
    { std::make_tuple(CurvatureTransfer::LargePositive, FunctionKind::Hats, 1e-12),
      std::make_tuple(CurvatureTransfer::LargeNegative, FunctionKind::Hats, 1e-12),
      std::make_tuple(CurvatureTransfer::LargePositive, FunctionKind::Grid, 1e-3) })
  {
    SurfaceOptions surface = Coarse();
    surface.choice.kind = kind;
    options.transferFunction = transfer;
    const auto solve = [&](const std::shared_ptr<const TriangleMesh>& given)
    { return DetailSolver::Solve(given, HalfSelected(*mesh), options, surface).points; };
    const std::vector<Vec3> points = solve(mesh);
    EXPECT_GT(LargestMove(points, mesh->points), 0.005);
    EXPECT_LT(LargestMove(solve(mixed), points), tolerance);
  }
}

TEST(DetailSolver, AnIterationThatEndedEarlyIsNeitherHiddenNorKept)
{
  const auto mesh = Ring();
  DetailSolver::Input input;
  MultiVector values(static_cast<Id>(mesh->points.size()), 1);
  for (Id point = 0; point < values.rows(); ++point)
  {
    values(point, 0) = std::sin(5.0 * mesh->points[point][0]);
  }
  input.values = GivenField::Of("f", { FieldAssociation::Points, values });
  DetailSolver::Options options = ByCurvature();
  options.smoothingScale = 0.05;
  options.equation.solve.tolerance = 1e-10;
  options.equation.solve.maximumIterations = 200;
  const MultiVector right = DetailSolver::Solve(mesh, input, options, Coarse()).change;
  DetailSolver::Options early = options;
  early.equation.solve.maximumIterations = 1;
  Stages stages;
  LocalSurface surface(stages, mesh, Coarse());
  DetailSolver solver;
  EXPECT_FALSE(solver.Update(surface, input, early, {}).report.converged);
  const DetailSolver::Result& result = solver.Update(surface, input, options, {});
  EXPECT_TRUE(result.report.converged);
  const double apart = (result.change - right).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  EXPECT_LT(apart, 1e-7);
}

TEST(DetailSolver, AScaleOfZeroMakesASphereSmallerAsTheEquationSays)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(32));
  DetailSolver::Options options;
  options.equation.solve.tolerance = 1e-10;
  options.detailScale = 0.0;
  options.screeningWeight = 6.0;
  SurfaceOptions surface = Coarse();
  surface.space.depth = 5;
  surface.parameterUnits = ParameterUnits::World;
  const DetailSolver::Result result = DetailSolver::Solve(mesh, {}, options, surface);
  for (const Vec3& point : result.points)
  {
    EXPECT_NEAR(point.norm(), 6.0 / (6.0 + 2.0), 5e-3); // coordinates have the eigenvalue 2
  }
}

TEST(DetailSolver, AnArrayIsScaledAsTheCoordinatesAre)
{
  const auto mesh = Ring();
  DetailSolver::Options options;
  options.equation.solve.tolerance = 1e-10;
  SurfaceOptions surface = Coarse();
  surface.choice.normalStabilization = 1e-12; // more would flatten an array, not the coordinates
  const DetailSolver::Result shape = DetailSolver::Solve(mesh, {}, options, surface);
  DetailSolver::Input input;
  input.values = GivenField::Of("xyz", { FieldAssociation::Points, PointCoordinates(*mesh) });
  const DetailSolver::Result array = DetailSolver::Solve(mesh, input, options, surface);
  EXPECT_TRUE(array.points.empty());
  const double difference =
    (array.change - shape.change).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  EXPECT_LT(difference, 1e-6);
}

TEST(DetailSolver, PointsOutsideTheSelectionAndItsTransitionStay)
{
  const auto mesh = Ring();
  const DetailSolver::Input input = HalfSelected(*mesh);
  DetailSolver::Options options = ByCurvature();
  options.outsideScale = 1.0;
  for (const double width : { 0.0, 0.1 })
  {
    options.transitionWidth = width;
    const DetailSolver::Result result = DetailSolver::Solve(mesh, input, options, Coarse());
    double inside = 0.0;
    for (Id point = 0; point < result.change.rows(); ++point)
    {
      const double move = result.change.row(point).norm();
      inside = Larger(inside, move);
      EXPECT_TRUE(result.selected(point, 0) > 0.0 || move == 0.0) << point;
    }
    EXPECT_GT(inside, 1e-3);
  }
}

TEST(DetailSolver, EachOptionChangesTheResultAsInANewSolver)
{
  const auto mesh = Ring();
  const DetailSolver::Input input = HalfSelected(*mesh);
  const DetailSolver::Options options = ByCurvature();
  Stages stages;
  LocalSurface surface(stages, mesh, Coarse());
  DetailSolver solver;
  const std::vector<Vec3> first = solver.Update(surface, input, options, {}).points;
  for (const auto& [name, changed] : EachChanged(options))
  {
    const std::vector<Vec3> here = solver.Update(surface, input, changed, {}).points;
    const std::vector<Vec3> fresh = DetailSolver::Solve(mesh, input, changed, Coarse()).points;
    EXPECT_LT(LargestMove(here, fresh), name == "the equation" ? 0.5 : 1e-7) << name;
    EXPECT_GT(LargestMove(here, first), name == "the equation" ? -1.0 : 1e-6) << name;
    EXPECT_LT(LargestMove(solver.Update(surface, input, options, {}).points, first), 1e-7) << name;
  }
}

TEST(DetailSolver, AChangeOfTheScalesSolvesNothingAgain)
{
  const auto mesh = Ring();
  const DetailSolver::Input input = HalfSelected(*mesh);
  DetailSolver::Options options = ByCurvature();
  Stages stages;
  LocalSurface surface(stages, mesh, Coarse());
  DetailSolver solver;
  solver.Update(surface, input, options, {});
  options.detailScale = 5.0;
  options.outsideScale = 0.0;
  solver.Update(surface, input, options, {});
  EXPECT_EQ(stages.Runs(SolveStage), 1);
  options.anisotropy = 2.0;
  solver.Update(surface, input, options, {});
  EXPECT_EQ(stages.Runs("Metric"), 1);
  EXPECT_EQ(stages.Runs("Weights"), 2);
  EXPECT_EQ(stages.Runs(SolveStage), 2);
}
