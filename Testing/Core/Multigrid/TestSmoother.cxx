// Both smoothers, on matrices with and without a grid behind them.
#include "Base/Errors.h"
#include "Multigrid/Smoother.h"
#include "SampledHierarchy.h"
#include "Spaces/PatchOrdering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

using testing::Dense;
using testing::RandomVectors;
using testing::RelativeDifference;
using testing::Sparse;
using Group = std::array<Index, FunctionsPerPatch>;

/// One block, one colour.
PatchOrder OneBlock(std::vector<Group> groups)
{
  PatchOrder order;
  order.blockBegin = { 0, static_cast<Id>(groups.size()) };
  order.colourBegin = { 0, 1 };
  order.dof = std::move(groups);
  return order;
}

Group Single(Index unknown)
{
  return { unknown, -1, -1, -1, -1, -1, -1, -1 };
}

SparseMatrix Laplacian1D(Index size)
{
  Eigen::MatrixXd A = 2.0 * Eigen::MatrixXd::Identity(size, size);
  A.diagonal(1).setConstant(-1.0);
  A.diagonal(-1).setConstant(-1.0);
  return Sparse(A);
}

/// Symmetric and well conditioned: eigenvalues between 1 and 2 or so.
Eigen::MatrixXd RandomSpd(Id size)
{
  const Eigen::MatrixXd R = RandomVectors(size, size, 3);
  return Eigen::MatrixXd::Identity(size, size) + R * R.transpose() / double(size);
}

MultiVector Swept(const Smoother& smoother, const SparseMatrix& A, const MultiVector& b,
  MultiVector x, SweepDirection direction = SweepDirection::Forward, int threads = 1)
{
  smoother.Sweep(A, b, x, direction, threads);
  return x;
}

