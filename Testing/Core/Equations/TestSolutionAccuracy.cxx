// Estimated errors against true errors. The true error of the space comes from a grid two levels
// finer. The true error of the iteration comes from the solution of the discrete equations.
#include "Equations/Poisson.h"

#include "Equations/EdgeConditions.h"
#include "Equations/PointConstraints.h"
#include "Equations/SolutionAccuracy.h"
#include "Grid/SurfaceEdges.h"
#include "PointAreas.h"
#include "Spaces.h"
#include "Spaces/HatSpace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

struct Data
{
  const char* name;
  bool isSmooth;
  std::function<double(const Vec3&)> at;
};

const std::vector<Data>& AllData()
{
  static const std::vector<Data> all = {
    { "smooth", true,
      [](const Vec3& p) { return std::sin(2 * p[0] + 1) * std::cos(p[1]) + p[2]; } },
    { "waves", false, [](const Vec3& p) { return std::sin(12 * p[0] + 9 * p[1] * p[2]); } },
    { "steps", false, [](const Vec3& p) { return std::sin(7 * p[0] - 5 * p[2]) > 0 ? 1.0 : -1.0; } }
  };
  return all;
}

MultiVector AtPoints(const TriangleMesh& mesh, const Data& data)
{
  MultiVector f(static_cast<Id>(mesh.points.size()), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    f(static_cast<Id>(i), 0) = data.at(mesh.points[i]);
  }
  return f;
}

/// One equation on one space. Without values, it is the equation of their gradients.
struct Equation
{
  Equation(const FiniteElementSpace& onSpace, double lambda)
    : space(onSpace), weight(lambda * std::pow(onSpace.UnitLength(), 2)),
      multigrid(BuildMultigrid(onSpace, weight, 1.0, {}))
  {
  }

  PoissonSolution Solve(const Field& f, double accuracy, double tolerance) const
  {
    PoissonOptions options;
    options.screeningWeight = weight;
    options.accuracy = accuracy;
    options.solve.tolerance = tolerance;
    options.solve.maximumIterations = 500;
    const MultiVector gradients =
      weight > 0.0 ? MultiVector() : space.LoadOfGradientsOf(f, nullptr);
    return SolvePoisson(space, multigrid, space.LoadOfValues(f), gradients, options);
  }

  const FiniteElementSpace& space;
  double weight;
  Multigrid multigrid;
};

/// Estimates of the default solve of an equation and the true errors, over the points of a mesh.
struct Comparison
{
  Comparison(const TriangleMesh& mesh, const FiniteElementSpace& space, const MultiVector& f,
    double lambda, const MultiVector& truth)
  {
    const Field field{ FieldAssociation::Points, f };
    const Equation equation(space, lambda);
    const PoissonSolution solution = equation.Solve(field, 0.1, 1e-9);
    const PoissonSolution discrete = equation.Solve(field, 0.0, 1e-12);
    report = solution.report;
    said = solution.accuracy;
    const Eigen::VectorXd area = AreasOfPoints(mesh);
    const auto norm = [&](const MultiVector& u)
    { return std::sqrt(area.dot(u.col(0).cwiseAbs2())); };
    const MultiVector values = space.ValuesAtPoints(solution.coefficients);
    const MultiVector exact = space.ValuesAtPoints(discrete.coefficients);
    const double mean = area.dot(truth.col(0)) / area.sum();
    const double size = norm(truth.array() - mean);
    discretization = norm(exact - truth) / size;
    algebraic = norm(values - exact) / size;
    total = norm(values - truth) / size;
    largest = (exact - truth).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  }

  SolveReport report;
  SolutionAccuracy said;
  double discretization;
  double algebraic;
  double total;
  double largest;
};

GridSpace GridOf(
  const TriangleMesh& mesh, int depth, double normalStabilization = DefaultNormalStabilization)
{
  GridSpaceOptions options;
  options.normalStabilization = normalStabilization;
  options.functions.depth = depth;
  options.coarsestSize = 64;
  return BuildGridSpace(mesh, options);
}

