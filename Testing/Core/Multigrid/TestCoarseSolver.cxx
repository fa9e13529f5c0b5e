// The direct solver: components, rank deficiency, useless rows.
#include "Algebra/PivotedCholesky.h"
#include "Base/Errors.h"
#include "Dense.h"
#include "Multigrid/CoarseSolver.h"
#include "SampledHierarchy.h"
#include "SparseRows.h"

#include <gtest/gtest.h>

#include <limits>

namespace gridfem
{
namespace
{

using testing::DenseEigen;
using testing::RandomValues;
using testing::RelativeDifference;
using testing::Sparse;

Eigen::MatrixXd RandomSemiDefinite(Id size, Id rank)
{
  const Eigen::MatrixXd R = RandomValues(size, rank, 3);
  return R * R.transpose();
}

TEST(PivotedCholesky, FindsRankAndFactorAcrossPanels)
{
  for (const Id size : { 1, 7, 47, 48, 49, 130 })
  {
    for (const Id rank : { Id(1), (size + 1) / 2, std::max<Id>(1, size - 1) })
    {
      const Eigen::MatrixXd S = RandomSemiDefinite(size, rank);
      Eigen::MatrixXd factor = S;
      const std::vector<Index> pivots =
        PivotedCholesky(factor, 1e-10 * S.diagonal().maxCoeff<Eigen::PropagateNaN>());
      ASSERT_EQ(Id(pivots.size()), rank) << size;
      const Eigen::MatrixXd L =
        factor.topLeftCorner(rank, rank).triangularView<Eigen::Lower>().toDenseMatrix();
      const Eigen::MatrixXd product = L * L.transpose();
      for (Id i = 0; i < rank; ++i)
      {
        for (Id j = 0; j < rank; ++j)
        {
          // Backward stable: the error is a multiple of n eps of the largest entry.
          EXPECT_NEAR(product(i, j), S(pivots[i], pivots[j]),
            1e-13 * S.diagonal().maxCoeff<Eigen::PropagateNaN>());
        }
      }
    }
  }
}

TEST(CoarseSolver, SolvesRegularSystems)
{
  const Eigen::MatrixXd D = RandomSemiDefinite(200, 200) + Eigen::MatrixXd::Identity(200, 200);
  const MultiVector exact = RandomValues(200, 3);
  MultiVector x;
  CoarseSolver(Sparse(D)).Solve(D * exact, x);
  // The condition number is below 300.
  EXPECT_LT(RelativeDifference(x, exact), 1e-12);
}

TEST(CoarseSolver, SolvesConsistentSingularSystems)
{
  const Eigen::MatrixXd D = RandomSemiDefinite(120, 70);
  const MultiVector b = D * RandomValues(120, 2);
  MultiVector x;
  CoarseSolver(Sparse(D)).Solve(b, x);
  EXPECT_LT(RelativeDifference(D * x, b), 1e-10);
}

TEST(CoarseSolver, SolvesThePureNeumannProblem)
{
  const auto levels = testing::SampledHierarchy(testing::SolidCube(2), 2, 2, 0.0, 1.0);
  const SparseMatrix& A = levels[0].A;
  MultiVector b;
  MultiVector x;
  Multiply(A, RandomValues(A.rows, 1), b);
  CoarseSolver(A).Solve(b, x);
  MultiVector Ax;
  Multiply(A, x, Ax);
  EXPECT_LT(RelativeDifference(Ax, b), 1e-12);
}

TEST(CoarseSolver, IsSymmetricAndSemiDefiniteOnInconsistentDataToo)
{
  const Eigen::MatrixXd D = RandomSemiDefinite(40, 25);
  MultiVector B;
  CoarseSolver(Sparse(D)).Solve(MultiVector::Identity(40, 40), B);
  EXPECT_LT((B - B.transpose()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    1e-13 * B.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  EXPECT_GT(DenseEigen(B).values[0], -1e-12 * B.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
}

TEST(CoarseSolver, ThousandsOfComponentsAreSolvedOneByOne)
{
  // Interleaved chains of three unknowns. One dense factor would take 2 GB.
  const Index chains = 5000;
  testing::SparseRows rows;
  for (Index row = 0; row < 3 * chains; ++row)
  {
    for (Index part = 0; part < 3; ++part)
    {
      const Index distance = std::abs(part - row / chains);
      if (distance < 2)
      {
        rows.Add(row % chains + part * chains, distance == 0 ? 2.0 : -1.0);
      }
    }
    rows.EndRow();
  }
  const SparseMatrix A = rows.Matrix(3 * chains);
  const CoarseSolver solver(A, 2);
  EXPECT_LT(solver.Memory(), std::size_t(10) << 20);
  const MultiVector exact = RandomValues(A.rows, 2);
  MultiVector b;
  MultiVector one;
  MultiVector two;
  Multiply(A, exact, b);
  solver.Solve(b, one, 1);
  solver.Solve(b, two, 2);
  EXPECT_EQ(one, two);
  EXPECT_LT(RelativeDifference(one, exact), 1e-14);
}

TEST(CoarseSolver, LeavesOutUselessRows)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(5, 5);
  D.diagonal() << 2.0, 0.0, -1.0, NaN, 4.0;
  MultiVector x;
  CoarseSolver(Sparse(D)).Solve(MultiVector::Ones(5, 1), x);
  Eigen::VectorXd expected(5);
  expected << 0.5, 0.0, 0.0, 0.0, 0.25;
  EXPECT_LT((x - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-15);
}

TEST(CoarseSolver, BadShapesAreRefusedAndNothingIsFine)
{
  MultiVector x;
  EXPECT_THROW(CoarseSolver(Sparse(Eigen::MatrixXd::Ones(2, 3))), InvalidInput);
  EXPECT_THROW(
    CoarseSolver(Sparse(Eigen::MatrixXd::Ones(2, 2))).Solve(MultiVector(3, 1), x), InvalidInput);
  CoarseSolver(Sparse(Eigen::MatrixXd::Zero(0, 0))).Solve(MultiVector(0, 2), x);
  EXPECT_EQ(x.cols(), 2);
}

} // namespace
} // namespace gridfem
