// The solver against an exact solution, and the stages that a change repeats.
#include "AtDepth.h"
#include "EachOption.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/PoissonSolver.h"
#include "Solvers/SolveWarnings.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

/// Returns a solution with 0 at points that no triangle uses. There it has to be NaN.
MultiVector OnTheSurface(MultiVector atPoints, const TriangleMesh& mesh)
{
  const std::vector<char> used = UsedPoints(mesh);
  for (Id k = 0; k < atPoints.rows(); ++k)
  {
    EXPECT_EQ(atPoints.row(k).array().isNaN().any(), used[k] == 0) << k;
    if (!used[k])
    {
      atPoints.row(k).setZero();
    }
  }
  return atPoints;
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
  const auto solve = [&](const PoissonSolver::Options& own)
  { return OnTheSurface(solver.Update(surface, input, own, {}).atPoints, *mesh); };
  const MultiVector first = solve(options);
  for (const auto& [name, changed] : EachChanged(options))
  {
    PoissonSolver::Options full = changed;
    full.useValueGradient |= name == "GradientScale"; // else the scale has nothing to multiply
    const MultiVector here = solve(full);
    const MultiVector fresh =
      OnTheSurface(PoissonSolver::Solve(mesh, input, full, AtDepth(4)).atPoints, *mesh);
    // A loose tolerance leaves its own error. All others solve to 1e-11.
    EXPECT_LT(Difference(here, fresh), name == "the equation" ? 0.5 : 1e-7) << name;
    // FillUnknown has nothing to fill here.
    EXPECT_GT(Difference(here, first), name == "FillUnknown" ? -1.0 : 1e-6) << name;
    EXPECT_LT(Difference(solve(options), first), 1e-7) << name;
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

/// Values of weight 0 may be anything. Points of weight 1 then count as with unknown values.
TEST(PoissonSolver, ValuesOfWeightZeroHaveNoInfluence)
{
  const auto square =
    std::make_shared<const TriangleMesh>(Transform(FlatRectangle(24, 24), { 1, 2, 3 }, 0.4));
  for (const auto& mesh : { Bowl(), square })
  {
    const MultiVector points = PointCoordinates(*mesh);
    const std::vector<char> used = UsedPoints(*mesh);
    MultiVector f = (4.0 * points.col(0)).array().sin();
    MultiVector weight(points.rows(), 1);
    for (Id k = 0; k < weight.rows(); ++k)
    {
      f(k, 0) *= used[k]; // OnTheSurface is 0 there
      weight(k, 0) = (points.row(k) - points.row(points.rows() / 2)).norm() < 0.25 ? 0.0 : 1.0;
    }
    PoissonSolver::Options options = Exactly();
    options.screeningWeight = 1e4;
    const auto solveWith = [&](double filler, bool isWeighted)
    {
      MultiVector filled = f;
      for (Id k = 0; k < f.rows(); ++k)
      {
        filled(k, 0) = weight(k, 0) == 0.0 ? filler : f(k, 0);
      }
      PoissonSolver::Input input;
      input.values = GivenField::Of("f", { FieldAssociation::Points, filled });
      if (isWeighted)
      {
        input.weights = GivenField::Of("w", { FieldAssociation::Points, weight });
      }
      PoissonSolver::Options own = options;
      own.fillUnknown = !isWeighted;
      return OnTheSurface(PoissonSolver::Solve(mesh, input, own, AtDepth(5)).atPoints, *mesh);
    };
    const MultiVector zero = solveWith(0.0, true);
    EXPECT_LT(Difference((zero - f).cwiseProduct(weight), 0.0 * f), 0.15); // the range is 2
    for (const double filler : { -9999.0, 1e30, std::nan("") })
    {
      EXPECT_EQ(solveWith(filler, true), zero) << filler;
    }
    EXPECT_LT(Difference(solveWith(std::nan(""), false), zero), 1e-7);
  }
}

/// A point of weight 1 counts even if all points around it have weight 0.
TEST(PoissonSolver, ASingleWeighedPointHoldsTheSurface)
{
  const auto mesh = Bowl();
  const MultiVector points = PointCoordinates(*mesh);
  const std::vector<char> used = UsedPoints(*mesh);
  const Id first = std::find(used.begin(), used.end(), 1) - used.begin();
  MultiVector f = MultiVector::Constant(points.rows(), 1, 1e30);
  MultiVector weight = MultiVector::Zero(points.rows(), 1);
  f(first, 0) = 5.0;
  weight(first, 0) = 1.0;
  PoissonSolver::Input input;
  input.values = GivenField::Of("f", { FieldAssociation::Points, f });
  input.weights = GivenField::Of("w", { FieldAssociation::Points, weight });
  const PoissonSolver::Result result = PoissonSolver::Solve(mesh, input, Exactly(), AtDepth(4));
  for (Id k = 0; k < points.rows(); ++k)
  {
    ASSERT_TRUE(!used[k] || std::abs(result.atPoints(k, 0) - 5.0) < 1e-6) << k;
  }
  EXPECT_TRUE(result.warnings.empty());
}

TEST(PoissonSolver, RefusesNaNWhereItCounts)
{
  const auto mesh = Bowl();
  PoissonSolver::Input input = InputOn(*mesh);
  Field values = input.values.read(NaNs::Refused);
  const Id point = mesh->triangles[7][1];
  values.values(point, 0) = std::nan("");
  input.values = GivenField::Of("f", values);
  MultiVector weight = MultiVector::Ones(values.values.rows(), 1);
  input.weights = GivenField::Of("w", { FieldAssociation::Points, weight });
  EXPECT_THROW(PoissonSolver::Solve(mesh, input, Exactly(), AtDepth(4)), InvalidInput);
  weight(point, 0) = 0.0;
  input.weights = GivenField::Of("w", { FieldAssociation::Points, weight });
  const PoissonSolver::Result result = PoissonSolver::Solve(mesh, input, Exactly(), AtDepth(4));
  OnTheSurface(result.atPoints, *mesh);
}

/// Weights may have any size if all are equal. Far larger weights than the others are refused,
/// because the rest of the solution would be lost.
TEST(PoissonSolver, HugeWeightsAreRightOrRefused)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(16));
  const MultiVector z = Height(*mesh).values;
  PoissonSolver::Input input;
  input.values = GivenField::Of("z", Height(*mesh));
  SurfaceOptions hats = AtDepth(4);
  hats.choice.kind = FunctionKind::Hats;
  for (const double huge : { 1e20, 1e100 })
  {
    PoissonSolver::Options options;
    options.screeningWeight = huge;
    EXPECT_LT(Difference(PoissonSolver::Solve(mesh, input, options, hats).atPoints, z), 1e-8);
    PoissonSolver::Input weighted = input;
    MultiVector weight = MultiVector::Constant(z.rows(), 1, huge);
    weighted.weights = GivenField::Of("w", { FieldAssociation::Points, weight });
    EXPECT_LT(Difference(PoissonSolver::Solve(mesh, weighted, {}, hats).atPoints, z), 1e-8);
    for (const double other : { 0.0, 1.0 })
    {
      weight.topRows(z.rows() / 2).setConstant(other);
      weighted.weights = GivenField::Of("w", { FieldAssociation::Points, weight });
      EXPECT_THROW(PoissonSolver::Solve(mesh, weighted, {}, hats), InvalidInput);
    }
  }
}

