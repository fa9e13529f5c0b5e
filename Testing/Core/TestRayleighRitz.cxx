// The projected eigenproblem and the products that build it.
#include "BasisProducts.h"
#include "Errors.h"
#include "PairedProduct.h"
#include "RayleighRitz.h"
#include "SparseRows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gridfem
{
namespace
{

Eigen::MatrixXd Random(Index rows, Index columns, unsigned seed)
{
  std::mt19937_64 generator(seed);
  Eigen::MatrixXd A(rows, columns);
  for (Index j = 0; j < columns; ++j)
  {
    for (Index i = 0; i < rows; ++i)
    {
      A(i, j) = static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0;
    }
  }
  return A;
}

/// A pencil with the given values: mass = T Tᵀ, stiffness = T diag(values) Tᵀ.
struct Pencil
{
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd mass;
};
Pencil MakePencil(const Eigen::MatrixXd& T, const Eigen::VectorXd& values)
{
  return { T * values.asDiagonal() * T.transpose(), T * T.transpose() };
}

Eigen::VectorXd Ramp(Index size)
{
  return Eigen::VectorXd::LinSpaced(size, 1.0, static_cast<double>(size));
}

TEST(SolvePencil, FindsTheLowestPairsInOrder)
{
  const Index size = 30;
  const Pencil pencil = MakePencil(Random(size, size, 1), Ramp(size));
  const RitzPairs pairs = SolvePencil(pencil.stiffness, pencil.mass, 1.0, 7);
  ASSERT_EQ(pairs.values.size(), 7);
  // A random 30 x 30 matrix has a condition near 1e3, its square times rounding is 1e-10.
  EXPECT_LT((pairs.values - Ramp(7)).norm(), 1e-9);
  const Eigen::MatrixXd& C = pairs.coefficients;
  EXPECT_LT((C.transpose() * pencil.mass * C - Eigen::MatrixXd::Identity(7, 7)).norm(), 1e-9);
  const Eigen::MatrixXd residual =
    pencil.stiffness * C - pencil.mass * C * pairs.values.asDiagonal();
  EXPECT_LT(residual.norm(), 1e-8 * pencil.stiffness.norm());
}

TEST(SolvePencil, LeavesOutDependentVectors)
{
  // Fifty vectors span a space of dimension twenty.
  const Pencil pencil = MakePencil(Random(50, 20, 2), Ramp(20));
  const RitzPairs pairs = SolvePencil(pencil.stiffness, pencil.mass, 1.0, 50);
  ASSERT_EQ(pairs.values.size(), 20);
  EXPECT_LT((pairs.values - Ramp(20)).norm(), 1e-8);
}

TEST(SolvePencil, DirectionsWithoutMassAreNoPairs)
{
  // Stiffness regular, mass of rank 3: exactly three finite values, and no others pose as pairs.
  const Eigen::MatrixXd Q = Random(8, 8, 3);
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(8);
  mass.head(3) << 1.0, 0.5, 0.25;
  const RitzPairs pairs =
    SolvePencil(Q * Q.transpose(), Q * mass.asDiagonal() * Q.transpose(), 0.5, 8);
  ASSERT_EQ(pairs.values.size(), 3);
  EXPECT_NEAR(pairs.values[0], 1.0, 1e-10);
  EXPECT_NEAR(pairs.values[1], 2.0, 1e-10);
  EXPECT_NEAR(pairs.values[2], 4.0, 1e-10);
}

TEST(SolvePencil, ScaleOfTheVectorsDoesNotMatter)
{
  const Pencil pencil = MakePencil(Random(12, 12, 4), Ramp(12));
  const Eigen::VectorXd scale =
    Ramp(12).unaryExpr([](double i) { return std::pow(10.0, i - 6.0); });
  const RitzPairs pairs = SolvePencil(scale.asDiagonal() * pencil.stiffness * scale.asDiagonal(),
    scale.asDiagonal() * pencil.mass * scale.asDiagonal(), 1.0, 12);
  ASSERT_EQ(pairs.values.size(), 12);
  EXPECT_LT((pairs.values - Ramp(12)).norm(), 1e-8);
}

TEST(SolvePencil, NothingGivesNothing)
{
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(4, 4);
  EXPECT_EQ(SolvePencil(zero, zero, 1.0, 3).values.size(), 0);
  EXPECT_EQ(SolvePencil({}, {}, 1.0, 3).values.size(), 0);
}

/// A matrix with entries on three diagonals.
SparseMatrix Tridiagonal(Index size, double diagonal, double beside)
{
  testing::SparseRows rows;
  for (Index i = 0; i < size; ++i)
  {
    for (Index j = std::max(i - 1, 0); j <= std::min(i + 1, size - 1); ++j)
    {
      rows.Add(j, i == j ? diagonal + i : beside);
    }
    rows.EndRow();
  }
  return rows.Matrix(size);
}

TEST(Products, EqualPlainOnesAndDoNotDependOnThreads)
{
  const Index rows = 5500; // several sums of several ranges
  const SparseMatrix A = Tridiagonal(rows, 2.0, -1.0);
  const SparseMatrix B = Tridiagonal(rows, 4.0, 0.5);
  const MultiVector X = Random(rows, 150, 5);
  const MultiVector empty(rows, 0);
  const MultiVector Z = Random(rows, 20, 9);
  const MultiVector Y = Random(rows, 23, 10); // groups of 16, 4 and 1
  MultiVector basis(rows, 170);
  basis << X, Z;
  MultiVector image(rows, 46);
  MultiVector part;
  Multiply(A, Y, part);
  image.leftCols(23) = part;
  Multiply(B, Y, part);
  image.rightCols(23) = part;
  const Eigen::MatrixXd plain = basis.transpose() * image;
  const BasisParts parts = { X, empty, Z };
  const Eigen::MatrixXd pair = ProjectPair(parts, A, B, Y, 1);
  EXPECT_LT((pair - plain).norm(), 1e-12 * plain.norm());
  const Eigen::MatrixXd single = Project(parts, A, Y, 1);
  EXPECT_LT((single - plain.leftCols(23)).norm(), 1e-12 * plain.norm());
  const Eigen::MatrixXd C = Random(170, 23, 6);
  MultiVector rest = Y;
  SubtractCombination(parts, C, rest, 1);
  const MultiVector plainRest = Y - basis * C;
  EXPECT_LT((rest - plainRest).norm(), 1e-12 * plainRest.norm());

  EXPECT_TRUE(pair == ProjectPair(parts, A, B, Y, 3));
  EXPECT_TRUE(single == Project(parts, A, Y, 3));
  MultiVector again = Y;
  SubtractCombination(parts, C, again, 3);
  EXPECT_TRUE(rest == again);
  EXPECT_THROW(Project(parts, A, Random(rows - 1, 2, 8)), InvalidInput);
  EXPECT_THROW(ProjectPair(parts, A, Tridiagonal(rows - 1, 1.0, 1.0), Y), InvalidInput);
}

TEST(Products, TakeColumnsOfAWiderBlock)
{
  const SparseMatrix A = Tridiagonal(700, 2.0, -1.0);
  const SparseMatrix B = Tridiagonal(700, 4.0, 0.5);
  const MultiVector wide = Random(700, 60, 7);
  const MultiVector X = wide.middleCols(3, 39);
  EXPECT_TRUE(ProjectPair({ X }, A, B, X) ==
              ProjectPair({ wide.middleCols(3, 39) }, A, B, wide.middleCols(3, 39)));
  const Eigen::VectorXd values = Ramp(39);
  MultiVector a;
  MultiVector b;
  Multiply(A, X, a);
  Multiply(B, X, b);
  const MultiVector plain = a - b * values.asDiagonal();
  MultiVector residual(700, 39);
  EigenResidual(A, B, wide.middleCols(3, 39), values, residual, 2);
  EXPECT_LT((residual - plain).norm(), 1e-13 * plain.norm());
  MultiVector narrow(700, 38);
  EXPECT_THROW(EigenResidual(A, B, X, values, narrow), InvalidInput);
}

TEST(BlockVectors, BuffersKeepTheirMemory)
{
  BlockBuffer buffer;
  buffer.Reshape(100, 8);
  const double* memory = buffer.View().data();
  buffer.Reshape(100, 3);
  EXPECT_EQ(buffer.View().data(), memory);
  EXPECT_EQ(buffer.Columns(), 3);
  BlockBuffer other;
  buffer.Swap(other);
  EXPECT_EQ(other.View().data(), memory);
  EXPECT_EQ(buffer.Columns(), 0);
}

TEST(BlockVectors, FirstColumnsStayAsTheyAre)
{
  const MultiVector wide = Random(1000, 17, 11);
  for (const Index columns : { 17, 5, 0 })
  {
    MultiVector X = wide;
    KeepColumns(X, columns);
    EXPECT_TRUE(X == wide.leftCols(columns));
  }
}

} // namespace
} // namespace gridfem
