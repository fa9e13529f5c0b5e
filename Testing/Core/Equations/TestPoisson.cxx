// The screened Poisson equation: exact solutions, means, rates, repeatability.
#include "Equations/Poisson.h"
#include "Largest.h"

#include "Dense.h"
#include "Discretization.h"
#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Spaces.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A problem that is ready for right-hand sides.
struct Problem
{
  Problem(const TriangleMesh& inputMesh, const SpaceOptions& spaceOptions, double lambda,
    int degree = 2, int threads = 0)
    : mesh(inputMesh), space(BuildGridFunctions(mesh, spaceOptions)), rule(TriangleRule(degree)),
      system(BuildLevelOperators(space, rule, threads, 64))
  {
    options.screeningWeight = lambda;
    options.multigrid.threads = threads;
    options.solve.tolerance = 1e-11;
  }

  PoissonSolution Solve(const MultiVector& values, const MultiVector& gradients) const
  {
    const Multigrid multigrid =
      BuildMultigrid(ViewOf(space, system), options.screeningWeight, 1.0, options.multigrid);
    return SolvePoisson(ViewOf(space, system), multigrid, values, gradients, options);
  }

  MultiVector Values(const MultiVector& onPoints) const
  {
    return IntegrateValues(space, mesh, { FieldAssociation::Points, onPoints }, rule);
  }

  MultiVector Gradients(const MultiVector& onPoints) const
  {
    return IntegrateGradientsOf(space, mesh, { FieldAssociation::Points, onPoints }, nullptr, rule);
  }

  TriangleMesh mesh;
  GridFunctions space;
  const QuadratureRule& rule;
  LevelOperators system;
  PoissonOptions options;
};

SpaceOptions AtDepth(int depth, bool connectivityAware = true)
{
  SpaceOptions options;
  options.depth = depth;
  options.connectivityAware = connectivityAware;
  return options;
}

/// Means of a function over the components of its space.
MultiVector ComponentMeansOf(const Problem& problem, const MultiVector& coefficients)
{
  MultiVector mean = MultiVector::Zero(problem.space.numberOfComponents, coefficients.cols());
  Eigen::VectorXd area = Eigen::VectorXd::Zero(mean.rows());
  for (std::size_t i = 0; i < problem.space.component.size(); ++i)
  {
    const Index k = problem.space.component[i];
    area[k] += problem.system.integral[i];
    mean.row(k) += problem.system.integral[i] * coefficients.row(i);
  }
  return area.cwiseInverse().asDiagonal() * mean;
}

class PoissonAtWeight : public ::testing::TestWithParam<double>
{
};

class PoissonOnSpaces : public ::testing::TestWithParam<SpaceCase>
{
};

} // namespace

TEST_P(PoissonAtWeight, ReturnsAFieldThatIsGivenWithItsGradient)
{
  // s = ∇f gives u = f for every λ. f has the coordinates and a linear function of them. λ is in
  // units of the mesh, which has size 2.
  for (const bool connectivityAware : { true, false })
  {
    const TriangleMesh mesh = Transform(GeodesicSphere(10), { 1, 2, 0 }, 0.5);
    Problem problem(mesh, AtDepth(4, connectivityAware), 0.0);
    problem.options.screeningWeight = GetParam() * std::pow(problem.space.GetGrid().spacing, 2);
    MultiVector f(mesh.points.size(), 4);
    f.leftCols(3) = PointCoordinates(mesh);
    f.col(3) = f.col(0) - 2.0 * f.col(1) + 0.5 * f.col(2) + MultiVector::Constant(f.rows(), 1, 7.0);
    const PoissonSolution solution = problem.Solve(problem.Values(f), problem.Gradients(f));
    EXPECT_TRUE(solution.report.converged);
    const MultiVector u = EvaluateAtPoints(problem.space, solution.coefficients);
    EXPECT_LT((u - f).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
      1e-8); // the solve has a tolerance of 1e-11 in energy
  }
}

INSTANTIATE_TEST_SUITE_P(
  Weights, PoissonAtWeight, ::testing::Values(0.0, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6));