/// A constant that is far larger than the variation is added to the solution and changes nothing.
TEST(PoissonSolver, KeepsTheVariationAboveALargeConstant)
{
  const auto mesh = Bowl();
  PoissonSolver::Options options = Exactly();
  options.screeningWeight = 6.0;
  const PoissonSolver::Input plain = InputOn(*mesh);
  const std::vector<char> used = UsedPoints(*mesh);
  for (const bool isConstrained : { false, true })
  {
    options.boundaryValues = isConstrained;
    const MultiVector expected = PoissonSolver::Solve(mesh, plain, options, AtDepth(4)).atPoints;
    for (const double constant : { 1e6, -1e9, 1e12 })
    {
      Field values = plain.values.read(NaNs::Refused);
      values.values.array() += constant;
      PoissonSolver::Input input;
      input.values = GivenField::Of("f", values);
      const MultiVector found = PoissonSolver::Solve(mesh, input, options, AtDepth(4)).atPoints;
      for (Id k = 0; k < found.rows(); ++k)
      {
        ASSERT_TRUE(!used[k] || std::abs(found(k, 0) - constant - expected(k, 0)) <
                                  1e-6 + 4e-16 * std::abs(constant))
          << constant << " " << k;
      }
    }
  }
}

TEST(PoissonSolver, WarnsOfAFluxOnlyWhileThereIsOne)
{
  const auto mesh = Bowl();
  PoissonSolver::Input input = InputOn(*mesh);
  PoissonSolver::Options options = Exactly();
  options.screeningWeight = 0.0;
  options.fillUnknown = true;
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth(4));
  PoissonSolver solver;
  const auto warnings = [&]
  {
    const std::vector<std::string> found = solver.Update(surface, input, options, {}).warnings;
    EXPECT_EQ(found, PoissonSolver::Solve(mesh, input, options, AtDepth(4)).warnings);
    return Joined(found);
  };
  const MultiVector one = MultiVector::Ones(static_cast<Id>(mesh->points.size()), 1);
  input.flux = GivenField::Of("flux", { FieldAssociation::Points, one }, 1);
  EXPECT_NE(warnings().find("does not add up to 0"), std::string::npos);
  input.flux = {};
  EXPECT_EQ(warnings().find("flux"), std::string::npos);
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

/// Two levels cannot confirm an error. One that is not trusted may be eight times larger.
TEST(PoissonSolver, AWantedErrorOnHatsNeedsAMarginWhereNothingConfirmsIt)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  PoissonSolver::Input input;
  input.values = GivenField::Of("z", Height(*mesh));
  SurfaceOptions hats;
  hats.choice.kind = FunctionKind::Hats;
  PoissonSolver::Options options;
  options.screeningWeight = 10.0;
  const double error = PoissonSolver::Solve(mesh, input, options, hats).accuracy.discretization;
  for (const double margin : { 1.1, 7.0, 9.0 })
  {
    options.wantedError = margin * error;
    const PoissonSolver::Result result = PoissonSolver::Solve(mesh, input, options, hats);
    EXPECT_FALSE(result.accuracy.isTrusted);
    EXPECT_EQ(result.isAccurate, margin > 8.0) << margin;
    EXPECT_EQ(result.warnings.size(), margin > 8.0 ? 0u : 1u) << margin;
    EXPECT_EQ(Joined(result.warnings).find("coarser grids do not confirm it") != std::string::npos,
      margin < 8.0);
  }
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