void ExpectRightEstimates(const Comparison& c, bool isSmooth)
{
  EXPECT_TRUE(c.report.converged);
  EXPECT_LE(c.report.iterations, 5);
  EXPECT_LT(c.total, 1.1 * c.discretization);
  const double errors = c.said.discretization / c.discretization;
  EXPECT_GT(errors, isSmooth ? 0.5 : 0.3); // steps on the finer grid have errors of their own
  EXPECT_LT(errors, isSmooth ? 2.0 : 3.0);
  const double left = c.said.algebraic / c.algebraic;
  EXPECT_GT(left, 0.1);
  EXPECT_LT(left, 12.0);
}

} // namespace

TEST(SolutionAccuracy, IsKnownOnGrids)
{
  const std::vector<std::pair<const char*, TriangleMesh>> meshes = {
    { "sphere", Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.5) },
    { "torus", Transform(Torus(120, 50, 1.0, 0.4), { 1, 0, 1 }, 0.3) },
    { "plane", Transform(FlatRectangle(60, 50, 2.0, 1.5), { 1, 1, 0 }, 0.7) },
    { "cube", Transform(Box(24), { 1, 2, 1 }, 0.4) }
  };
  for (const auto& [name, mesh] : meshes)
  {
    const GridSpace space = GridOf(mesh, 4);
    const GridSpace finer = GridOf(mesh, 6, 1e-2); // a sixteenth of the error, in few steps
    for (const Data& data : AllData())
    {
      const MultiVector f = AtPoints(mesh, data);
      for (const double lambda : { 0.0, 1.0, 100.0, 1e4, 1e6 })
      {
        SCOPED_TRACE(std::string(name) + ", " + data.name + ", " + std::to_string(lambda));
        const MultiVector truth = finer.ValuesAtPoints(
          Equation(finer, lambda).Solve({ FieldAssociation::Points, f }, 0.0, 1e-9).coefficients);
        const Comparison c(mesh, space, f, lambda, truth);
        ExpectRightEstimates(c, data.isSmooth);
      }
    }
  }
}

namespace
{

using Hold = std::function<HeldValues(const FiniteElementSpace&)>;

struct HeldCase
{
  const char* name;
  TriangleMesh mesh;
  Hold hold;
};

/// Holds the values of the first data at some points.
Hold HoldAt(const TriangleMesh& mesh, std::vector<Id> points)
{
  MultiVector values(static_cast<Id>(points.size()), 1);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    values(static_cast<Id>(k), 0) = AllData()[0].at(mesh.points[points[k]]);
  }
  return [points = std::move(points), values](const FiniteElementSpace& space)
  { return HoldPoints(space, points, values); };
}

Hold HoldEvery(const TriangleMesh& mesh, Id stride)
{
  std::vector<Id> points;
  for (Id point = 0; point < static_cast<Id>(mesh.points.size()); point += stride)
  {
    points.push_back(point);
  }
  return HoldAt(mesh, std::move(points));
}

Hold HoldBoundary(const TriangleMesh& mesh)
{
  return [mesh](const FiniteElementSpace& space)
  {
    return HoldEdges(
      space, mesh, FindSurfaceEdges(mesh, true).boundary, AtPoints(mesh, AllData()[0]));
  };
}

ConstrainedSolution SolveHeld(
  const FiniteElementSpace& space, const HeldCase& held, double lambda, double tolerance)
{
  const double weight = lambda * std::pow(space.UnitLength(), 2);
  const HeldValues values = held.hold(space);
  ConstraintOptions constraints;
  constraints.estimateOn = &space;
  SolveOptions solve;
  solve.tolerance = tolerance;
  solve.maximumIterations = 500;
  const ConstrainedHierarchy hierarchy(space, weight, 1.0, values.rows, constraints.penalty, {});
  const Field f{ FieldAssociation::Points, AtPoints(held.mesh, AllData()[0]) };
  return SolveConstrained(
    space, weight, hierarchy, weight * space.LoadOfValues(f), values.values, constraints, solve);
}

} // namespace

