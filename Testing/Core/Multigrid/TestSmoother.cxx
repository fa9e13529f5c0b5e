// Both smoothers, on matrices with and without a grid.
#include "Base/Errors.h"
#include "Dense.h"
#include "Multigrid/Smoother.h"
#include "SampledHierarchy.h"
#include "Spaces/PatchOrdering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

namespace gridfem
{
namespace
{

using testing::Congruent;
using testing::Dense;
using testing::DenseSolution;
using testing::Product;
using testing::ProductWithTransposed;
using testing::RandomValues;
using testing::RelativeDifference;
using testing::Sparse;
using Group = std::array<Index, PatchKernelWidth>;

/// One block of one color.
PatchOrder OneBlock(const UnknownGroups& groups)
{
  PatchOrder order;
  order.blockBegin = { 0, groups.Count() };
  order.colorBegin = { 0, 1 };
  order.dof = groups;
  return order;
}

PatchOrder OneBlock(const std::vector<Group>& groups)
{
  return OneBlock(UnknownGroups(groups));
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

/// A symmetric, well-conditioned matrix with eigenvalues between 1 and about 2.
Eigen::MatrixXd RandomSpd(Id size)
{
  const Eigen::MatrixXd R = RandomValues(size, size, 3);
  return Eigen::MatrixXd::Identity(size, size) + ProductWithTransposed(R, R) / double(size);
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
  const MultiVector b = RandomValues(n, 1, 1);
  const MultiVector start = RandomValues(n, 1, 2);
  Eigen::VectorXd forward = start;
  Eigen::VectorXd backward = start;
  const auto relax = [&](Eigen::VectorXd& x, Index i)
  { x[i] = 0.5 * (b(i, 0) + (i > 0 ? x[i - 1] : 0.0) + (i + 1 < n ? x[i + 1] : 0.0)); };
  for (Index i = 0; i < n; ++i)
  {
    relax(forward, i);
    relax(backward, n - 1 - i);
  }
  // Ten steps with numbers up to 2, each accurate to rounding.
  EXPECT_LT(
    (Swept(*smoother, A, b, start) - forward).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-14);
  EXPECT_LT((Swept(*smoother, A, b, start, SweepDirection::Backward) - backward).norm(), 1e-14);
}

TEST(GaussSeidel, VisitsUnknownsInTheOrderOfTheirFirstPatch)
{
  const SparseMatrix A = Sparse(RandomSpd(7));
  const auto smoother = MakeGaussSeidel(
    A, OneBlock({ { 4, 2, -1, -1, -1, -1, -1, -1 }, { 2, 0, 5, 4, 3, -1, -1, -1 } }));
  const MultiVector b = RandomValues(7, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(7);
  for (const Index i : { 4, 2, 0, 5, 3 }) // 1 and 6 are in no patch
  {
    x[i] += (b(i, 0) - Dense(A).row(i) * x) / A.Coefficient(i, i);
  }
  EXPECT_LT((Swept(*smoother, A, b, MultiVector::Zero(7, 1)) - x)
              .cwiseAbs()
              .maxCoeff<Eigen::PropagateNaN>(),
    1e-14);
}

TEST(GaussSeidel, LeavesRowsWithoutPositiveDiagonalAlone)
{
  Eigen::MatrixXd D = RandomSpd(5);
  D.row(1).setZero();
  D.col(1).setZero();
  D(3, 3) = -2.0;
  const SparseMatrix A = Sparse(D);
  const auto smoother = MakeGaussSeidel(A, OneBlock({ { 0, 1, 2, 3, 4, -1, -1, -1 } }));
  const MultiVector start = RandomValues(5, 2, 1);
  const MultiVector x = Swept(*smoother, A, RandomValues(5, 2, 2), start);
  EXPECT_EQ(x.row(1), start.row(1));
  EXPECT_EQ(x.row(3), start.row(3));
  EXPECT_NE(x.row(0), start.row(0));
}

TEST(PatchSmoother, SolvesExactlyWhenOnePatchCoversEverything)
{
  const Eigen::MatrixXd D = RandomSpd(8);
  const SparseMatrix A = Sparse(D);
  const auto smoother = MakePatchSmoother(A, OneBlock({ { 7, 0, 3, 2, 6, 5, 1, 4 } }));
  const MultiVector exact = RandomValues(8, 3, 1);
  const MultiVector x = Swept(*smoother, A, Product(D, exact), RandomValues(8, 3, 2));
  // Factors are in single precision, 6e-8. The condition number is below 10.
  EXPECT_LT(RelativeDifference(x, exact), 1e-6);
}

TEST(PatchSmoother, IsMultiplicativeSchwarz)
{
  const Eigen::MatrixXd D = RandomSpd(6);
  const SparseMatrix A = Sparse(D);
  const auto smoother = MakePatchSmoother(
    A, OneBlock({ { 0, 1, 2, -1, -1, -1, -1, -1 }, { -1, 5, 2, 4, -1, 3, -1, -1 } }));
  const MultiVector b = RandomValues(6, 1, 1);
  Eigen::VectorXd x = RandomValues(6, 1, 2);
  const MultiVector start = x;
  x.head(3) += DenseSolution(D.topLeftCorner(3, 3), (b - D * x).topRows(3));
  x.tail(4) += DenseSolution(D.bottomRightCorner(4, 4), (b - D * x).bottomRows(4));
  EXPECT_LT((Swept(*smoother, A, b, start) - x).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    1e-6); // single precision
}

/// The textbook sweep, with a dense matrix.
MultiVector SweptInBlocks(const Eigen::MatrixXd& D, const UnknownGroups& groups,
  const MultiVector& b, MultiVector x, SweepDirection direction)
{
  for (Id k = 0; k < groups.Count(); ++k)
  {
    const UnknownGroup group =
      groups[direction == SweepDirection::Forward ? k : groups.Count() - 1 - k];
    std::set<Index> used(group.begin(), group.end());
    used.erase(-1);
    const std::vector<Index> unknowns(used.begin(), used.end());
    const Eigen::MatrixXd rest = b - Product(D, x);
    const Eigen::MatrixXd correction =
      DenseSolution(D(unknowns, unknowns), rest(unknowns, Eigen::indexing::all));
    for (std::size_t i = 0; i < unknowns.size(); ++i)
    {
      x.row(unknowns[i]) += correction.row(static_cast<Id>(i));
    }
  }
  return x;
}

/// Overlapping groups in random order, with unused places and one place twice.
UnknownGroups RandomGroups(Index unknowns, int size)
{
  UnknownGroups groups(size);
  std::mt19937 random(7);
  for (int group = 0; group < 12; ++group)
  {
    std::vector<Index> all(unknowns);
    std::iota(all.begin(), all.end(), 0);
    std::shuffle(all.begin(), all.end(), random);
    all.resize(size);
    all.back() = group % 3 == 0 ? -1 : group % 3 == 1 ? all.front() : all.back();
    groups.Add(all);
  }
  return groups;
}

/// Sizes of patches: 8 for trilinear functions, 27 for quadratic B-splines, 64 for cubic B-splines.
class GroupsOfAnySize : public ::testing::TestWithParam<int>
{
};

TEST_P(GroupsOfAnySize, AreRelaxedOneAfterTheOther)
{
  constexpr Index Unknowns = 100;
  const Eigen::MatrixXd D = RandomSpd(Unknowns);
  const SparseMatrix A = Sparse(D);
  const UnknownGroups groups = RandomGroups(Unknowns, GetParam());
  const auto smoother = MakePatchSmoother(A, OneBlock(groups));
  const auto single = MakeSinglePatchSmoother(A, OneBlock(groups));
  EXPECT_EQ(smoother->HasSingleFactors(), GetParam() == PatchKernelWidth);
  EXPECT_EQ(single->UnresolvedPatches(), 0);
  for (const int width : { 1, 3, 13, 32 })
  {
    for (const auto direction : { SweepDirection::Forward, SweepDirection::Backward })
    {
      const MultiVector b = RandomValues(Unknowns, width, 1);
      const MultiVector start = RandomValues(Unknowns, width, 2);
      const MultiVector expected = SweptInBlocks(D, groups, b, start, direction);
      // Groups of eight have factors in single precision.
      EXPECT_LT(RelativeDifference(Swept(*smoother, A, b, start, direction), expected),
        GetParam() == PatchKernelWidth ? 1e-6 : 1e-13);
      Vectors<float> x = start.cast<float>();
      single->Sweep(InSinglePrecision(A, 1), b.cast<float>(), x, direction, 1);
      EXPECT_LT(RelativeDifference(x.cast<double>(), expected), 2e-6);
    }
  }
}

TEST_P(GroupsOfAnySize, SolveForWhatCanBeSolvedFor)
{
  const int size = GetParam();
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(size + 3, size + 3);
  D.topLeftCorner(size, size).setOnes(); // rank 1
  D(size, size) = -1.0;
  D(size + 1, size + 1) = NaN;
  D(size + 2, size + 2) = 4.0;
  const SparseMatrix A = Sparse(D);
  UnknownGroups groups(size);
  std::vector<Index> group(size);
  std::iota(group.begin(), group.end(), 0);
  groups.Add(group);
  std::iota(group.begin(), group.end(), 3); // includes the last three unknowns
  groups.Add(group);
  groups.Add(std::vector<Index>(size, size)); // no unknown can be solved for
  groups.Add(std::vector<Index>(size, -1));
  const MultiVector b = MultiVector::Constant(size + 3, 1, 2.0);
  const MultiVector x =
    Swept(*MakePatchSmoother(A, OneBlock(groups)), A, b, MultiVector::Zero(size + 3, 1));
  EXPECT_NEAR(x.topRows(size).sum(), 2.0, 1e-6);
  EXPECT_EQ(x(size, 0), 0.0);
  EXPECT_EQ(x(size + 1, 0), 0.0);
  EXPECT_NEAR(x(size + 2, 0), 0.5, 1e-7);
  const auto single = MakeSinglePatchSmoother(A, OneBlock(groups));
  EXPECT_EQ(single->UnresolvedPatches(), 2);
}

TEST_P(GroupsOfAnySize, ThatSinglePrecisionDoesNotHoldAreLeftAlone)
{
  const int size = GetParam();
  UnknownGroups groups(size);
  std::vector<Index> group(size);
  std::iota(group.begin(), group.end(), 0);
  groups.Add(group);
  const Eigen::MatrixXd D = RandomSpd(size);
  const SparseMatrix huge = Sparse(1e100 * D);
  const MultiVector exact = RandomValues(size, 2, 1);
  const MultiVector x = Swept(*MakePatchSmoother(huge, OneBlock(groups)), huge,
    1e100 * Product(D, exact), MultiVector::Zero(size, 2));
  EXPECT_LT(RelativeDifference(x, exact), 1e-13);
  const auto single = MakeSinglePatchSmoother(huge, OneBlock(groups));
  EXPECT_EQ(single->UnresolvedPatches(), 1);
  Vectors<float> left = exact.cast<float>();
  single->Sweep(InSinglePrecision(Sparse(D), 1), Vectors<float>::Zero(size, 2), left,
    SweepDirection::Forward, 1);
  EXPECT_EQ(left, exact.cast<float>());
}

INSTANTIATE_TEST_SUITE_P(Sizes, GroupsOfAnySize, ::testing::Values(5, 7, 8, 9, 27, 64),
  ::testing::PrintToStringParamName());

TEST(PatchSmoother, RefusesGroupsThatAreTooLarge)
{
  const SparseMatrix A = Sparse(RandomSpd(65));
  EXPECT_NO_THROW(MakePatchSmoother(A, OneBlock(UnknownGroups(64))));
  EXPECT_THROW(MakePatchSmoother(A, OneBlock(UnknownGroups(65))), InvalidInput);
}

/// Rank 4 out of 8, plus a rest of size `hidden`: eight functions on a plane act like four.
Eigen::MatrixXd NearlyDependent(double hidden)
{
  const Eigen::MatrixXd R = RandomValues(8, 8, 1);
  const Eigen::MatrixXd seen = ProductWithTransposed(R.leftCols(4), R.leftCols(4));
  return seen + hidden * ProductWithTransposed(R.rightCols(4), R.rightCols(4));
}

TEST(PatchSmoother, RoundingOfTheFactorsIsHarmlessHoweverDependentFunctionsAre)
{
  for (const double hidden : { 1.0, 1e-4, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13 })
  {
    const Eigen::MatrixXd D = NearlyDependent(hidden);
    const auto smoother = MakePatchSmoother(Sparse(D), OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
    for (const int width : { 1, 3 })
    {
      // With a zero right-hand side, x after a sweep is the error. Without double precision for
      // small pivots, half of the energy would be left at 1e-13.
      const MultiVector start = RandomValues(8, width, 2);
      const MultiVector x = Swept(*smoother, Sparse(D), MultiVector::Zero(8, width), start);
      const double left = Congruent(D, x).trace() / Congruent(D, start).trace();
      EXPECT_LT(std::sqrt(left), 0.05) << hidden;
    }
  }
}

TEST(PatchSmoother, SolvesSingularPatchesOnTheirRange)
{
  const Eigen::MatrixXd D = NearlyDependent(0.0);
  const SparseMatrix A = Sparse(D);
  const auto smoother = MakePatchSmoother(A, OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
  const MultiVector b = Product(D, RandomValues(8, 1, 2));
  const MultiVector x = Swept(*smoother, A, b, MultiVector::Zero(8, 1));
  // The four kept pivots are above 1e-2, in single precision.
  EXPECT_LT(RelativeDifference(Product(D, x), b), 1e-5);
}

TEST(PatchSmoother, LocalInverseDoesNotDependOnTheScaleOfFunctions)
{
  const Eigen::MatrixXd D = RandomSpd(8);
  Eigen::VectorXd scale(8);
  scale << 1, 1e-8, 1e3, 1e-4, 1, 1e7, 1e-2, 1e5;
  const SparseMatrix A = Sparse(scale.asDiagonal() * D * scale.asDiagonal());
  const auto smoother = MakePatchSmoother(A, OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
  const MultiVector exact = RandomValues(8, 1, 1);
  const MultiVector b = scale.asDiagonal() * Product(D, exact);
  const MultiVector x = Swept(*smoother, A, b, MultiVector::Zero(8, 1));
  EXPECT_LT(RelativeDifference(scale.asDiagonal() * x, exact), 1e-6);
  // Single precision cannot hold these diagonals, so double precision takes over.
  const SparseMatrix huge = Sparse(1e100 * D);
  const auto exactly = MakePatchSmoother(huge, OneBlock({ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
  const MultiVector y = Swept(*exactly, huge, 1e100 * Product(D, exact), MultiVector::Zero(8, 1));
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
  EXPECT_LT((x - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-7); // single precision
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
  // From a zero start a sweep is x = S b. The backward sweep has to be Sᵀ.
  const MultigridLevel level = Finest(testing::TiltedPlane(4, 1.3, 0.7), 4);
  const auto smoother = Make(level);
  const MultiVector a = RandomValues(level.A.rows, 1, 1);
  const MultiVector b = RandomValues(level.A.rows, 1, 2);
  const MultiVector zero = MultiVector::Zero(level.A.rows, 1);
  const MultiVector forward = Swept(*smoother, level.A, a, zero);
  const MultiVector backward = Swept(*smoother, level.A, b, zero, SweepDirection::Backward);
  const double left = (b.transpose() * forward)(0, 0);
  const double right = (a.transpose() * backward)(0, 0);
  // Rounding of local inverses up to 1e10, relative to the norms of the vectors in the products.
  EXPECT_LT(std::abs(left - right), 1e-12 * b.norm() * forward.norm());
}

TEST_P(BothSmoothers, ThreadsDoNotChangeABit)
{
  const MultigridLevel level = Finest(testing::TiltedPlane(6, 1.3, 0.7), 6);
  const auto smoother = Make(level);
  const MultiVector b = RandomValues(level.A.rows, GetParam().width, 1);
  const MultiVector start = RandomValues(level.A.rows, GetParam().width, 2);
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
  const MultiVector b = RandomValues(level.A.rows, GetParam().width, 1);
  const MultiVector start = RandomValues(level.A.rows, GetParam().width, 2);
  const MultiVector together = Swept(*smoother, level.A, b, start);
  for (Id c = 0; c < b.cols(); ++c)
  {
    // Sums of 27 terms in another order, in about 30 successive patches.
    EXPECT_LT(
      RelativeDifference(together.col(c), Swept(*smoother, level.A, b.col(c), start.col(c))),
      1e-13);
  }
}

TEST_P(BothSmoothers, ReduceTheEnergyOfEveryError)
{
  const MultigridLevel level = Finest(testing::TiltedPlane(4, 0.2, 0.4), 4);
  const auto smoother = Make(level);
  const MultiVector error = RandomValues(level.A.rows, GetParam().width, 1);
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
  level.order.dof.unknown[3] = level.A.rows;
  EXPECT_THROW(Make(level), InvalidInput);
  level.order.dof.unknown[3] = -2;
  EXPECT_THROW(Make(level), InvalidInput);
  level.order.dof.unknown[3] = -1;
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

/// Two blocks of one color neither share unknowns nor are coupled by the matrix.
void ExpectUncoupled(const SparseMatrix& A, const PatchOrder& order)
{
  for (std::size_t color = 0; color + 1 < order.colorBegin.size(); ++color)
  {
    std::vector<Id> blockOf(A.rows, -1);
    for (Id block = order.colorBegin[color]; block < order.colorBegin[color + 1]; ++block)
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

TEST(OrderPatches, BlocksOfAColorAreNotCoupled)
{
  for (const int depth : { 1, 3, 4, 6 })
  {
    const auto plane =
      testing::SampledHierarchy(testing::TiltedPlane(depth, 0.3, 0.7), depth, depth, 1.0, 1.0);
    ExpectUncoupled(plane[0].A, plane[0].order);
    EXPECT_LE(plane[0].order.colorBegin.size(), 9u);
  }
  const auto solid = testing::SampledHierarchy(testing::SolidCube(5), 5, 5, 1.0, 1.0);
  ExpectUncoupled(solid[0].A, solid[0].order);
  EXPECT_EQ(solid[0].order.colorBegin.size(), 9u);
  EXPECT_EQ(solid[0].order.blockBegin.size(), 65u);
}

TEST(OrderPatches, EveryPatchOnceAndEmptyLevelsAreFine)
{
  EXPECT_TRUE(OrderPatches(PatchLevel()).dof.IsEmpty());
  PatchLevel level;
  for (MortonKey key = 0; key < 4096; key += 3)
  {
    level.cell.push_back(key);
    level.dof.push_back(Single(static_cast<Index>(key)));
  }
  std::vector<Index> visited; // the first unknown of each patch
  const PatchOrder order = OrderPatches(level);
  for (Id patch = 0; patch < order.dof.Count(); ++patch)
  {
    visited.push_back(order.dof[patch][0]);
  }
  std::sort(visited.begin(), visited.end());
  ASSERT_EQ(visited.size(), level.dof.size());
  for (std::size_t patch = 0; patch < level.dof.size(); ++patch)
  {
    EXPECT_EQ(visited[patch], level.dof[patch][0]);
  }
  std::swap(level.cell[1], level.cell[2]);
  EXPECT_THROW(OrderPatches(level), InvalidInput);
}

} // namespace
} // namespace gridfem
