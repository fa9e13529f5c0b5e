// Conjugate gradients and repeated cycles: convergence, columns, singular systems, broken data.
#include "Base/Errors.h"
#include "Krylov/ConjugateGradients.h"
#include "SampledHierarchy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

using testing::RandomValues;
using testing::RelativeDifference;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

Multigrid Make(const std::vector<testing::Sample>& samples, int depth, double mass,
  MultigridOptions options = {})
{
  return Multigrid(testing::SampledHierarchy(samples, depth, 1, mass, 1.0), options);
}

Multigrid SolidProblem(double mass = 0.1)
{
  return Make(testing::SolidCube(3), 3, mass);
}

MultiVector Applied(const Multigrid& multigrid, const MultiVector& x)
{
  MultiVector y;
  Multiply(multigrid.Matrix(), x, y);
  return y;
}

SolveOptions Tolerance(double tolerance, int maximumIterations = 100)
{
  SolveOptions options;
  options.tolerance = tolerance;
  options.maximumIterations = maximumIterations;
  return options;
}

/// Constants are orthogonal to the range of a pure Neumann matrix. The same map serves both sides.
void RemoveMean(MultiVector& x)
{
  const Eigen::RowVectorXd mean = x.colwise().mean();
  x.rowwise() -= mean;
}

using Solver = SolveReport (*)(const LinearOperator&, const Preconditioner&, const MultiVector&,
  MultiVector&, const SolveOptions&, const Projection&, const Progress&);

class Solvers : public ::testing::TestWithParam<Solver>
{
protected:
  static SolveReport Solve(const Multigrid& multigrid, const MultiVector& b, MultiVector& x,
    const SolveOptions& options, const Projection& project = {}, const Progress& progress = {})
  {
    return GetParam()(OperatorOf(multigrid), CycleOf(multigrid), b, x, options, project, progress);
  }
};

TEST_P(Solvers, FindTheSolution)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector exact = RandomValues(multigrid.Matrix().rows, 3);
  const MultiVector b = Applied(multigrid, exact);
  MultiVector x = MultiVector::Zero(exact.rows(), 3);
  const SolveReport report = Solve(multigrid, b, x, Tolerance(1e-10));
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 25);
  EXPECT_GT(report.convergenceFactor, 0.0);
  EXPECT_LT(report.convergenceFactor, 0.4);
  // sqrt(rᵀBr) is the energy norm of the error up to the quality of B; the condition number is
  // about 100.
  EXPECT_LT(RelativeDifference(x, exact), 1e-8);
}

TEST_P(Solvers, HistoryIsWhatItSays)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 1);
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  SolveOptions options = Tolerance(1e-6);
  options.measure = SolveOptions::Measure::Residual; // x stays as it was measured
  const SolveReport report = Solve(multigrid, b, x, options);
  ASSERT_EQ(report.history.size(), std::size_t(report.iterations) + 1);
  EXPECT_EQ(report.history.front().energy, 1.0);
  EXPECT_EQ(report.history.front().residual, 1.0);
  for (std::size_t i = 0; i < report.history.size(); ++i)
  {
    EXPECT_EQ(report.history[i].iteration, int(i));
  }
  EXPECT_LE(report.history.back().residual, 1e-6);
  EXPECT_GT(report.history[report.history.size() - 2].residual, 1e-6);

  const MultiVector r = b - Applied(multigrid, x);
  MultiVector Br;
  MultiVector Bb;
  multigrid.Precondition(r, Br);
  multigrid.Precondition(b, Bb);
  const double energy = std::sqrt(r.cwiseProduct(Br).sum() / b.cwiseProduct(Bb).sum());
  // The updated residual differs from the true one by rounding, 1e-16 of b against 1e-6. The cycle
  // rounds to single precision.
  EXPECT_NEAR(report.history.back().energy / energy, 1.0, 1e-7);
  EXPECT_NEAR(report.history.back().residual * b.norm() / r.norm(), 1.0, 1e-8);
}

TEST_P(Solvers, CanStopOnTheResidual)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 2);
  MultiVector x = MultiVector::Zero(b.rows(), 2);
  SolveOptions options = Tolerance(1e-7);
  options.measure = SolveOptions::Measure::Residual;
  const SolveReport report = Solve(multigrid, b, x, options);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.history.back().residual, 1e-7);
  const MultiVector r = b - Applied(multigrid, x);
  EXPECT_LE(
    (r.colwise().norm().array() / b.colwise().norm().array()).maxCoeff<Eigen::PropagateNaN>(),
    1.001e-7);
}