TEST_P(PoissonOnSpaces, KeepsTheMeanOnEveryComponentWithoutScreening)
{
  const TriangleMesh& mesh = GetParam().mesh;
  const Problem problem(mesh, GetParam().options, 0.0);
  const MultiVector f = RandomValues(mesh.points.size(), 2);
  const MultiVector load = problem.Values(f);
  const PoissonSolution solution = problem.Solve(load, {});
  EXPECT_TRUE(solution.report.converged);
  // Without sources the solution is its mean.
  MultiVector sum = MultiVector::Zero(problem.space.numberOfComponents, 2);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(sum.rows());
  for (std::size_t i = 0; i < problem.space.component.size(); ++i)
  {
    sum.row(problem.space.component[i]) += load.row(i);
    area[problem.space.component[i]] += problem.system.integral[i];
  }
  for (std::size_t i = 0; i < problem.space.component.size(); ++i)
  {
    const Index k = problem.space.component[i];
    ASSERT_LT((solution.coefficients.row(i) - sum.row(k) / area[k]).norm(), 1e-12);
  }
}

TEST_P(PoissonOnSpaces, KeepsTheMeanOfTheFieldForEveryWeight)
{
  const TriangleMesh& mesh = GetParam().mesh;
  const MultiVector f = RandomValues(mesh.points.size(), 2);
  Problem problem(mesh, GetParam().options, 0.0);
  const MultiVector load = problem.Values(f);
  const MultiVector sources = problem.Gradients(RandomValues(mesh.points.size(), 2, 9));
  const MultiVector expected = ComponentMeansOf(problem, problem.Solve(load, {}).coefficients);
  for (const double lambda : { 0.0, 1e-9, 1.0, 1e3 })
  {
    problem.options.screeningWeight = lambda;
    const PoissonSolution solution = problem.Solve(load, sources);
    EXPECT_TRUE(solution.report.converged) << lambda;
    EXPECT_LT((ComponentMeansOf(problem, solution.coefficients) - expected)
                .cwiseAbs()
                .maxCoeff<Eigen::PropagateNaN>(),
      1e-12)
      << lambda;
  }
}

INSTANTIATE_TEST_SUITE_P(Spaces, PoissonOnSpaces, ::testing::ValuesIn(AllSpaces()));

namespace
{

/// Solves for the coordinates, given their values and gradients, and expects them back.
void ExpectCoordinatesBack(const TriangleMesh& mesh, int depth)
{
  for (const bool connectivityAware : { true, false })
  {
    Problem problem(mesh, AtDepth(depth, connectivityAware), 1e-4);
    problem.options.solve.tolerance = 1e-8;
    const MultiVector f = PointCoordinates(mesh);
    const PoissonSolution solution = problem.Solve(problem.Values(f), problem.Gradients(f));
    EXPECT_TRUE(solution.report.converged);
    EXPECT_LE(solution.report.iterations, 30);
    const MultiVector u = EvaluateAtPoints(problem.space, solution.coefficients);
    double worst = 0.0;
    for (Id i = 0; i < u.rows(); ++i)
    {
      const bool isUsed = problem.space.pointPatch[i] >= 0;
      worst = Larger(worst, isUsed ? (u.row(i) - f.row(i)).norm() : 0.0);
    }
    // The tolerance bounds the energy. The largest pointwise errors are some hundred times the
    // tolerance.
    EXPECT_LT(worst, 1e-5 * problem.space.GetGrid().spacing);
  }
}

} // namespace

TEST(Poisson, IsNotFooledByRoundingOnGridPlanes)
{
  // The large faces lie on planes of the grid up to rounding. Functions that vanish on them must
  // not get energies of squared rounding errors.
  for (const double noise : { 0.0, 1e-14, 1e-11, 1e-8 })
  {
    TriangleMesh plate = Box(6, { 0.1, 0.2, 0.3 }, { 0.8, 0.9, 0.65 });
    const MultiVector random = RandomValues(static_cast<Id>(plate.points.size()), 3);
    for (std::size_t i = 0; i < plate.points.size(); ++i)
    {
      plate.points[i] += noise * random.row(i).transpose();
    }
    ExpectCoordinatesBack(plate, 4);
  }
}

