// Solves that fail in single precision go on in double precision.
#include "Krylov/PrecisionFallback.h"
#include "Krylov/Stagnation.h"
#include "PrecisionChecks.h"
#include "SampledHierarchy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

using testing::RandomValues;

/// Patches that do not overlap, without a coarser level. A cycle solves them one by one. Each has
/// rank `seen` except for `hidden`, like functions on a nearly flat piece of surface.
Multigrid NearlyDependentPatches(int seen, double hidden, FactorPrecision precision)
{
  constexpr int Count = 100;
  constexpr int N = PatchKernelWidth;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(N * Count, N * Count);
  std::vector<MultigridLevel> levels(2);
  PatchOrder& order = levels[0].order;
  for (int k = 0; k < Count; ++k)
  {
    const Eigen::MatrixXd R = RandomValues(N, N, k + 1);
    A.block(N * k, N * k, N, N) =
      R.leftCols(seen) * R.leftCols(seen).transpose() +
      hidden * R.rightCols(N - seen) * R.rightCols(N - seen).transpose();
  }
  order.dof.size = N;
  order.dof.unknown.resize(N * Count);
  std::iota(order.dof.unknown.begin(), order.dof.unknown.end(), 0);
  order.blockBegin = { 0, Count };
  order.colorBegin = { 0, 1 };
  levels[0].A = testing::Sparse(A);
  levels[0].prolongation = testing::Sparse(Eigen::MatrixXd::Zero(N * Count, 1));
  levels[1].A = testing::Sparse(Eigen::MatrixXd::Identity(1, 1));
  MultigridOptions options;
  options.precision = precision;
  return Multigrid(std::move(levels), options);
}

/// A plane across a grid.
Multigrid Plane(const MultigridOptions& options)
{
  return Multigrid(
    testing::SampledHierarchy(testing::TiltedPlane(5, 2.3, 0.7), 5, 1, 0.1, 1.0), options);
}

MultiVector Applied(const Multigrid& multigrid, const MultiVector& x)
{
  MultiVector y;
  Multiply(multigrid.Matrix(), x, y);
  return y;
}

SolveOptions Tolerance(double tolerance, int maximumIterations)
{
  SolveOptions options;
  options.tolerance = tolerance;
  options.maximumIterations = maximumIterations;
  return options;
}

/// |x - exact| / |exact|, both in the energy norm.
double Error(const Multigrid& multigrid, const MultiVector& x, const MultiVector& exact)
{
  const MultiVector error = x - exact;
  return std::sqrt(error.cwiseProduct(Applied(multigrid, error)).sum() /
                   exact.cwiseProduct(Applied(multigrid, exact)).sum());
}

class Fallback : public ::testing::TestWithParam<IterationType>
{
protected:
  static SolveReport WithFallback(
    const Multigrid& multigrid, const MultiVector& b, MultiVector& x, const SolveOptions& options)
  {
    x = MultiVector::Zero(b.rows(), b.cols());
    return SolveWithFallback(
      GetParam(), OperatorOf(multigrid), CycleWithFallback(multigrid), b, x, options);
  }

  static SolveReport Without(
    const Multigrid& multigrid, const MultiVector& b, MultiVector& x, const SolveOptions& options)
  {
    x = MultiVector::Zero(b.rows(), b.cols());
    return GetParam() == IterationType::Cycles
             ? SolveCycles(OperatorOf(multigrid), CycleOf(multigrid), b, x, options)
             : SolveConjugateGradients(OperatorOf(multigrid), CycleOf(multigrid), b, x, options);
  }
};

void ExpectOneHistory(const SolveReport& report)
{
  ASSERT_EQ(report.history.size(), std::size_t(report.iterations) + 1);
  for (std::size_t i = 0; i < report.history.size(); ++i)
  {
    EXPECT_EQ(report.history[i].iteration, int(i));
  }
  EXPECT_NEAR(std::pow(report.convergenceFactor, report.iterations) *
                report.history.front().energy / report.history.back().energy,
    1.0, 1e-12);
}

TEST_P(Fallback, FactorsThatAreNotPositiveAnyMore)
{
  // Rounding is 6e-8 / sqrt(1e-13): local solves overshoot, and the cycle is indefinite. In double
  // precision a cycle is exact up to 1e-16 / sqrt(1e-13).
  const Multigrid single = NearlyDependentPatches(1, 1e-13, FactorPrecision::Single);
  const MultiVector exact = RandomValues(single.Matrix().rows, 2);
  const MultiVector b = Applied(single, exact);
  const SolveOptions options = Tolerance(1e-7, 100);
  MultiVector x;
  EXPECT_EQ(Without(single, b, x, options).end, SolveEnd::Breakdown);
  const SolveReport report = WithFallback(single, b, x, options);
  EXPECT_TRUE(report.converged);
  EXPECT_GE(report.doubleSince, 1);
  EXPECT_LE(report.iterations, report.doubleSince + 1);
  EXPECT_LT(Error(single, x, exact), 1e-7);
  ExpectOneHistory(report);
}

