// The projected eigenproblem and the products that build it.
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

TEST(Products, EqualPlainOnesAndDoNotDependOnThreads)
{
  const Index rows = 1500; // several ranges and tiles
  const MultiVector X = Random(rows, 150, 5);
  const MultiVector empty(rows, 0);
  const MultiVector Z = Random(rows, 20, 9);
  const MultiVector Y = Random(rows, 130, 10);
  MultiVector basis(rows, 170);
  basis << X, Z;
  const BasisParts parts = { &X, &empty, &Z };
  const Eigen::MatrixXd projected = Project(parts, Y, 1);
  const Eigen::MatrixXd plain = basis.transpose() * Y;
  EXPECT_LT((projected - plain).norm(), 1e-12 * plain.norm());
  const Eigen::MatrixXd C = Random(170, 70, 6);
  MultiVector combined;
  Combine(parts, C, combined, 1);
  const MultiVector plainCombined = basis * C;
  EXPECT_LT((combined - plainCombined).norm(), 1e-12 * plainCombined.norm());

  EXPECT_TRUE(projected == Project(parts, Y, 3));
  MultiVector again;
  Combine(parts, C, again, 3);
  EXPECT_TRUE(combined == again);
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

TEST(Products, PairedSparseProductEqualsTwo)
{
  const SparseMatrix A = Tridiagonal(700, 2.0, -1.0);
  const SparseMatrix B = Tridiagonal(700, 4.0, 0.5);
  for (const Index columns : { 1, 3, 16, 39 })
  {
    const MultiVector X = Random(700, columns, 7);
    MultiVector pair;
    MultiVector plain;
    MultiplyPair(A, B, X, pair, 2);
    Multiply(A, X, plain);
    EXPECT_LT((pair.leftCols(columns) - plain).norm(), 1e-14 * plain.norm());
    Multiply(B, X, plain);
    EXPECT_LT((pair.rightCols(columns) - plain).norm(), 1e-14 * plain.norm());
  }
  MultiVector pair;
  EXPECT_THROW(MultiplyPair(A, B, Random(699, 2, 8), pair), InvalidInput);
}

} // namespace
} // namespace gridfem