TEST(SolutionAccuracy, IsKnownWhereValuesAreHeld)
{
  const TriangleMesh plane = Transform(FlatRectangle(60, 50, 2.0, 1.5), { 1, 1, 0 }, 0.7);
  const TriangleMesh sphere = Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.5);
  const TriangleMesh torus = Transform(Torus(120, 50, 1.0, 0.4), { 1, 0, 1 }, 0.3);
  const TriangleMesh cube = Transform(Box(24), { 1, 2, 1 }, 0.4);
  const std::vector<HeldCase> cases = { { "plane, boundary", plane, HoldBoundary(plane) },
    { "plane, points", plane, HoldEvery(plane, 37) },
    { "sphere, points", sphere, HoldEvery(sphere, 37) },
    { "sphere, three points", sphere, HoldAt(sphere, { 5, 3000, 6000 }) },
    { "torus, points", torus, HoldEvery(torus, 37) },
    { "cube, three points", cube, HoldAt(cube, { 5, 1700, 3400 }) } };
  for (const HeldCase& held : cases)
  {
    const GridSpace space = GridOf(held.mesh, 4);
    const GridSpace finer = GridOf(held.mesh, 6, 1e-2);
    for (const double lambda : { 0.0, 100.0 })
    {
      SCOPED_TRACE(std::string(held.name) + ", " + std::to_string(lambda));
      const ConstrainedSolution solution = SolveHeld(space, held, lambda, 1e-6);
      const MultiVector truth =
        finer.ValuesAtPoints(SolveHeld(finer, held, lambda, 1e-9).coefficients);
      const MultiVector values = space.ValuesAtPoints(solution.coefficients);
      const Eigen::VectorXd area = AreasOfPoints(held.mesh);
      const auto norm = [&](const MultiVector& u)
      { return std::sqrt(area.dot(u.col(0).cwiseAbs2())); };
      const double mean = area.dot(truth.col(0)) / area.sum();
      const double ratio =
        solution.accuracy.discretization / (norm(values - truth) / norm(truth.array() - mean));
      EXPECT_TRUE(solution.report.converged);
      // Harmonic functions have unbounded peaks at isolated points.
      EXPECT_GT(ratio, lambda > 0.0 ? 0.33 : 0.2);
      EXPECT_LT(ratio, solution.accuracy.isTrusted ? 2.5 : 8.0);
      EXPECT_LT(solution.accuracy.algebraic, 1e-2 * solution.accuracy.discretization);
    }
  }
}

TEST(SolutionAccuracy, OfHeldValuesKnowsAHarmonicFunction)
{
  // The boundary determines the solution. Errors are errors of the space, and fall by four from
  // depth to depth.
  TriangleMesh mesh = FlatRectangle(60, 50, 2.0, 1.5);
  MultiVector exact(static_cast<Id>(mesh.points.size()), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3& p = mesh.points[i];
    exact(static_cast<Id>(i), 0) = std::exp(p[0]) * std::cos(p[1]);
  }
  mesh = Transform(mesh, { 1, 1, 0 }, 0.7);
  const Eigen::VectorXd area = AreasOfPoints(mesh);
  const auto norm = [&](const MultiVector& u) { return std::sqrt(area.dot(u.col(0).cwiseAbs2())); };
  const double mean = area.dot(exact.col(0)) / area.sum();
  double coarser = 0.0;
  for (const int depth : { 4, 5 })
  {
    SCOPED_TRACE(depth);
    const HeldCase held{ "", mesh,
      [&](const FiniteElementSpace& space)
      { return HoldEdges(space, mesh, FindSurfaceEdges(mesh, true).boundary, exact); } };
    const GridSpace space = GridOf(mesh, depth);
    const ConstrainedSolution solution = SolveHeld(space, held, 0.0, 1e-8);
    const double error =
      norm(space.ValuesAtPoints(solution.coefficients) - exact) / norm(exact.array() - mean);
    EXPECT_TRUE(solution.accuracy.isTrusted);
    EXPECT_GT(solution.accuracy.discretization, error / 2.0);
    EXPECT_LT(solution.accuracy.discretization, 3.0 * error);
    EXPECT_LT(solution.accuracy.discretization, coarser > 0.0 ? coarser / 3.0 : 0.1);
    coarser = solution.accuracy.discretization;
  }
}

