// Values at points against the exact solution of the constrained system, on both kinds of space.
#include "Equations/PointConstraints.h"

#include "Base/Errors.h"
#include "Dense.h"
#include "EitherSpace.h"
#include "Equations/EdgeConditions.h"
#include "Equations/Poisson.h"
#include "Grid/SurfaceEdges.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

std::unique_ptr<FiniteElementSpace> Build(
  const TriangleMesh& mesh, bool isOnHats, int depth, int threads = 0)
{
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.threads = threads;
  options.coarsestSize = 32;
  options.normalStabilization = 1e-2; // a dense solver then determines all functions
  return BuildEither(mesh, isOnHats, options);
}

SolveOptions Solver(double tolerance = 1e-8)
{
  SolveOptions options;
  options.tolerance = tolerance;
  options.maximumIterations = 200;
  return options;
}

MultiVector WavesAt(const TriangleMesh& mesh, const std::vector<Id>& points, double offset = 0.0)
{
  MultiVector values(static_cast<Id>(points.size()), 2);
  for (Id k = 0; k < values.rows(); ++k)
  {
    const Vec3& p = mesh.points[points[k]];
    values.row(k) << offset + std::sin(3 * p[0] + p[1]), offset + p[2] * std::cos(2 * p[1]);
  }
  return values;
}

ConstrainedSolution Solve(const FiniteElementSpace& space, double a, const MultiVector& load,
  const std::vector<Id>& points, const MultiVector& values, int threads = 0,
  const Progress& progress = {})
{
  MultigridOptions multigrid;
  multigrid.threads = threads;
  const ConstraintOptions constraints;
  const ConstrainedHierarchy hierarchy(
    space, a, 1.0, space.RowsAtPoints(points), constraints.penalty, multigrid, progress);
  return SolveConstrained(space, a, hierarchy, load, values, constraints, Solver(), progress);
}

class PointConstraints : public ::testing::TestWithParam<bool>
{
};

} // namespace

TEST_P(PointConstraints, SolveTheSystemWithMultipliers)
{
  for (const double a : { 0.0, 0.3 })
  {
    const TriangleMesh mesh = Transform(Torus(24, 12, 1.0, 0.4), { 1, 2, 3 }, 0.3);
    const auto space = Build(mesh, GetParam(), 3);
    const auto points = EveryPoint(mesh, 23);
    const MultiVector values = WavesAt(mesh, points, 100.0);
    const MultiVector load = space->LoadOfValues(
      { FieldAssociation::Points, RandomValues(static_cast<Id>(mesh.points.size()), 2) });
    const ConstrainedSolution found = Solve(*space, a, load, points, values);
    EXPECT_TRUE(found.report.converged);
    EXPECT_TRUE(found.isExact);

    const Eigen::MatrixXd A = Dense(space->Matrix(0, a, 1.0));
    const Eigen::MatrixXd C = Dense(space->RowsAtPoints(points));
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(A.rows() + C.rows(), A.rows() + C.rows());
    system.topLeftCorner(A.rows(), A.rows()) = A;
    system.topRightCorner(A.rows(), C.rows()) = C.transpose();
    system.bottomLeftCorner(C.rows(), A.rows()) = C;
    Eigen::MatrixXd right(system.rows(), 2);
    right << load, values;
    const Eigen::MatrixXd exact = LeastSquares(system, right).topRows(A.rows());
    EXPECT_LT(RelativeDifference(space->ValuesAtPoints(found.coefficients),
                space->ValuesAtPoints(MultiVector(exact))),
      1e-6)
      << a;
  }
}

TEST_P(PointConstraints, AreMetInFewIterationsHoweverManyThereAre)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.3);
  const auto space = Build(mesh, GetParam(), 5);
  const Field field{ FieldAssociation::Points, WavesAt(mesh, EveryPoint(mesh, 1)) };
  PoissonOptions free;
  free.screeningWeight = 0.0;
  free.solve = Solver();
  const int usual = SolvePoisson(*space, BuildMultigrid(*space, 0.0, 1.0, free.multigrid),
    space->LoadOfValues(field), space->LoadOfGradientsOf(field, nullptr), free)
                      .report.iterations;
  for (const Id step : { 3001, 307, 31, 13 })
  {
    const auto points = EveryPoint(mesh, step);
    const MultiVector values = WavesAt(mesh, points);
    const ConstrainedSolution found = Solve(*space, 0.0, {}, points, values);
    EXPECT_TRUE(found.report.converged);
    EXPECT_LT(found.misfit, 2e-6) << step; // 1e-6 of the range, which is 2
    EXPECT_LE(found.report.iterations, 4 * std::max(usual, 4)) << step;
    MultiVector reached;
    Multiply(space->RowsAtPoints(points), found.coefficients, reached);
    EXPECT_LT((reached - values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 2e-6) << step;
  }
}

