// The weight of the normal derivative: the iterations do not grow, the rate of the error stays, and
// coordinates do not change.
#include "Discretization.h"
#include "Equations/Poisson.h"
#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

constexpr double Recommended = 1e-2;

struct Problem
{
  Problem(const TriangleMesh& inputMesh, int depth, double lambda, double weight) : mesh(inputMesh)
  {
    SpaceOptions spaceOptions;
    spaceOptions.depth = depth;
    space = BuildGridFunctions(mesh, spaceOptions);
    system = BuildLevelOperators(space, TriangleRule(2), 0, 256, weight);
    options.screeningWeight = lambda * std::pow(space.GetGrid().spacing, 2);
    options.solve.tolerance = 1e-8;
  }

  PoissonSolution Solve(const MultiVector& values, const MultiVector& gradients) const
  {
    const Multigrid multigrid =
      BuildMultigrid(ViewOf(space, system), options.screeningWeight, 1.0, options.multigrid);
    return SolvePoisson(ViewOf(space, system), multigrid, values, gradients, options);
  }

  MultiVector Values(const MultiVector& f) const
  {
    return IntegrateValues(space, mesh, { FieldAssociation::Points, f }, TriangleRule(2));
  }

  TriangleMesh mesh;
  GridFunctions space;
  LevelOperators system;
  PoissonOptions options;
};

/// A harmonic of degree 4 on the unit sphere: an eigenfunction with eigenvalue 20.
MultiVector Harmonic(const TriangleMesh& sphere)
{
  const auto x2 = PointCoordinates(sphere).col(0).array().square().eval();
  const auto y2 = PointCoordinates(sphere).col(1).array().square().eval();
  return (x2 * x2 - 6.0 * x2 * y2 + y2 * y2).matrix();
}

TEST(NormalStabilization, KeepsIterationsFlatAndTheRateOfTheError)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(160), { 1, 2, 3 }, 0.4);
  const MultiVector f = Harmonic(mesh);
  double last = 0.0;
  for (const int depth : { 4, 5, 6 })
  {
    const Problem problem(mesh, depth, 20.0, Recommended);
    const PoissonSolution solution = problem.Solve(problem.Values(f), {});
    EXPECT_TRUE(solution.report.converged);
    EXPECT_LE(solution.report.iterations, 10) << depth;
    // (λ + 20) u = λ f
    const MultiVector u = EvaluateAtPoints(problem.space, solution.coefficients);
    const double error = (u - 0.5 * f).norm() / (0.5 * f).norm();
    RecordProperty("error" + std::to_string(depth), std::to_string(error));
    if (last > 0.0)
    {
      EXPECT_GT(last / error, 2.8) << depth; // the rate without the weight
    }
    last = error;
  }
}

TEST(NormalStabilization, GivesTheCoordinatesBackFromTheirGradients)
{
  for (const TriangleMesh& mesh : { Transform(GeodesicSphere(10), { 1, 2, 0 }, 0.5),
         Transform(Box(4), { 1, 2, 3 }, 0.7, 10.0), Torus(30, 12, 1.0, 0.3) })
  {
    for (const double weight : { 1e-12, Recommended, 1.0 })
    {
      Problem problem(mesh, 4, 1.0, weight);
      problem.options.solve.tolerance = 1e-12;
      const MultiVector x = PointCoordinates(mesh);
      const MultiVector gradients =
        IntegrateGradientsOfCoordinates(problem.space, mesh, nullptr, TriangleRule(2), weight);
      const PoissonSolution solution = problem.Solve(problem.Values(x), gradients);
      const MultiVector u = EvaluateAtPoints(problem.space, solution.coefficients);
      EXPECT_LT(RelativeDifference(u, x), 1e-8) << weight;
    }
  }
}

TEST(NormalStabilization, IsTheWeightOfTheNormalDerivative)
{
  // On the plane z = 0 of the grid, functions of z have no tangential gradient. Their energy is s
  // times the area.
  const TriangleMesh mesh = FlatRectangle(4, 4);
  for (const double weight : { 1e-6, Recommended, 1.0 })
  {
    const Problem problem(mesh, 3, 1.0, weight);
    const MultiVector z = GridCoordinates(problem.space).col(2);
    MultiVector Lz;
    Multiply(StiffnessMatrix(problem.space, problem.system), z, Lz);
    const double area = std::pow(1.0 / problem.space.GetGrid().spacing, 2);
    EXPECT_NEAR((z.transpose() * Lz)(0, 0) / (weight * area), 1.0, 1e-8); // at most 1e-16 / weight
  }
  EXPECT_THROW(Problem(mesh, 3, 1.0, 0.0), InvalidInput);
  EXPECT_THROW(Problem(mesh, 3, 1.0, 1.5), InvalidInput);
}

} // namespace
} // namespace gridfem