TEST(SolutionAccuracy, IsKnownOnHats)
{
  // A linear function is the same on all subdivisions of a mesh, so their solutions can be
  // compared.
  const Data linear{ "linear", true, [](const Vec3& p) { return p[0] + 0.5 * p[1] - 0.2 * p[2]; } };
  for (const TriangleMesh& mesh :
    { GeodesicSphere(16), Transform(Torus(60, 24, 1.0, 0.4), { 1, 0, 1 }, 0.3) })
  {
    const TriangleMesh fineMesh = SubdivideInPlane(SubdivideInPlane(mesh));
    for (const double lambda : { 0.1, 10.0 })
    {
      for (const int depth : { 3, 4, 5 })
      {
        SCOPED_TRACE(std::to_string(lambda) + ", depth " + std::to_string(depth));
        GridSpaceOptions options;
        options.functions.depth = depth;
        options.coarsestSize = 64;
        const HatSpace space = BuildHatSpace(mesh, options);
        const HatSpace finer = BuildHatSpace(fineMesh, options);
        const MultiVector truth =
          finer
            .ValuesAtPoints(
              Equation(finer, lambda)
                .Solve({ FieldAssociation::Points, AtPoints(fineMesh, linear) }, 0.0, 1e-10)
                .coefficients)
            .topRows(static_cast<Id>(mesh.points.size()));
        const Comparison c(mesh, space, AtPoints(mesh, linear), lambda, truth);
        EXPECT_LT(c.total, 1.1 * c.discretization);
      }
    }
  }
}

TEST(SolutionAccuracy, IsRelativeToTheWholeSurface)
{
  // Two spheres apart, on which a linear function has two means. It varies more between the spheres
  // than on them.
  const TriangleMesh mesh =
    Join(GeodesicSphere(20), Transform(GeodesicSphere(20), { 0, 0, 1 }, 0.0, 1.0, { 6, 1, 0 }));
  const Data data{ "drifting", true,
    [](const Vec3& p) { return std::sin(2 * p[0] + 1) * std::cos(p[1]) + 2 * p[0]; } };
  const MultiVector f = AtPoints(mesh, data);
  const GridSpace space = GridOf(mesh, 5);
  const GridSpace finer = GridOf(mesh, 7, 1e-2);
  for (const double lambda : { 1.0, 100.0 })
  {
    SCOPED_TRACE(lambda);
    const MultiVector truth = finer.ValuesAtPoints(
      Equation(finer, lambda).Solve({ FieldAssociation::Points, f }, 0.0, 1e-9).coefficients);
    // Errors of 1e-4 are measured on the finer grid with some of that grid's own error.
    ExpectRightEstimates(Comparison(mesh, space, f, lambda, truth), false);
  }
}

TEST(SolutionAccuracy, DoesNotDependOnThreads)
{
  const TriangleMesh mesh = Transform(Torus(120, 50, 1.0, 0.4), { 1, 0, 1 }, 0.3);
  const GridSpace space = GridOf(mesh, 5);
  std::vector<SolutionAccuracy> results;
  for (const int threads : { 1, 2, 3 })
  {
    PoissonOptions options;
    options.screeningWeight = 0.01;
    options.multigrid.threads = threads;
    options.accuracy = 0.1;
    const Field f{ FieldAssociation::Points, AtPoints(mesh, AllData()[1]) };
    results.push_back(
      SolvePoisson(space, BuildMultigrid(space, options.screeningWeight, 1.0, options.multigrid),
        space.LoadOfValues(f), {}, options)
        .accuracy);
    EXPECT_EQ(results.back().discretization, results.front().discretization);
    EXPECT_EQ(results.back().algebraic, results.front().algebraic);
    EXPECT_EQ(results.back().largest, results.front().largest);
  }
}