TEST_P(PointConstraints, OfManyPointsAreMet)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(80), { 1, 2, 3 }, 0.3);
  const auto space = Build(mesh, GetParam(), 7);
  std::vector<Id> points = EveryPoint(mesh, 1);
  points.resize(25000);
  const MultiVector values = WavesAt(mesh, points).col(0);
  const ConstrainedSolution found = Solve(*space, 0.0, {}, points, values);
  EXPECT_TRUE(found.report.converged);
  EXPECT_TRUE(found.isExact);
  EXPECT_LT(found.misfit, 2e-6); // 1e-6 of the range, which is 2
}

/// The harmonic function exp(π(x - 1)) sin(πy) + x on a square, from its values on the rim. Each
/// level has a quarter of the error.
TEST(BoundaryConstraints, HaveErrorsOfSecondOrder)
{
  const double pi = std::acos(-1.0);
  const TriangleMesh flat = FlatRectangle(100, 100);
  const TriangleMesh mesh = Transform(flat, { 1, 2, 3 }, 0.3);
  MultiVector exact(static_cast<Id>(mesh.points.size()), 1);
  for (Id i = 0; i < exact.rows(); ++i)
  {
    const Vec3& p = flat.points[i];
    exact(i, 0) = std::exp(pi * (p[0] - 1.0)) * std::sin(pi * p[1]) + p[0];
  }
  double last = 0.0;
  for (const int depth : { 3, 4, 5 })
  {
    const auto space = Build(mesh, false, depth);
    const HeldValues held = HoldEdges(*space, mesh, FindSurfaceEdges(mesh, true).boundary, exact);
    const ConstraintOptions constraints;
    const ConstrainedHierarchy hierarchy(*space, 0.0, 1.0, held.rows, constraints.penalty, {});
    const ConstrainedSolution found =
      SolveConstrained(*space, 0.0, hierarchy, {}, held.values, constraints, Solver());
    const double error = (space->ValuesAtPoints(found.coefficients) - exact).norm() / 101.0;
    if (last > 0.0)
    {
      EXPECT_GT(last / error, 3.0) << depth;
    }
    last = error;
  }
  EXPECT_LT(last, 3e-4);
}

/// A closed mesh has no boundary, whether its triangles share points or face alike. A missing
/// triangle leaves a boundary of its perimeter.
TEST(BoundaryConstraints, ExistWhereATriangleIsMissing)
{
  const auto termsOf = [](const TriangleMesh& mesh)
  {
    const auto space = BuildEither(mesh, false, 3, 1e-2);
    const MultiVector one = MultiVector::Ones(static_cast<Id>(mesh.points.size()), 1);
    return TermsOnBoundary(*space, mesh, true, &one, nullptr);
  };
  for (const TriangleMesh& closed :
    { GeodesicSphere(6), Transform(Box(4), { 1, 2, 3 }, 0.4), Torus(16, 8, 1.0, 0.4) })
  {
    TriangleMesh turned = closed;
    std::swap(turned.triangles[5][0], turned.triangles[5][1]);
    TriangleMesh degenerate = closed;
    degenerate.triangles.push_back({ 2, 3, 3 });
    for (const TriangleMesh& mesh : { closed, Unweld(closed), turned, degenerate })
    {
      EXPECT_FALSE(termsOf(mesh).isThere);
    }
    for (const std::size_t missing : { std::size_t(0), closed.triangles.size() / 2 })
    {
      TriangleMesh open = closed;
      const auto corner = open.triangles[missing];
      open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(missing));
      double perimeter = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        perimeter += (open.points[corner[k]] - open.points[corner[(k + 1) % 3]]).norm();
      }
      for (const TriangleMesh& mesh : { open, Unweld(open) })
      {
        const BoundaryTerms terms = termsOf(mesh);
        EXPECT_TRUE(terms.isThere);
        EXPECT_NEAR(terms.load.sum(), perimeter, 1e-9);
      }
    }
  }
}