TEST_P(Solvers, StartFromAGuess)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector exact = RandomValues(multigrid.Matrix().rows, 1, 1);
  const MultiVector b = Applied(multigrid, exact);
  MultiVector cold = MultiVector::Zero(b.rows(), 1);
  MultiVector warm = exact + 1e-6 * RandomValues(b.rows(), 1, 2);
  MultiVector done = exact;
  const SolveReport fromZero = Solve(multigrid, b, cold, Tolerance(1e-8));
  const SolveReport fromGuess = Solve(multigrid, b, warm, Tolerance(1e-8));
  EXPECT_TRUE(fromGuess.converged);
  EXPECT_LT(2 * fromGuess.iterations, fromZero.iterations);
  EXPECT_LT(fromGuess.history.front().energy, 1e-3);
  EXPECT_EQ(Solve(multigrid, b, done, Tolerance(1e-8)).iterations, 0);
  EXPECT_LT(RelativeDifference(done, exact), 1e-13); // the condition number is about 100
}

double EnergyOf(const Multigrid& multigrid, const MultiVector& x)
{
  return std::sqrt(x.cwiseProduct(Applied(multigrid, x)).sum());
}

TEST_P(Solvers, LastCorrectionLowersTheError)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector exact = RandomValues(multigrid.Matrix().rows, 1);
  MultiVector measured = MultiVector::Zero(exact.rows(), 1);
  MultiVector corrected = measured;
  const MultiVector b = Applied(multigrid, exact);
  const SolveReport report = Solve(multigrid, b, corrected, Tolerance(1e-6));
  SolveOptions options = Tolerance(1e-300, report.iterations); // as many iterations, not converged
  Solve(multigrid, b, measured, options);
  MultiVector correction;
  multigrid.Precondition(b - Applied(multigrid, measured), correction);
  // The correction is about 1e-6 of x, and in single precision.
  EXPECT_LT(RelativeDifference(corrected, measured + correction), 1e-12);
  // A cycle reduces the energy of every error, on a solid by more than a factor of five.
  EXPECT_LT(5.0 * EnergyOf(multigrid, corrected - exact), EnergyOf(multigrid, measured - exact));
}

TEST_P(Solvers, ReferenceOfAStartIsAboveNoneAndBelowTheSolution)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector exact = RandomValues(multigrid.Matrix().rows, 1, 1);
  const MultiVector b = Applied(multigrid, exact);
  MultiVector Bb;
  multigrid.Precondition(b, Bb);
  const double ofZero = std::sqrt(b.cwiseProduct(Bb).sum());
  const auto referenceOf = [&](MultiVector x)
  {
    MultiVector r = b - Applied(multigrid, x);
    MultiVector Br;
    multigrid.Precondition(r, Br);
    return std::sqrt(r.cwiseProduct(Br).sum()) /
           Solve(multigrid, b, x, Tolerance(1e-6)).history.front().energy;
  };
  // A multiple of the solution reaches the Cauchy-Schwarz bound.
  EXPECT_NEAR(referenceOf(0.6 * exact) / EnergyOf(multigrid, exact), 1.0, 1e-12);
  const MultiVector near = exact + 0.1 * RandomValues(b.rows(), 1, 2);
  EXPECT_LT(referenceOf(near), EnergyOf(multigrid, exact));
  EXPECT_NEAR(
    referenceOf(near), near.cwiseProduct(b).sum() / EnergyOf(multigrid, near), 1e-12 * ofZero);
  // Starts that are worse than zero.
  EXPECT_NEAR(referenceOf(-2.0 * exact) / ofZero, 1.0, 1e-12);
  EXPECT_NEAR(referenceOf(100.0 * RandomValues(b.rows(), 1, 3)) / ofZero, 1.0, 1e-12);
}

TEST_P(Solvers, StartFromZeroWhereTheStartIsFarBeyond)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector b = Applied(multigrid, RandomValues(multigrid.Matrix().rows, 1, 1));
  MultiVector fromZero = MultiVector::Zero(b.rows(), 1);
  const SolveReport expected = Solve(multigrid, b, fromZero, Tolerance(1e-6));
  MultiVector x = 1e12 * RandomValues(b.rows(), 1, 3); // would end the iteration as divergence
  const SolveReport report = Solve(multigrid, b, x, Tolerance(1e-6));
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, expected.iterations);
  EXPECT_EQ(report.history.front().energy, 1.0);
  EXPECT_EQ(x, fromZero);
}