TEST(GaussSeidel, EqualsTheTextbookOnA1DLaplacian)
{
  const Index n = 10;
  const SparseMatrix A = Laplacian1D(n);
  std::vector<Group> groups;
  for (Index i = 0; i < n; ++i)
  {
    groups.push_back(Single(i));
  }
  const auto smoother = MakeGaussSeidel(A, OneBlock(groups));
  const MultiVector b = RandomVectors(n, 1, 1);
  const MultiVector start = RandomVectors(n, 1, 2);
  Eigen::VectorXd forward = start;
  Eigen::VectorXd backward = start;
  const auto relax = [&](Eigen::VectorXd& x, Index i)
  { x[i] = 0.5 * (b(i, 0) + (i > 0 ? x[i - 1] : 0.0) + (i + 1 < n ? x[i + 1] : 0.0)); };
  for (Index i = 0; i < n; ++i)
  {
    relax(forward, i);
    relax(backward, n - 1 - i);
  }
  // Ten steps of numbers up to 2, each right to rounding.
  EXPECT_LT((Swept(*smoother, A, b, start) - forward).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((Swept(*smoother, A, b, start, SweepDirection::Backward) - backward).norm(), 1e-14);
}

TEST(GaussSeidel, VisitsUnknownsInTheOrderOfTheirFirstPatch)
{
  const SparseMatrix A = Sparse(RandomSpd(7));
  const auto smoother = MakeGaussSeidel(
    A, OneBlock({ { 4, 2, -1, -1, -1, -1, -1, -1 }, { 2, 0, 5, 4, 3, -1, -1, -1 } }));
  const MultiVector b = RandomVectors(7, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(7);
  for (const Index i : { 4, 2, 0, 5, 3 }) // 1 and 6 are in no patch
  {
    x[i] += (b(i, 0) - Dense(A).row(i) * x) / A.Coefficient(i, i);
  }
  EXPECT_LT((Swept(*smoother, A, b, MultiVector::Zero(7, 1)) - x).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(GaussSeidel, LeavesRowsWithoutPositiveDiagonalAlone)
{
  Eigen::MatrixXd D = RandomSpd(5);
  D.row(1).setZero();
  D.col(1).setZero();
  D(3, 3) = -2.0;
  const SparseMatrix A = Sparse(D);
  const auto smoother = MakeGaussSeidel(A, OneBlock({ { 0, 1, 2, 3, 4, -1, -1, -1 } }));
  const MultiVector start = RandomVectors(5, 2, 1);
  const MultiVector x = Swept(*smoother, A, RandomVectors(5, 2, 2), start);
  EXPECT_EQ(x.row(1), start.row(1));
  EXPECT_EQ(x.row(3), start.row(3));
  EXPECT_NE(x.row(0), start.row(0));
}

TEST(PatchSmoother, SolvesExactlyWhenOnePatchCoversEverything)
{
  const SparseMatrix A = Sparse(RandomSpd(8));
  const auto smoother = MakePatchSmoother(A, OneBlock({ { 7, 0, 3, 2, 6, 5, 1, 4 } }));
  const MultiVector exact = RandomVectors(8, 3, 1);
  const MultiVector x = Swept(*smoother, A, Dense(A) * exact, RandomVectors(8, 3, 2));
  // Factors are in single precision, 6e-8; the condition number is below 10.
  EXPECT_LT(RelativeDifference(x, exact), 1e-6);
}

TEST(PatchSmoother, IsMultiplicativeSchwarz)
{
  const Eigen::MatrixXd D = RandomSpd(6);
  const SparseMatrix A = Sparse(D);
  const auto smoother = MakePatchSmoother(
    A, OneBlock({ { 0, 1, 2, -1, -1, -1, -1, -1 }, { -1, 5, 2, 4, -1, 3, -1, -1 } }));
  const MultiVector b = RandomVectors(6, 1, 1);
  Eigen::VectorXd x = RandomVectors(6, 1, 2);
  const MultiVector start = x;
  x.head(3) += D.topLeftCorner(3, 3).ldlt().solve((b - D * x).eval().topRows(3));
  x.tail(4) += D.bottomRightCorner(4, 4).ldlt().solve((b - D * x).eval().bottomRows(4));
  EXPECT_LT((Swept(*smoother, A, b, start) - x).cwiseAbs().maxCoeff(), 1e-6); // single precision
}

/// Rank 4 out of 8, as eight functions act like four on a plane, and the rest at size `hidden`.
Eigen::MatrixXd NearlyDependent(double hidden)
{
  const Eigen::MatrixXd R = RandomVectors(8, 8, 1);
  const Eigen::MatrixXd seen = R.leftCols(4) * R.leftCols(4).transpose();
  return seen + hidden * (R.rightCols(4) * R.rightCols(4).transpose());
}

TEST(PatchSmoother, RoundingOfTheFactorsIsHarmlessHoweverDependentFunctionsAre)
{
  for (const double hidden : { 1.0, 1e-4, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13 })
  {
    const Eigen::MatrixXd D = NearlyDependent(hidden);
    const auto smoother = MakePatchSmoother(Sparse(D), OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
    for (const int width : { 1, 3 })
    {
      // The zero right-hand side: what a sweep leaves of x is the error. Without double precision
      // for small pivots half of the energy is left at 1e-13.
      const MultiVector start = RandomVectors(8, width, 2);
      const MultiVector x = Swept(*smoother, Sparse(D), MultiVector::Zero(8, width), start);
      const double left = (x.transpose() * D * x).trace() / (start.transpose() * D * start).trace();
      EXPECT_LT(std::sqrt(left), 0.05) << hidden;
    }
  }
}

TEST(PatchSmoother, SolvesSingularPatchesOnTheirRange)
{
  const Eigen::MatrixXd D = NearlyDependent(0.0);
  const SparseMatrix A = Sparse(D);
  const auto smoother = MakePatchSmoother(A, OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
  const MultiVector b = D * RandomVectors(8, 1, 2);
  const MultiVector x = Swept(*smoother, A, b, MultiVector::Zero(8, 1));
  // The four kept pivots are above 1e-2; single precision.
  EXPECT_LT(RelativeDifference(D * x, b), 1e-5);
}

TEST(PatchSmoother, LocalInverseDoesNotDependOnTheScaleOfFunctions)
{
  const Eigen::MatrixXd D = RandomSpd(8);
  Eigen::VectorXd scale(8);
  scale << 1, 1e-8, 1e3, 1e-4, 1, 1e7, 1e-2, 1e5;
  const SparseMatrix A = Sparse(scale.asDiagonal() * D * scale.asDiagonal());
  const auto smoother = MakePatchSmoother(A, OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
  const MultiVector exact = RandomVectors(8, 1, 1);
  const MultiVector b = scale.asDiagonal() * (D * exact);
  const MultiVector x = Swept(*smoother, A, b, MultiVector::Zero(8, 1));
  EXPECT_LT(RelativeDifference(scale.asDiagonal() * x, exact), 1e-6);
  // Diagonals that single precision cannot hold: double precision takes over.
  const SparseMatrix huge = Sparse(1e100 * D);
  const auto exactly = MakePatchSmoother(huge, OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
  const MultiVector y = Swept(*exactly, huge, 1e100 * (D * exact), MultiVector::Zero(8, 1));
  EXPECT_LT(RelativeDifference(y, exact), 1e-13);
}

TEST(PatchSmoother, LeavesOutUnknownsThatCannotBeSolvedFor)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(8, 8);
  D.diagonal() << 2.0, 0.0, -1.0, NaN, 4.0, 1e-300, 5.0, 8.0;
  const SparseMatrix A = Sparse(D);
  const auto smoother = MakePatchSmoother(
    A, OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 }, { 1, 3, -1, -1, -1, -1, -1, -1 } }));
  const MultiVector x =
    Swept(*smoother, A, MultiVector::Ones(8, 1), MultiVector::Constant(8, 1, 0.25));
  Eigen::VectorXd expected(8);
  expected << 0.5, 0.25, 0.25, 0.25, 0.25, 0.25, 0.2, 0.125;
  EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-7); // single precision
}

TEST(PatchSmoother, NaNOffTheDiagonalDoesNotReachTheInverse)
{
  Eigen::MatrixXd D = RandomSpd(4);
  D(1, 2) = D(2, 1) = std::numeric_limits<double>::quiet_NaN();
  const SparseMatrix bad = Sparse(D);
  const auto smoother = MakePatchSmoother(bad, OneBlock({ { 0, 1, 2, 3, -1, -1, -1, -1 } }));
  const MultiVector x =
    Swept(*smoother, Sparse(RandomSpd(4)), MultiVector::Ones(4, 1), MultiVector::Zero(4, 1));
  EXPECT_TRUE(x.allFinite());
}

struct Case
{
  bool isPatch;
  int width;
};

class BothSmoothers : public ::testing::TestWithParam<Case>
{
protected:
  static std::unique_ptr<Smoother> Make(const MultigridLevel& level)
  {
    return GetParam().isPatch ? MakePatchSmoother(level.A, level.order)
                              : MakeGaussSeidel(level.A, level.order);
  }
  static MultigridLevel Finest(const std::vector<testing::Sample>& samples, int depth)
  {
    return std::move(testing::SampledHierarchy(samples, depth, depth, 0.1, 1.0).front());
  }
};

TEST_P(BothSmoothers, BackwardSweepIsTheAdjointOfTheForwardOne)
{
  // With zero start a sweep is x = S b; the backward one has to be Sᵀ.
  const MultigridLevel level = Finest(testing::TiltedPlane(4, 1.3, 0.7), 4);
  const auto smoother = Make(level);
  const MultiVector a = RandomVectors(level.A.rows, 1, 1);
  const MultiVector b = RandomVectors(level.A.rows, 1, 2);
  const MultiVector zero = MultiVector::Zero(level.A.rows, 1);
  const MultiVector forward = Swept(*smoother, level.A, a, zero);
  const MultiVector backward = Swept(*smoother, level.A, b, zero, SweepDirection::Backward);
  const double left = (b.transpose() * forward)(0, 0);
  const double right = (a.transpose() * backward)(0, 0);
  // Rounding of local inverses up to 1e10 large, over norms of the vectors in the products.
  EXPECT_LT(std::abs(left - right), 1e-12 * b.norm() * forward.norm());
}

TEST_P(BothSmoothers, ThreadsDoNotChangeABit)
{
  const MultigridLevel level = Finest(testing::TiltedPlane(6, 1.3, 0.7), 6);
  const auto smoother = Make(level);
  const MultiVector b = RandomVectors(level.A.rows, GetParam().width, 1);
  const MultiVector start = RandomVectors(level.A.rows, GetParam().width, 2);
  for (const auto direction : { SweepDirection::Forward, SweepDirection::Backward })
  {
    const MultiVector one = Swept(*smoother, level.A, b, start, direction, 1);
    for (int repeat = 0; repeat < 5; ++repeat)
    {
      EXPECT_EQ(one, Swept(*smoother, level.A, b, start, direction, 2));
    }
    EXPECT_EQ(one, Swept(*smoother, level.A, b, start, direction, 3));
  }
}

TEST_P(BothSmoothers, ColumnsDoNotSeeEachOther)
{
  const MultigridLevel level = Finest(testing::SolidCube(3), 3);
  const auto smoother = Make(level);
  const MultiVector b = RandomVectors(level.A.rows, GetParam().width, 1);
  const MultiVector start = RandomVectors(level.A.rows, GetParam().width, 2);
  const MultiVector together = Swept(*smoother, level.A, b, start);
  for (Id c = 0; c < b.cols(); ++c)
  {
    // Sums of 27 terms in another order, some 30 patches one after the other.
    EXPECT_LT(
      RelativeDifference(together.col(c), Swept(*smoother, level.A, b.col(c), start.col(c))),
      1e-13);
  }
}

TEST_P(BothSmoothers, ReduceTheEnergyOfEveryError)
{
  const MultigridLevel level = Finest(testing::TiltedPlane(4, 0.2, 0.4), 4);
  const auto smoother = Make(level);
  const MultiVector error = RandomVectors(level.A.rows, GetParam().width, 1);
  const MultiVector after =
    Swept(*smoother, level.A, MultiVector::Zero(error.rows(), error.cols()), error);
  MultiVector Ae;
  Multiply(level.A, error, Ae);
  const Eigen::ArrayXd before = (error.array() * Ae.array()).colwise().sum().transpose();
  Multiply(level.A, after, Ae);
  const Eigen::ArrayXd now = (after.array() * Ae.array()).colwise().sum().transpose();
  EXPECT_TRUE((now < 0.9 * before).all());
}

TEST_P(BothSmoothers, BrokenOrdersAreRefused)
{
  MultigridLevel level = Finest(testing::SolidCube(1), 1);
  level.order.dof.front()[3] = level.A.rows;
  EXPECT_THROW(Make(level), InvalidInput);
  level.order.dof.front()[3] = -2;
  EXPECT_THROW(Make(level), InvalidInput);
  level.order.dof.front()[3] = -1;
  EXPECT_NO_THROW(Make(level));
  level.order.blockBegin.back() -= 1;
  EXPECT_THROW(Make(level), InvalidInput);
}

TEST_P(BothSmoothers, WrongShapesAreRefused)
{
  const MultigridLevel level = Finest(testing::SolidCube(1), 1);
  const auto smoother = Make(level);
  MultiVector x = MultiVector::Zero(level.A.rows, 2);
  EXPECT_THROW(
    smoother->Sweep(level.A, x.leftCols(1), x, SweepDirection::Forward, 1), InvalidInput);
  EXPECT_THROW(smoother->Sweep(level.A, x.topRows(3), x, SweepDirection::Forward, 1), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Widths, BothSmoothers,
  ::testing::Values(Case{ true, 1 }, Case{ true, 2 }, Case{ true, 3 }, Case{ true, 4 },
    Case{ true, 8 }, Case{ true, 13 }, Case{ false, 1 }, Case{ false, 3 }, Case{ false, 6 }),
  [](const auto& test)
  { return (test.param.isPatch ? "Patch" : "GaussSeidel") + std::to_string(test.param.width); });

/// Two blocks of one colour are neither the same unknowns nor coupled by the matrix.
void ExpectUncoupled(const SparseMatrix& A, const PatchOrder& order)
{
  for (std::size_t colour = 0; colour + 1 < order.colourBegin.size(); ++colour)
  {
    std::vector<Id> blockOf(A.rows, -1);
    for (Id block = order.colourBegin[colour]; block < order.colourBegin[colour + 1]; ++block)
    {
      for (Id patch = order.blockBegin[block]; patch < order.blockBegin[block + 1]; ++patch)
      {
        for (const Index unknown : order.dof[patch])
        {
          ASSERT_TRUE(blockOf[unknown] < 0 || blockOf[unknown] == block);
          blockOf[unknown] = block;
        }
      }
    }
    for (Index row = 0; row < A.rows; ++row)
    {
      for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
      {
        const Id other = blockOf[A.column[k]];
        ASSERT_TRUE(blockOf[row] < 0 || other < 0 || other == blockOf[row]);
      }
    }
  }
}

TEST(OrderPatches, BlocksOfAColourAreNotCoupled)
{
  for (const int depth : { 1, 3, 4, 6 })
  {
    const auto plane =
      testing::SampledHierarchy(testing::TiltedPlane(depth, 0.3, 0.7), depth, depth, 1.0, 1.0);
    ExpectUncoupled(plane[0].A, plane[0].order);
    EXPECT_LE(plane[0].order.colourBegin.size(), 9u);
  }
  const auto solid = testing::SampledHierarchy(testing::SolidCube(5), 5, 5, 1.0, 1.0);
  ExpectUncoupled(solid[0].A, solid[0].order);
  EXPECT_EQ(solid[0].order.colourBegin.size(), 9u);
  EXPECT_EQ(solid[0].order.blockBegin.size(), 65u);
}

TEST(OrderPatches, EveryPatchOnceAndEmptyLevelsAreFine)
{
  EXPECT_TRUE(OrderPatches(PatchLevel()).dof.empty());
  PatchLevel level;
  for (MortonKey key = 0; key < 4096; key += 3)
  {
    level.cell.push_back(key);
    level.dof.push_back(Single(static_cast<Index>(key)));
  }
  PatchOrder order = OrderPatches(level);
  std::sort(order.dof.begin(), order.dof.end());
  EXPECT_EQ(order.dof, level.dof);
  std::swap(level.cell[1], level.cell[2]);
  EXPECT_THROW(OrderPatches(level), InvalidInput);
}

} // namespace
} // namespace gridfem