TEST_P(Fallback, FactorsThatSlowDown)
{
  // In single precision conjugate gradients need 60 iterations and end 8e-4 off, because rounding
  // of their steps adds up. 1000 cycles do not suffice.
  const Multigrid single = NearlyDependentPatches(1, 2e-13, FactorPrecision::Single);
  const MultiVector exact = RandomValues(single.Matrix().rows, 2);
  const MultiVector b = Applied(single, exact);
  const SolveOptions options = Tolerance(1e-11, Stagnation::PaceWindow + 10);
  MultiVector x;
  EXPECT_EQ(Without(single, b, x, options).end, SolveEnd::IterationLimit);
  const double before = Error(single, x, exact);
  const SolveReport report = WithFallback(single, b, x, options);
  EXPECT_GE(report.doubleSince, Stagnation::PaceWindow);
  EXPECT_LT(100.0 * Error(single, x, exact), before);
  ExpectOneHistory(report);
}

TEST_P(Fallback, ThreadsDoNotChangeABit)
{
  std::vector<MultiVector> x(2);
  std::vector<SolveReport> report;
  for (const int threads : { 1, 2 })
  {
    MultigridOptions options;
    options.threads = threads;
    const Multigrid multigrid = Plane(options);
    // The tolerance is below rounding, so both precisions are too slow.
    report.push_back(
      WithFallback(multigrid, Applied(multigrid, RandomValues(multigrid.Matrix().rows, 3)),
        x[threads - 1], Tolerance(1e-40, 30)));
  }
  EXPECT_GE(report[0].doubleSince, Stagnation::PaceWindow);
  EXPECT_EQ(report[0].doubleSince, report[1].doubleSince);
  EXPECT_EQ(x[0], x[1]);
}

TEST_P(Fallback, IsNotThereForWhatConverges)
{
  const Multigrid multigrid(testing::SampledHierarchy(testing::SolidCube(3), 3, 1, 0.1, 1.0), {});
  ASSERT_TRUE(multigrid.HasSingleFactors());
  const MultiVector b = Applied(multigrid, RandomValues(multigrid.Matrix().rows, 2));
  MultiVector x;
  MultiVector expected;
  const SolveReport report = WithFallback(multigrid, b, x, Tolerance(1e-12, 100));
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.doubleSince, -1);
  Without(multigrid, b, expected, Tolerance(1e-12, 100));
  EXPECT_EQ(x, expected);
}

TEST_P(Fallback, EndsAtAStandstill)
{
  // Rounding ends both iterations, long before the limit.
  const Multigrid multigrid = Plane({});
  const MultiVector b = Applied(multigrid, RandomValues(multigrid.Matrix().rows, 1));
  MultiVector x;
  const SolveReport report = WithFallback(multigrid, b, x, Tolerance(1e-40, 5000));
  EXPECT_FALSE(report.converged);
  EXPECT_GE(report.doubleSince, Stagnation::PaceWindow);
  EXPECT_EQ(report.end, SolveEnd::Stagnation);
  EXPECT_LT(report.iterations, 5000);
  EXPECT_TRUE(x.allFinite());
}

TEST_P(Fallback, LeavesOtherCyclesAlone)
{
  MultigridOptions gaussSeidel;
  gaussSeidel.smoother = SmootherType::GaussSeidel;
  MultigridOptions inDouble;
  inDouble.precision = FactorPrecision::Double;
  for (const MultigridOptions& options : { gaussSeidel, inDouble })
  {
    const Multigrid multigrid = Plane(options);
    EXPECT_FALSE(multigrid.HasSingleFactors());
    const MultiVector b = Applied(multigrid, RandomValues(multigrid.Matrix().rows, 1));
    MultiVector x;
    const SolveReport report = WithFallback(multigrid, b, x, Tolerance(1e-40, 100));
    EXPECT_EQ(report.doubleSince, -1);
    EXPECT_EQ(report.end, SolveEnd::IterationLimit);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Fallback,
  ::testing::Values(IterationType::ConjugateGradients, IterationType::Cycles),
  [](const auto& test)
  { return test.param == IterationType::Cycles ? "Cycles" : "ConjugateGradients"; });

TEST(PrecisionFallback, GoesOnWithTheHierarchyThatIsBuiltInDoublePrecision)
{
  MultigridOptions inDouble;
  inDouble.precision = FactorPrecision::Double;
  testing::ExpectCopyInDoublePrecision(Plane({}), Plane(inDouble));
}

} // namespace
} // namespace gridfem