TEST_P(PointConstraints, ThatContradictEachOtherAreMetInTheMean)
{
  const TriangleMesh mesh = GeodesicSphere(12);
  const auto space = Build(mesh, GetParam(), 4);
  MultiVector values(5, 1);
  values << 1.0, 3.0, 0.0, 5.0, 5.0;
  const ConstrainedSolution found = Solve(*space, 0.0, {}, { 7, 7, 100, 200, 200 }, values);
  EXPECT_TRUE(found.report.converged);
  EXPECT_FALSE(found.isExact);
  EXPECT_NEAR(found.misfit, 1.0, 1e-5);
  const MultiVector reached = space->ValuesAtPoints(found.coefficients);
  EXPECT_NEAR(reached(7, 0), 2.0, 1e-4);
  EXPECT_NEAR(reached(100, 0), 0.0, 1e-4);
  EXPECT_NEAR(reached(200, 0), 5.0, 1e-4);
}

TEST_P(PointConstraints, LeaveAConstantOpenOnComponentsWithoutOne)
{
  const TriangleMesh one = GeodesicSphere(8);
  const TriangleMesh mesh = Join(one, Transform(one, { 1, 0, 0 }, 0.0, 1.0, { 5, 0, 0 }));
  const auto space = Build(mesh, GetParam(), 5);
  ConstrainedSolution found = Solve(*space, 0.0, {}, { 3 }, MultiVector::Constant(1, 2, 4.0));
  EXPECT_TRUE(found.report.converged);
  EXPECT_EQ(found.isHeld.size(), 2u);
  MultiVector means(2, 2);
  means << 7.0, 7.0, 7.0, std::nan("");
  SetMeans(*space, found.isHeld, means, found.coefficients);
  const MultiVector reached = space->ValuesAtPoints(found.coefficients);
  const auto half = static_cast<Id>(one.points.size());
  EXPECT_LT((reached.topRows(half).array() - 4.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-9);
  EXPECT_LT(
    (reached.bottomRows(half).col(0).array() - 7.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-9);
  EXPECT_TRUE(reached.bottomRows(half).col(1).array().isNaN().all());
}

TEST_P(PointConstraints, OfAnySizeAreScaledAndDoNotDependOnThreads)
{
  const TriangleMesh mesh = GeodesicSphere(12);
  const auto points = EveryPoint(mesh, 17);
  const MultiVector values = WavesAt(mesh, points);
  const auto space = Build(mesh, GetParam(), 4);
  const MultiVector one = Solve(*space, 0.0, {}, points, values, 1).coefficients;
  EXPECT_EQ(one, Solve(*Build(mesh, GetParam(), 4, 3), 0.0, {}, points, values, 3).coefficients);
  for (const double scale : { std::ldexp(1.0, -600), std::ldexp(1.0, 900) })
  {
    const ConstrainedSolution scaled = Solve(*space, 0.0, {}, points, scale * values);
    EXPECT_TRUE(scaled.report.converged);
    EXPECT_LT(RelativeDifference(scaled.coefficients / scale, one), 1e-12);
  }
}

TEST_P(PointConstraints, OfNaNAreNotMet)
{
  const TriangleMesh mesh = GeodesicSphere(6);
  const auto space = Build(mesh, this->GetParam(), 4);
  const std::vector<Id> points = EveryPoint(mesh, 9);
  for (const Id row : { Id(0), Id(2) })
  {
    MultiVector values = WavesAt(mesh, points);
    values(row, 1) = std::nan("");
    const ConstrainedSolution solution = Solve(*space, 0.0, {}, points, values);
    EXPECT_FALSE(solution.report.converged);
    EXPECT_FALSE(solution.isExact);
    EXPECT_TRUE(std::isnan(solution.misfit));
    EXPECT_TRUE(std::isnan(solution.relativeMisfit));
  }
}

TEST_P(PointConstraints, AreRefusedWhereTheyDoNotFitAndStopWhenAsked)
{
  const TriangleMesh mesh = GeodesicSphere(6);
  const auto space = Build(mesh, GetParam(), 3);
  EXPECT_THROW(Solve(*space, 0.0, {}, { 1, 2 }, MultiVector::Ones(3, 1)), InvalidInput);
  EXPECT_THROW(
    Solve(*space, 0.0, MultiVector::Ones(2, 1), { 1 }, MultiVector::Ones(1, 1)), InvalidInput);
  EXPECT_THROW(Solve(*space, 0.0, {}, { 1 }, MultiVector::Ones(1, 1), 0,
                 Progress([](double) { return false; })),
    Aborted);
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, PointConstraints, ::testing::Bool());
