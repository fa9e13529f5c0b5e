// Tests products, residual and transpose of sparse matrices for every number of columns.
#include "Algebra/SparseMatrix.h"
#include "Base/Errors.h"
#include "SampledHierarchy.h"

#include <gtest/gtest.h>

namespace gridfem
{
namespace
{

using testing::Dense;
using testing::RandomValues;
using testing::Sparse;

/// Bound for sums of at most 12 products of numbers up to 1, in any order.
constexpr double Rounding = 1e-14;

SparseMatrix RandomMatrix(Index rows, Index columns)
{
  Eigen::MatrixXd dense = RandomValues(rows, columns, 5);
  for (Index i = 0; i < rows; ++i)
  {
    for (Index j = 0; j < columns; ++j)
    {
      if ((3 * i + 5 * j + i * j) % 7 > i % 3)
      {
        dense(i, j) = 0.0;
      }
    }
  }
  dense.row(rows / 2).setZero();
  return Sparse(dense);
}

class Widths : public ::testing::TestWithParam<int>
{
};

TEST_P(Widths, ProductsEqualDenseOnes)
{
  const int width = GetParam();
  const SparseMatrix A = RandomMatrix(19, 23);
  const Eigen::MatrixXd D = Dense(A);
  const MultiVector x = RandomValues(23, width, 1);
  const MultiVector b = RandomValues(19, width, 2);
  MultiVector y;
  Multiply(A, x, y);
  EXPECT_LT((y - D * x).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), Rounding);
  Residual(A, x, b, y);
  EXPECT_LT((y - (b - D * x)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), Rounding);
  y = b;
  MultiplyAdd(A, x, y);
  EXPECT_LT((y - (b + D * x)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), Rounding);
}

INSTANTIATE_TEST_SUITE_P(
  AllKernels, Widths, ::testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 16, 21));

TEST(SparseMatrix, ResidualMayOverwriteTheRightHandSide)
{
  const SparseMatrix A = RandomMatrix(12, 12);
  const MultiVector x = RandomValues(12, 3, 1);
  const MultiVector b = RandomValues(12, 3, 2);
  MultiVector apart;
  MultiVector inPlace = b;
  Residual(A, x, b, apart);
  Residual(A, x, inPlace, inPlace);
  EXPECT_EQ(apart, inPlace);
}

TEST(SparseMatrix, ThreadsDoNotChangeABit)
{
  const auto levels = testing::SampledHierarchy(testing::SolidCube(4), 4, 4, 1.0, 1.0);
  const SparseMatrix& A = levels[0].A;
  for (const int width : { 1, 3, 10 })
  {
    const MultiVector x = RandomValues(A.columns, width);
    MultiVector one;
    MultiVector two;
    Multiply(A, x, one, 1);
    Multiply(A, x, two, 2);
    EXPECT_EQ(one, two) << width;
  }
}

TEST(SparseMatrix, TransposeIsSortedAndTwiceIsTheSame)
{
  const SparseMatrix A = RandomMatrix(17, 9);
  const SparseMatrix T = Transpose(A);
  EXPECT_EQ(Dense(T), Dense(A).transpose());
  for (Index row = 0; row < T.rows; ++row)
  {
    for (Id k = T.rowBegin[row] + 1; k < T.rowBegin[row + 1]; ++k)
    {
      EXPECT_LT(T.column[k - 1], T.column[k]);
    }
  }
  const SparseMatrix twice = Transpose(T);
  EXPECT_EQ(twice.rowBegin, A.rowBegin);
  EXPECT_EQ(twice.column, A.column);
  EXPECT_EQ(twice.value, A.value);
}

TEST(SparseMatrix, CoefficientAndDiagonalFindEveryEntry)
{
  const SparseMatrix A = RandomMatrix(13, 13);
  const Eigen::MatrixXd D = Dense(A);
  const std::vector<double> diagonal = A.Diagonal();
  for (Index i = 0; i < A.rows; ++i)
  {
    EXPECT_EQ(diagonal[i], D(i, i));
    for (Index j = 0; j < A.columns; ++j)
    {
      EXPECT_EQ(A.Coefficient(i, j), D(i, j));
    }
  }
}

TEST(SparseMatrix, EmptyMatricesAreFine)
{
  SparseMatrix A;
  A.rowBegin = { 0 };
  MultiVector y;
  Multiply(A, MultiVector(0, 2), y);
  EXPECT_EQ(y.rows(), 0);
  EXPECT_EQ(y.cols(), 2);
  EXPECT_EQ(Transpose(A).rowBegin.size(), 1u);
}

TEST(SparseMatrix, WrongShapesAreRefused)
{
  const SparseMatrix A = RandomMatrix(5, 4);
  MultiVector y;
  EXPECT_THROW(Multiply(A, MultiVector::Zero(5, 1), y), InvalidInput);
  EXPECT_THROW(Residual(A, MultiVector::Zero(4, 1), MultiVector::Zero(4, 1), y), InvalidInput);
  y.setZero(4, 1);
  EXPECT_THROW(MultiplyAdd(A, MultiVector::Zero(4, 1), y), InvalidInput);
}

} // namespace
} // namespace gridfem