TEST(Poisson, ReturnsTheCoordinatesOfRealMeshes)
{
  for (const char* name : { "conrod.stl", "bones_26comp_4k.ply", "dragon_res3_nonmanifold.ply" })
  {
    const std::string path = RealMesh(name);
    if (path.empty())
    {
      GTEST_SKIP() << "the folder of real meshes is not there";
    }
    ExpectCoordinatesBack(ReadMesh(path), 6);
  }
}

TEST(Poisson, AgreesWithADenseSolve)
{
  const TriangleMesh mesh = Torus(20, 10, 1.0, 0.35);
  for (const double lambda : { 1e-3, 1.0 })
  {
    const Problem problem(mesh, AtDepth(3), lambda);
    const MultiVector f = RandomValues(mesh.points.size(), 2);
    const MultiVector g = RandomValues(mesh.points.size(), 2, 2);
    const PoissonSolution solution = problem.Solve(problem.Values(f), problem.Gradients(g));
    ASSERT_TRUE(solution.report.converged);
    const Eigen::MatrixXd A = lambda * Dense(MassMatrix(problem.space, problem.system)) +
                              Dense(StiffnessMatrix(problem.space, problem.system));
    const Eigen::MatrixXd b = lambda * problem.Values(f) + problem.Gradients(g);
    // A is nearly singular normal to the surface, so values are compared on the surface.
    const MultiVector exact = LeastSquares(A, b);
    EXPECT_LT((EvaluateAtPoints(problem.space, solution.coefficients) -
                EvaluateAtPoints(problem.space, exact))
                .cwiseAbs()
                .maxCoeff<Eigen::PropagateNaN>(),
      1e-8);
  }
}