TEST(SolutionAccuracy, IsUnknownWithoutCoarserLevels)
{
  const TriangleMesh mesh = GeodesicSphere(3);
  GridSpaceOptions spaceOptions;
  spaceOptions.functions.depth = 2;
  spaceOptions.coarsestSize = 4096;
  const GridSpace space = BuildGridSpace(mesh, spaceOptions);
  ASSERT_EQ(space.NumberOfLevels(), 1u);
  const PoissonSolution solution =
    Equation(space, 1.0)
      .Solve({ FieldAssociation::Points, AtPoints(mesh, AllData()[0]) }, 0.1, 1e-9);
  EXPECT_TRUE(solution.report.converged);
  EXPECT_TRUE(std::isnan(solution.accuracy.discretization));
  EXPECT_FALSE(solution.accuracy.isTrusted);
}

TEST(SolutionAccuracy, OfSeveralSolvesIsTheWorstOrUnknown)
{
  auto kept = SolutionAccuracy::Exact();
  KeepWorse({ 0.1, 2.0, 0.01, true }, kept);
  KeepWorse({ 0.3, 1.0, 0.02, true }, kept);
  EXPECT_EQ(kept.discretization, 0.3);
  EXPECT_EQ(kept.largest, 2.0);
  EXPECT_EQ(kept.algebraic, 0.02);
  EXPECT_TRUE(kept.isTrusted);
  for (const bool isUnknownFirst : { false, true })
  {
    auto mixed = isUnknownFirst ? SolutionAccuracy() : kept;
    KeepWorse(isUnknownFirst ? kept : SolutionAccuracy(), mixed);
    EXPECT_TRUE(std::isnan(mixed.discretization));
    EXPECT_TRUE(std::isnan(mixed.largest));
    EXPECT_TRUE(std::isnan(mixed.algebraic));
    EXPECT_FALSE(mixed.isTrusted);
  }
}

TEST(SolutionAccuracy, StopsAtRoundingWhereCoarserLevelsAreExact)
{
  // Coordinates with their own gradients are solutions on every level.
  const TriangleMesh mesh = Transform(Torus(60, 24, 1.0, 0.4), { 1, 0, 1 }, 0.3);
  const GridSpace space = GridOf(mesh, 5);
  PoissonOptions options;
  options.screeningWeight = 0.01;
  options.accuracy = 0.1;
  options.solve.tolerance = 1e-9;
  MultiVector coordinates(static_cast<Id>(mesh.points.size()), 3);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    coordinates.row(static_cast<Id>(i)) = mesh.points[i].transpose();
  }
  const PoissonSolution solution = SolvePoisson(space, BuildMultigrid(space, 0.01, 1.0, {}),
    space.LoadOfValues({ FieldAssociation::Points, coordinates }),
    space.LoadOfGradientsOfCoordinates(nullptr), options);
  EXPECT_TRUE(solution.report.converged);
  EXPECT_LT((space.ValuesAtPoints(solution.coefficients) - coordinates)
              .cwiseAbs()
              .maxCoeff<Eigen::PropagateNaN>(),
    1e-7);
  EXPECT_LT(solution.accuracy.discretization, 1e-7);
}

TEST(SolutionAccuracy, RefusesWhatIsNoAccuracy)
{
  const GridSpace space = GridOf(GeodesicSphere(3), 3);
  const Equation equation(space, 1.0);
  const Field f{ FieldAssociation::Points, MultiVector::Ones(38, 1) };
  EXPECT_THROW(equation.Solve(f, -0.1, 1e-9), InvalidInput);
  EXPECT_THROW(equation.Solve(f, 1.5, 1e-9), InvalidInput);
  EXPECT_THROW(equation.Solve(f, std::nan(""), 1e-9), InvalidInput);
}