TEST_P(Solvers, ManyColumnsEqualOneByOne)
{
  const Multigrid multigrid = SolidProblem();
  for (const int width : { 2, 3, 8, 11 })
  {
    MultiVector b = RandomValues(multigrid.Matrix().rows, width);
    b.col(0) = Applied(multigrid, MultiVector::Ones(b.rows(), 1)); // converges before the others
    b.col(1) *= 1e9;
    MultiVector together = MultiVector::Zero(b.rows(), width);
    const SolveReport report = Solve(multigrid, b, together, Tolerance(1e-8));
    int worst = 0;
    for (Id c = 0; c < width; ++c)
    {
      MultiVector alone = MultiVector::Zero(b.rows(), 1);
      worst = std::max(worst, Solve(multigrid, b.col(c), alone, Tolerance(1e-8)).iterations);
      // The same steps, with another order of summation.
      EXPECT_LT(RelativeDifference(together.col(c), alone), 1e-11);
    }
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.iterations, worst);
  }
}

TEST_P(Solvers, ThreadsDoNotChangeABit)
{
  MultigridOptions one;
  MultigridOptions two;
  one.threads = 1;
  two.threads = 2;
  const auto samples = testing::TiltedPlane(5, 2.3, 0.7);
  const Multigrid serial = Make(samples, 6, 0.01, one);
  const Multigrid parallel = Make(samples, 6, 0.01, two);
  const MultiVector b = RandomValues(serial.Matrix().rows, 3);
  MultiVector x1 = MultiVector::Zero(b.rows(), 3);
  MultiVector x2 = x1;
  const SolveReport report1 = Solve(serial, b, x1, Tolerance(1e-8, 5));
  const SolveReport report2 = Solve(parallel, b, x2, Tolerance(1e-8, 5));
  EXPECT_EQ(x1, x2);
  EXPECT_EQ(report1.history.back().energy, report2.history.back().energy);
}

TEST_P(Solvers, SingularSystemsWithAProjection)
{
  const Multigrid multigrid = SolidProblem(0.0);
  MultiVector exact = RandomValues(multigrid.Matrix().rows, 2);
  RemoveMean(exact);
  // The projection removes an inconsistent part of b.
  const MultiVector b = Applied(multigrid, exact).array() + 0.5;
  MultiVector x = MultiVector::Zero(b.rows(), 2);
  const SolveReport report = Solve(multigrid, b, x, Tolerance(1e-10), { RemoveMean, RemoveMean });
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 25);
  EXPECT_LT(RelativeDifference(x, exact), 1e-8);
}

TEST_P(Solvers, SingularConsistentSystemsWithoutAProjection)
{
  const Multigrid multigrid = SolidProblem(0.0);
  MultiVector exact = RandomValues(multigrid.Matrix().rows, 1);
  RemoveMean(exact);
  MultiVector x = MultiVector::Zero(exact.rows(), 1);
  EXPECT_TRUE(Solve(multigrid, Applied(multigrid, exact), x, Tolerance(1e-8)).converged);
  RemoveMean(x);
  EXPECT_LT(RelativeDifference(x, exact), 1e-6);
}

TEST_P(Solvers, ZeroRightHandSideGivesZero)
{
  const Multigrid multigrid = SolidProblem();
  MultiVector b = RandomValues(multigrid.Matrix().rows, 2, 1);
  b.col(1).setZero();
  MultiVector x = RandomValues(b.rows(), 2, 2);
  const SolveReport report = Solve(multigrid, b, x, Tolerance(1e-8));
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(x.col(1).norm(), 0.0);
  b.setZero();
  const SolveReport nothing = Solve(multigrid, b, x, Tolerance(1e-8));
  EXPECT_TRUE(nothing.converged);
  EXPECT_EQ(nothing.iterations, 0);
  EXPECT_EQ(x.norm(), 0.0);
}

TEST_P(Solvers, NaNInOneColumnIsReportedAndStaysThere)
{
  const Multigrid multigrid = SolidProblem();
  MultiVector b = RandomValues(multigrid.Matrix().rows, 3);
  MultiVector good = MultiVector::Zero(b.rows(), 1);
  Solve(multigrid, b.col(0), good, Tolerance(1e-8));
  b(5, 1) = NaN;
  b(7, 2) = std::numeric_limits<double>::infinity();
  MultiVector x = MultiVector::Zero(b.rows(), 3);
  const SolveReport report = Solve(multigrid, b, x, Tolerance(1e-8));
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(x.allFinite());
  EXPECT_TRUE(std::isnan(report.history.back().energy));
  EXPECT_LT(RelativeDifference(x.col(0), good), 1e-11);
}

