// The solver against an exact solution, and the stages that a change repeats.
#include "EachOption.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/PoissonSolver.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// z at the points of the unit sphere: an eigenfunction for the eigenvalue 2.
Field Height(const TriangleMesh& mesh)
{
  return { FieldAssociation::Points, PointCoordinates(mesh).col(2) };
}

/// An open half of a rotated sphere.
std::shared_ptr<const TriangleMesh> Bowl()
{
  TriangleMesh mesh = Transform(GeodesicSphere(16), { 1, 2, 3 }, 0.3);
  auto& triangles = mesh.triangles;
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                    [&](const std::array<Id, 3>& t) { return mesh.points[t[0]].x() > 0.6; }),
    triangles.end());
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

SurfaceOptions AtDepth(int depth)
{
  SurfaceOptions options;
  options.space.depth = depth;
  return options;
}

PoissonSolver::Options Exactly()
{
  PoissonSolver::Options options;
  options.equation.solve.tolerance = 1e-11;
  options.equation.accuracy = 0.0;
  return options;
}

PoissonSolver::Input InputOn(const TriangleMesh& mesh)
{
  PoissonSolver::Input input;
  Field values = Height(mesh);
  values.values.col(0).array() += PointCoordinates(mesh).col(0).array().square();
  input.values = GivenField::Of("f", std::move(values));
  return input;
}

double Difference(const MultiVector& a, const MultiVector& b)
{
  return (a - b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

} // namespace

TEST(PoissonSolver, DampsAHarmonicOfTheSphereAsTheEquationSays)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(40));
  PoissonSolver::Input input;
  input.values = GivenField::Of("z", Height(*mesh));
  PoissonSolver::Options options = Exactly();
  options.screeningWeight = 6.0;
  SurfaceOptions surface = AtDepth(6);
  surface.parameterUnits = ParameterUnits::World;
  const PoissonSolver::Result result = PoissonSolver::Solve(mesh, input, options, surface);
  const MultiVector exact = 6.0 / (6.0 + 2.0) * Height(*mesh).values;
  // The mesh is a polyhedron of edge 0.04, the cells have a side of 0.03: errors of second order.
  EXPECT_LT(Difference(result.atPoints, exact), 3e-3);
  EXPECT_TRUE(result.report.converged);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(PoissonSolver, EachOptionChangesTheResultAsInANewSolver)
{
  const auto mesh = Bowl();
  const PoissonSolver::Input input = InputOn(*mesh);
  const PoissonSolver::Options options = Exactly();
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth(4));
  PoissonSolver solver;
  const MultiVector first = solver.Update(surface, input, options, {}).atPoints;
  for (const auto& [name, changed] : EachChanged(options))
  {
    PoissonSolver::Options full = changed;
    full.useValueGradient |= name == "GradientScale"; // else the scale has nothing to multiply
    const MultiVector here = solver.Update(surface, input, full, {}).atPoints;
    const MultiVector fresh = PoissonSolver::Solve(mesh, input, full, AtDepth(4)).atPoints;
    // A loose tolerance leaves its own error. All others solve to 1e-11.
    EXPECT_LT(Difference(here, fresh), name == "the equation" ? 0.5 : 1e-7) << name;
    // FillUnknown has nothing to fill here.
    EXPECT_GT(Difference(here, first), name == "FillUnknown" ? -1.0 : 1e-6) << name;
    EXPECT_LT(Difference(solver.Update(surface, input, options, {}).atPoints, first), 1e-7) << name;
  }
}

TEST(PoissonSolver, RepeatsOnlyTheStagesThatAChangeTouches)
{
  const auto mesh = Bowl();
  PoissonSolver::Input input = InputOn(*mesh);
  PoissonSolver::Options options = Exactly();
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth(4));
  PoissonSolver solver;
  const auto runs = [&]
  {
    solver.Update(surface, input, options, {});
    std::vector<std::int64_t> counts;
    for (const char* stage :
      { SpaceStage, SystemStage, RightHandSideStage, HierarchyStage, SolveStage })
    {
      counts.push_back(stages.Runs(stage));
    }
    return counts;
  };
  using Counts = std::vector<std::int64_t>;
  EXPECT_EQ(runs(), (Counts{ 1, 1, 1, 1, 1 }));
  EXPECT_EQ(runs(), (Counts{ 1, 1, 1, 1, 1 }));
  options.screeningWeight = 50.0;
  EXPECT_EQ(runs(), (Counts{ 1, 1, 1, 2, 2 }));
  options.gradientScale = 2.0;
  EXPECT_EQ(runs(), (Counts{ 1, 1, 1, 2, 3 }));
  input.values = GivenField::Of("other", Height(*mesh), 1);
  EXPECT_EQ(runs(), (Counts{ 1, 1, 2, 2, 4 }));
}

TEST(PoissonSolver, HoldsGivenPointsExactly)
{
  const auto mesh = Bowl();
  PoissonSolver::Input input = InputOn(*mesh);
  const std::vector<char> used = UsedPoints(*mesh);
  const Id held = std::find(used.begin(), used.end(), 1) - used.begin();
  input.constraints.property = "ConstraintArray";
  input.constraints.find = [held] {
    return PointValues{ { held }, MultiVector::Constant(1, 1, 5.0) };
  };
  const PoissonSolver::Result result = PoissonSolver::Solve(mesh, input, Exactly(), AtDepth(4));
  EXPECT_NEAR(result.atPoints(held, 0), 5.0, 1e-5);
  EXPECT_TRUE(result.holdsValues);
  EXPECT_LT(result.misfit, 1e-5);
}

TEST(PoissonSolver, AWantedErrorChoosesTheDepth)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(40));
  PoissonSolver::Input input;
  input.values = GivenField::Of("z", Height(*mesh));
  PoissonSolver::Options options;
  options.screeningWeight = 10.0;
  options.wantedError = 0.02;
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth(9)); // which would be far finer
  PoissonSolver solver;
  const PoissonSolver::Result& result = solver.Update(surface, input, options, {});
  EXPECT_TRUE(result.isAccurate);
  EXPECT_LE(result.accuracy.discretization, 0.02);
  EXPECT_LT(surface.UsedOptions().space.depth, 8);
}

TEST(PoissonSolver, RefusesFieldsThatDoNotFit)
{
  const auto mesh = Bowl();
  PoissonSolver::Input input = InputOn(*mesh);
  input.gradients = input.values;
  EXPECT_THROW(PoissonSolver::Solve(mesh, input, {}, AtDepth(4)), InvalidInput);
  input = InputOn(*mesh);
  input.weights = GivenField::Of(
    "w", { FieldAssociation::Points, MultiVector::Ones(input.values.read({}).values.rows(), 2) });
  EXPECT_THROW(PoissonSolver::Solve(mesh, input, {}, AtDepth(4)), InvalidInput);
}