TEST(Poisson, ConvergesAtSecondOrderToASphericalHarmonic)
{
  // f = x⁴ - 6x²y² + y⁴ is a harmonic of degree l = 4: Δf = -l (l + 1) f on the unit sphere. With s
  // = 0 the solution of λu - Δu = λf is λ / (λ + 20) f.
  const TriangleMesh mesh = GeodesicSphere(160); // its own error shows only at depth 6
  MultiVector f(mesh.points.size(), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const double x = mesh.points[i][0] * mesh.points[i][0];
    const double y = mesh.points[i][1] * mesh.points[i][1];
    f(i, 0) = x * x - 6.0 * x * y + y * y;
  }
  double last = 0.0;
  for (int depth = 3; depth <= 6; ++depth)
  {
    Problem problem(mesh, AtDepth(depth), 0.0);
    problem.options.screeningWeight = 20.0 * std::pow(problem.space.GetGrid().spacing, 2);
    const PoissonSolution solution = problem.Solve(problem.Values(f), {});
    ASSERT_TRUE(solution.report.converged);
    const MultiVector u = EvaluateAtPoints(problem.space, solution.coefficients);
    const double error = (u - 0.5 * f).norm() / (0.5 * f.norm());
    RecordProperty("error" + std::to_string(depth), std::to_string(error));
    if (depth > 3)
    {
      EXPECT_GT(last / error, 2.8) << depth; // 3.5, 3.4, 2.9
    }
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(Poisson, IsSolvedByCyclesAloneAsWell)
{
  const TriangleMesh mesh = Torus(40, 20, 1.0, 0.4);
  Problem problem(mesh, AtDepth(5), 0.1);
  const MultiVector load = problem.Values(RandomValues(mesh.points.size(), 2));
  problem.options.solve.tolerance = 1e-9;
  problem.options.solve.maximumIterations = 300;
  const PoissonSolution krylov = problem.Solve(load, {});
  problem.options.iteration = IterationType::Cycles;
  const PoissonSolution cycles = problem.Solve(load, {});
  EXPECT_TRUE(krylov.report.converged);
  EXPECT_TRUE(cycles.report.converged);
  EXPECT_GT(cycles.report.iterations, krylov.report.iterations);
  const MultiVector values = EvaluateAtPoints(problem.space, krylov.coefficients);
  // sqrt(rᵀBr) underestimates the error of slow cycles by a factor of their number.
  EXPECT_LT(
    (EvaluateAtPoints(problem.space, cycles.coefficients) - values).norm(), 1e-6 * values.norm());
}

TEST(Poisson, IsTheSameWithEveryCycleAndSmoother)
{
  const TriangleMesh mesh = Torus(40, 20, 1.0, 0.4);
  Problem problem(mesh, AtDepth(5), 0.1);
  const MultiVector load = problem.Values(RandomValues(mesh.points.size(), 1));
  problem.options.solve.maximumIterations = 1000;
  const MultiVector expected =
    EvaluateAtPoints(problem.space, problem.Solve(load, {}).coefficients);
  const auto iterations = [&](CycleType cycle, SmootherType smoother, int sweeps, int between = 1)
  {
    problem.options.multigrid.cycle = cycle;
    problem.options.multigrid.smoother = smoother;
    problem.options.multigrid.preSweeps = problem.options.multigrid.postSweeps = sweeps;
    problem.options.multigrid.sweepsPerSynchronization = between;
    const PoissonSolution solution = problem.Solve(load, {});
    EXPECT_TRUE(solution.report.converged);
    const MultiVector found = EvaluateAtPoints(problem.space, solution.coefficients);
    EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm());
    return solution.report.iterations;
  };
  for (const CycleType cycle : { CycleType::V, CycleType::W })
  {
    for (const SmootherType smoother : { SmootherType::Patch, SmootherType::GaussSeidel })
    {
      EXPECT_LT(iterations(cycle, smoother, 5), iterations(cycle, smoother, 1));
    }
  }
  const int one = iterations(CycleType::W, SmootherType::SliceGaussSeidel, 1);
  const int three = iterations(CycleType::W, SmootherType::SliceGaussSeidel, 1, 3);
  EXPECT_LT(three, one);
  // More sweeps than there are slices: the slabs become one.
  EXPECT_LE(iterations(CycleType::W, SmootherType::SliceGaussSeidel, 1, 100), three);
}

TEST(Poisson, IsTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = Torus(60, 24, 1.0, 0.4);
  const MultiVector f = RandomValues(mesh.points.size(), 3);
  std::vector<MultiVector> solutions;
  for (const int threads : { 1, 2 })
  {
    SpaceOptions space = AtDepth(6);
    space.threads = threads;
    const Problem problem(mesh, space, 0.01, 2, threads);
    const Field field{ FieldAssociation::Points, f };
    const MultiVector values = IntegrateValues(problem.space, mesh, field, problem.rule, threads);
    solutions.push_back(problem.Solve(values, {}).coefficients);
  }
  EXPECT_EQ(solutions[0], solutions[1]);
}

TEST(Poisson, TakesANewWeightWithoutANewHierarchy)
{
  const TriangleMesh mesh = GeodesicSphere(8);
  Problem problem(mesh, AtDepth(4), 0.5);
  const MultiVector load = problem.Values(RandomValues(mesh.points.size(), 1));
  Multigrid multigrid =
    BuildMultigrid(ViewOf(problem.space, problem.system), 3.0, 1.0, problem.options.multigrid);
  UpdateMultigrid(ViewOf(problem.space, problem.system), 0.5, 1.0, multigrid);
  const PoissonSolution updated =
    SolvePoisson(ViewOf(problem.space, problem.system), multigrid, load, {}, problem.options);
  EXPECT_EQ(updated.coefficients, problem.Solve(load, {}).coefficients);
}

TEST(Poisson, GivesAConstantBackAtOnce)
{
  const TriangleMesh mesh = Join(GeodesicSphere(6), Box(3, { 3, 3, 3 }, { 4, 4, 4 }));
  const Problem problem(mesh, AtDepth(5), 0.1);
  const PoissonSolution solution =
    problem.Solve(problem.Values(MultiVector::Constant(mesh.points.size(), 1, 1e6)), {});
  EXPECT_TRUE(solution.report.converged);
  EXPECT_EQ(solution.report.iterations, 0);
  EXPECT_LT(
    (solution.coefficients.array() / 1e6 - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-13);
}

TEST(Poisson, StaysFiniteOnComponentsWithoutArea)
{
  // A triangle on a line. Cut points may give its pieces an area of a few roundings, which still
  // has a mean. Without any area the coefficients are 0.
  TriangleMesh mesh = FlatRectangle(4, 4);
  const Id first = static_cast<Id>(mesh.points.size());
  mesh.points.insert(
    mesh.points.end(), { { 0.3, 0.3, 0.9 }, { 0.4, 0.3, 0.9 }, { 0.5, 0.3, 0.9 } });
  mesh.triangles.push_back({ first, first + 1, first + 2 });
  for (const double lambda : { 0.0, 0.2 })
  {
    const Problem problem(mesh, AtDepth(5), lambda);
    ASSERT_EQ(problem.space.numberOfComponents, 2);
    const PoissonSolution solution =
      problem.Solve(problem.Values(RandomValues(mesh.points.size(), 2)), {});
    EXPECT_TRUE(solution.report.converged);
    const MultiVector u = EvaluateAtPoints(problem.space, solution.coefficients);
    EXPECT_LE(u.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1.0); // f has these bounds
  }
}

TEST(Poisson, IsRightAtPointsOfTrianglesWithoutArea)
{
  // The second triangle lies on a line and meets the first in a point. Its functions there have no
  // equation. The point belongs to the first triangle.
  const TriangleMesh mesh = { { { 0, 0, 0 }, { 1, .3, .2 }, { .1, 1, .7 }, { -1, -.5, -.3 },
                                { -.5, -.25, -.15 } },
    { { 0, 1, 2 }, { 0, 3, 4 } } };
  const Problem problem(mesh, AtDepth(3), 0.01);
  const PoissonSolution solution = problem.Solve(problem.Values(MultiVector::Ones(5, 1)), {});
  EXPECT_TRUE(solution.report.converged);
  const MultiVector atInput = EvaluateAtPoints(problem.space, solution.coefficients);
  EXPECT_LT((atInput.topRows(3).array() - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-9);
  const MultiVector atAll = EvaluateAtClippedPoints(problem.space, solution.coefficients);
  EXPECT_EQ(atAll.topRows(5), atInput);
}

TEST(Poisson, DoesNotDependOnTheSizeOfNumbers)
{
  // Scaled by powers of two, the load and the solution have the same digits.
  const TriangleMesh mesh = GeodesicSphere(8);
  const Problem problem(mesh, AtDepth(4), 0.1);
  const MultiVector f = RandomValues(mesh.points.size(), 1);
  const MultiVector load = problem.Values(f);
  const MultiVector expected = problem.Solve(load, load).coefficients;
  for (const int exponent : { -900, -600, 600, 900 })
  {
    const MultiVector scaled = std::ldexp(1.0, exponent) * load;
    const PoissonSolution solution = problem.Solve(scaled, scaled);
    EXPECT_TRUE(solution.report.converged);
    EXPECT_EQ(solution.coefficients, std::ldexp(1.0, exponent) * expected) << exponent;
  }
  const PoissonSolution small = problem.Solve(problem.Values(1e-170 * f), {});
  EXPECT_LT(
    RelativeDifference(1e170 * small.coefficients, problem.Solve(load, {}).coefficients), 1e-9);
}

TEST(Poisson, SolutionsBeyondTheLargestNumberHaveNotConverged)
{
  const TriangleMesh mesh = GeodesicSphere(8);
  const Problem problem(mesh, AtDepth(4), 1e-6);
  const MultiVector load = 1e305 * problem.Values(RandomValues(mesh.points.size(), 1));
  const PoissonSolution solution = problem.Solve(load, 1e3 * load);
  EXPECT_FALSE(solution.report.converged);
  EXPECT_EQ(solution.report.end, SolveEnd::Breakdown);
}

TEST(Poisson, SaysWhereRoundingIsTheEnd)
{
  // A triangle of 1 % of a cell. Functions that differ in it are determined by their normal
  // derivative alone, whose weight is 1e-12.
  TriangleMesh mesh;
  for (const Vec3& corner : { Vec3(0.1, 0.2, 0.3), Vec3(1.1, 0.7, 0.4), Vec3(0.3, 1.2, 0.9) })
  {
    const Id first = static_cast<Id>(mesh.points.size());
    mesh.points.insert(mesh.points.end(),
      { corner, corner + Vec3(0.003, 0.001, 0.0), corner + Vec3(0.0, 0.002, 0.001) });
    mesh.triangles.push_back({ first, first + 1, first + 2 });
  }
  Problem problem(mesh, AtDepth(2), 1e-9);
  problem.options.solve.tolerance = 1e-14;
  const PoissonSolution solution = problem.Solve(problem.Values(RandomValues(9, 1)), {});
  EXPECT_FALSE(solution.report.converged);
  EXPECT_TRUE(solution.isAtRounding);
  EXPECT_EQ(solution.report.end, SolveEnd::Stagnation);

  const TriangleMesh sphere = GeodesicSphere(8);
  Problem unfinished(sphere, AtDepth(4), 1.0);
  unfinished.options.solve.maximumIterations = 1;
  const MultiVector f = RandomValues(sphere.points.size(), 1);
  EXPECT_FALSE(unfinished.Solve(unfinished.Values(f), {}).isAtRounding);
}

TEST(Poisson, SaysWhereNumbersDoNotDetermineTheSolution)
{
  // Two triangles whose height is a billionth of their length. Their functions differ by energies
  // of 1e-12, and rounding of the matrix leaves four digits of these. The tolerance is out of
  // reach, although the residual is far from rounding.
  const Vec3 from[] = { { -0.8, -0.5, 0.3 }, { 0.7, -0.6, 0.2 } };
  const Vec3 to[] = { { 0.9, 0.6, -0.4 }, { -0.5, 0.8, -0.9 } };
  const Vec3 height[] = { { 0.3e-9, 0.2e-9, 0.8e-9 }, { 0.1e-9, 0.7e-9, -0.4e-9 } };
  const TriangleMesh narrow = { { from[0], to[0], 0.5 * (from[0] + to[0]) + height[0], from[1],
                                  to[1], 0.5 * (from[1] + to[1]) + height[1] },
    { { 0, 1, 2 }, { 3, 4, 5 } } };
  Problem problem(narrow, AtDepth(4, false), 1.0);
  problem.options.solve.tolerance = 1e-6;
  problem.options.solve.maximumIterations = 200;
  for (const unsigned seed : { 1, 2, 3, 4, 5, 6 })
  {
    const MultiVector f = RandomValues(6, 1, seed);
    const PoissonSolution solution = problem.Solve(problem.Values(f), problem.Gradients(f));
    EXPECT_TRUE(solution.report.converged || solution.isAtRounding) << seed;
  }

  // Functions that differ next to the faces have 1e-6 of the others' energy, but with all digits.
  // Here the iteration itself stagnates.
  const TriangleMesh octahedron = GeodesicSphere(1);
  Problem slow(octahedron, AtDepth(4), 8e5);
  slow.options.solve.tolerance = 1e-6;
  slow.options.solve.maximumIterations = 200;
  EXPECT_FALSE(slow.Solve(slow.Values(RandomValues(6, 1)), {}).isAtRounding);
}

TEST(Poisson, LeavesOutWhatCancelsBetweenPiecesThatLieOnEachOther)
{
  // Two fields on one triangle and on a copy of it. Functions that are not connectivity-aware do
  // not tell the two apart, so the solution is the mean. The copies' sides run in opposite
  // directions, so their cut points differ by rounding. A load of that size need not be an energy
  // at all.
  for (const unsigned seed : { 371, 453, 459, 846, 920, 993 }) // the iteration broke down for these
  {
    const MultiVector random = RandomValues(4, 3, seed);
    TriangleMesh mesh;
    for (const int row : { 0, 1, 2, 0, 1, 2 })
    {
      mesh.points.emplace_back(random.row(row).transpose());
    }
    mesh.triangles = { { 0, 1, 0 }, { 0, 1, 2 }, { 3, 4, 3 }, { 3, 4, 5 } };
    GridSpaceOptions functions;
    functions.functions = AtDepth(2, false);
    functions.functions.weldCoincidentPoints = false;
    const GridSpace space = BuildGridSpace(mesh, functions);
    PoissonOptions options;
    options.screeningWeight = 1e4;
    options.solve.tolerance = 1e-6;
    const Multigrid multigrid = BuildMultigrid(space, options.screeningWeight, 1.0, {});
    const MultiVector values = MultiVector{ { 0.0 }, { random(3, 0) }, { 0.0 }, { random(3, 1) } };
    const PoissonSolution solution = SolvePoisson(
      space, multigrid, space.LoadOfValues({ FieldAssociation::Triangles, values }), {}, options);
    EXPECT_TRUE(solution.report.converged) << seed;
    const double mean = 0.5 * (random(3, 0) + random(3, 1));
    EXPECT_LT((space.ValuesAtPoints(solution.coefficients).array() - mean)
                .abs()
                .maxCoeff<Eigen::PropagateNaN>(),
      1e-9)
      << seed;
  }
}

TEST(Poisson, ProgressIsAlwaysANumber)
{
  const TriangleMesh mesh = GeodesicSphere(8);
  const Problem problem(mesh, AtDepth(4), 0.1);
  MultiVector f = RandomValues(mesh.points.size(), 2);
  f(3, 1) = std::numeric_limits<double>::quiet_NaN();
  const Multigrid multigrid = BuildMultigrid(ViewOf(problem.space, problem.system), 0.1, 1.0, {});
  int reports = 0;
  const Progress progress(
    [&](double fraction)
    {
      EXPECT_TRUE(fraction >= 0.0 && fraction <= 1.0) << fraction;
      ++reports;
      return true;
    });
  SolvePoisson(ViewOf(problem.space, problem.system), multigrid, problem.Values(f), {},
    problem.options, progress);
  EXPECT_GT(reports, 1);
}

TEST(Poisson, ReportsThatItHasNotConverged)
{
  const TriangleMesh mesh = GeodesicSphere(12);
  Problem problem(mesh, AtDepth(5), 0.01);
  problem.options.solve.maximumIterations = 1;
  const PoissonSolution solution =
    problem.Solve(problem.Values(RandomValues(mesh.points.size(), 1)), {});
  EXPECT_FALSE(solution.report.converged);
  EXPECT_EQ(solution.report.iterations, 1);
  EXPECT_TRUE(solution.coefficients.allFinite());
}

TEST(Poisson, KeepsNaNInItsColumnAndSaysSo)
{
  const TriangleMesh mesh = GeodesicSphere(8);
  const Problem problem(mesh, AtDepth(4), 0.1);
  MultiVector f = RandomValues(mesh.points.size(), 2);
  const MultiVector clean = problem.Solve(problem.Values(f), {}).coefficients;
  f(3, 1) = std::numeric_limits<double>::quiet_NaN();
  const PoissonSolution solution = problem.Solve(problem.Values(f), {});
  EXPECT_FALSE(solution.report.converged);
  EXPECT_LT(
    (solution.coefficients.col(0) - clean.col(0)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-8);
}

TEST(Poisson, RefusesWhatDoesNotFit)
{
  const TriangleMesh mesh = Box(2);
  Problem problem(mesh, AtDepth(3), 1.0);
  const MultiVector load = problem.Values(PointCoordinates(mesh));
  EXPECT_THROW(problem.Solve(load.topRows(3), {}), InvalidInput);
  EXPECT_THROW(problem.Solve(load, load.leftCols(2)), InvalidInput);
  for (const double bad :
    { -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    const Multigrid multigrid =
      BuildMultigrid(ViewOf(problem.space, problem.system), 1.0, 1.0, problem.options.multigrid);
    problem.options.screeningWeight = bad;
    EXPECT_THROW(
      SolvePoisson(ViewOf(problem.space, problem.system), multigrid, load, {}, problem.options),
      InvalidInput);
  }
}