TEST_P(Solvers, UnsolvableSystemsAreNotCalledConverged)
{
  // The functions above the flat square have zero rows, but their b is not zero.
  const Multigrid multigrid = Make(testing::FlatSquare(3), 3, 0.1);
  MultiVector b = MultiVector::Zero(multigrid.Matrix().rows, 1);
  const std::vector<double> diagonal = multigrid.Matrix().Diagonal();
  for (Id i = 0; i < b.rows(); ++i)
  {
    b(i, 0) = diagonal[i] > 0.0 ? 0.0 : 1.0;
  }
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  EXPECT_FALSE(Solve(multigrid, b, x, Tolerance(1e-8)).converged);
  EXPECT_TRUE(x.allFinite());
}

TEST_P(Solvers, IndefiniteSystemsEndWithoutSuccess)
{
  auto levels = testing::SampledHierarchy(testing::SolidCube(2), 2, 1, -1.0, 0.1);
  const Multigrid multigrid(std::move(levels), {});
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 2);
  MultiVector x = MultiVector::Zero(b.rows(), 2);
  const SolveReport report = Solve(multigrid, b, x, Tolerance(1e-8));
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(x.allFinite());
}

TEST_P(Solvers, TooFewIterationsAreNotSuccess)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 1);
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  const SolveReport report = Solve(multigrid, b, x, Tolerance(1e-8, 2));
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 2);
}

TEST_P(Solvers, ImpossibleTolerancesAreNotCalledReached)
{
  // Rounding bounds the true residual from below. An updated residual would keep falling.
  const Multigrid multigrid = SolidProblem(1e-6);
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 1);
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  const SolveReport report = Solve(multigrid, b, x, Tolerance(1e-22, 60));
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(x.allFinite());
}

TEST_P(Solvers, ReportProgressAndAbort)
{
  const Multigrid multigrid = SolidProblem();
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 1);
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  std::vector<double> fractions;
  const auto report = [&](double fraction)
  {
    fractions.push_back(fraction);
    return true;
  };
  const SolveReport solved = Solve(multigrid, b, x, Tolerance(1e-8), {}, Progress(report));
  EXPECT_EQ(int(fractions.size()), solved.iterations);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_LE(fractions.back(), 1.0);
  x.setZero();
  const Progress stop([](double) { return false; });
  EXPECT_THROW(Solve(multigrid, b, x, Tolerance(1e-8), {}, stop), Aborted);
}

TEST_P(Solvers, BrokenInputIsRefused)
{
  const Multigrid multigrid = SolidProblem();
  const Id rows = multigrid.Matrix().rows;
  const MultiVector b = MultiVector::Ones(rows, 1);
  MultiVector x = MultiVector::Zero(rows, 1);
  MultiVector wide = MultiVector::Zero(rows, 2);
  MultiVector bad = MultiVector::Constant(rows, 1, NaN);
  EXPECT_THROW(Solve(multigrid, b, wide, Tolerance(1e-8)), InvalidInput);
  EXPECT_THROW(Solve(multigrid, b.topRows(3), x, Tolerance(1e-8)), InvalidInput);
  EXPECT_THROW(Solve(multigrid, b, bad, Tolerance(1e-8)), InvalidInput);
  EXPECT_THROW(Solve(multigrid, b, x, Tolerance(0.0)), InvalidInput);
  EXPECT_THROW(Solve(multigrid, b, x, Tolerance(NaN)), InvalidInput);
  EXPECT_THROW(Solve(multigrid, b, x, Tolerance(1e-8, 0)), InvalidInput);
}

TEST_P(Solvers, NoColumnsIsSolvedAtOnce)
{
  const Multigrid multigrid = SolidProblem();
  MultiVector x(multigrid.Matrix().rows, 0);
  EXPECT_TRUE(Solve(multigrid, x, x, Tolerance(1e-8)).converged);
}

/// A diagonal matrix with four values, as an operator without a matrix.
LinearOperator FourValues(Id rows)
{
  LinearOperator A;
  A.rows = rows;
  A.multiply = [](const MultiVector& x, MultiVector& y)
  {
    y = x;
    for (Id row = 0; row < y.rows(); ++row)
    {
      y.row(row) *= 1.0 + double(row % 4);
    }
  };
  A.residual = [multiply = A.multiply](const MultiVector& x, const MultiVector& b, MultiVector& r)
  {
    multiply(x, r);
    r = b - r;
  };
  A.products = [](const MultiVector& x, const MultiVector& y) -> Columns
  { return x.cwiseProduct(y).colwise().sum().transpose(); };
  return A;
}

TEST(ConjugateGradients, EndAfterAsManyStepsAsAnyOperatorHasValues)
{
  const Preconditioner none = [](const MultiVector& r, MultiVector& z) { z = r; };
  const LinearOperator A = FourValues(1000);
  const MultiVector exact = RandomValues(A.rows, 2);
  MultiVector b;
  A.multiply(exact, b);
  MultiVector x = MultiVector::Zero(A.rows, 2);
  const SolveReport report = SolveConjugateGradients(A, none, b, x, Tolerance(1e-12));
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 4);
  EXPECT_LT(RelativeDifference(x, exact), 1e-12);
}

// A step along a direction that the preconditioner amplifies would leave more than the rounding it
// was made of.
TEST(ConjugateGradients, TakeNoStepThatNobodyLooksAt)
{
  const LinearOperator A = FourValues(1000);
  for (const double largest : { 1e6, 1e8, 1e10 })
  {
    const Preconditioner uneven = [largest](const MultiVector& r, MultiVector& z)
    {
      z = r;
      z.topRows(4) *= largest;
    };
    const MultiVector exact = RandomValues(A.rows, 4);
    MultiVector b;
    A.multiply(exact, b);
    MultiVector x = MultiVector::Zero(A.rows, 4);
    const SolveReport report = SolveConjugateGradients(A, uneven, b, x, Tolerance(1e-9));
    EXPECT_TRUE(report.converged) << largest;
    EXPECT_LT(RelativeDifference(x, exact), 1e-8) << largest;
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Solvers, ::testing::Values(&SolveConjugateGradients, &SolveCycles),
  [](const auto& test)
  { return test.param == &SolveConjugateGradients ? "ConjugateGradients" : "Cycles"; });

TEST(ConjugateGradients, IterationsGrowSlowlyOnASurface)
{
  // One W(1,1) cycle of patches. The hard case is an error with all frequencies on a plane nearly
  // parallel to the grid. Its growth per level is bounded, but not zero. [NUMERICS §1]
  int before = 12;
  for (const int depth : { 3, 4, 5 })
  {
    const Multigrid multigrid =
      Make(testing::TiltedPlane(depth, 0.3 * (1 << depth), 0.02), depth, 1e-4);
    const MultiVector exact = RandomValues(multigrid.Matrix().rows, 1);
    MultiVector x = MultiVector::Zero(exact.rows(), 1);
    const SolveReport report = SolveConjugateGradients(
      OperatorOf(multigrid), CycleOf(multigrid), Applied(multigrid, exact), x, Tolerance(1e-8));
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 1.8 * before) << depth;
    before = report.iterations;
  }
}

TEST(ConjugateGradients, IterationsDoNotDependOnTheSizeOfASolid)
{
  for (const int depth : { 2, 3, 4 })
  {
    const Multigrid multigrid = Make(testing::SolidCube(depth), depth, 1e-3);
    const MultiVector b = RandomValues(multigrid.Matrix().rows, 1);
    MultiVector x = MultiVector::Zero(b.rows(), 1);
    const SolveReport report =
      SolveConjugateGradients(OperatorOf(multigrid), CycleOf(multigrid), b, x, Tolerance(1e-8));
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 6) << depth;
  }
}

TEST(ConjugateGradients, AreFasterThanCyclesAlone)
{
  const Multigrid multigrid = Make(testing::TiltedPlane(5, 2.3, 0.3), 5, 1e-3);
  const MultiVector b = Applied(multigrid, RandomValues(multigrid.Matrix().rows, 1));
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  MultiVector y = x;
  const SolveReport krylov =
    SolveConjugateGradients(OperatorOf(multigrid), CycleOf(multigrid), b, x, Tolerance(1e-8));
  const SolveReport cycles =
    SolveCycles(OperatorOf(multigrid), CycleOf(multigrid), b, y, Tolerance(1e-8, 200));
  EXPECT_TRUE(krylov.converged);
  EXPECT_LT(krylov.iterations, cycles.iterations);
}

} // namespace
} // namespace gridfem
