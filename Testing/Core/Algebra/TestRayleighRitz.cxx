// Tests the projected eigenproblem and the products that build it.
#include "Algebra/BasisProducts.h"
#include "Algebra/BlockProducts.h"
#include "Algebra/RayleighRitz.h"
#include "Base/Errors.h"
#include "Dense.h"
#include "SparseRows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace gridfem
{
namespace
{

using testing::Congruent;
using testing::Product;
using testing::ProductWithTransposed;

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

/// A pencil with the given eigenvalues: mass = T Tᵀ, stiffness = T diag(values) Tᵀ.
struct Pencil
{
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd mass;
};
Pencil MakePencil(const Eigen::MatrixXd& T, const Eigen::VectorXd& values)
{
  return { ProductWithTransposed(T * values.asDiagonal(), T), ProductWithTransposed(T, T) };
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
  // A random 30 x 30 matrix has a condition number near 1e3. Its square times rounding is 1e-10.
  EXPECT_LT((pairs.values - Ramp(7)).norm(), 1e-9);
  const Eigen::MatrixXd& C = pairs.coefficients;
  EXPECT_LT((Congruent(pencil.mass, C) - Eigen::MatrixXd::Identity(7, 7)).norm(), 1e-9);
  const Eigen::MatrixXd residual =
    Product(pencil.stiffness, C) - Product(pencil.mass, C) * pairs.values.asDiagonal();
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
  // The stiffness is regular and the mass has rank 3. There are exactly three finite values, and
  // nothing else passes for a pair.
  const Eigen::MatrixXd Q = Random(8, 8, 3);
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(8);
  mass.head(3) << 1.0, 0.5, 0.25;
  const RitzPairs pairs = SolvePencil(
    ProductWithTransposed(Q, Q), ProductWithTransposed(Q * mass.asDiagonal(), Q), 0.5, 8);
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

/// Returns a matrix with entries on three diagonals.
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
  const Index rows = 5500; // several sums over several ranges
  const SparseMatrix A = Tridiagonal(rows, 2.0, -1.0);
  const SparseMatrix B = Tridiagonal(rows, 4.0, 0.5);
  const MultiVector X = Random(rows, 150, 5);
  const MultiVector empty(rows, 0);
  const MultiVector Z = Random(rows, 20, 9);
  const MultiVector Y = Random(rows, 23, 10); // groups of 16, 4 and 1 columns
  MultiVector basis(rows, 170);
  basis << X, Z;
  MultiVector image(rows, 46);
  MultiVector part;
  Multiply(A, Y, part);
  image.leftCols(23) = part;
  Multiply(B, Y, part);
  image.rightCols(23) = part;
  const Eigen::MatrixXd plain = Product(basis.transpose(), Eigen::MatrixXd(image));
  const BasisParts<double> parts = { X, empty, Z };
  const Eigen::MatrixXd pair = ProjectPair<double>(parts, A, B, Y, 1);
  EXPECT_LT((pair - plain).norm(), 1e-12 * plain.norm());
  const Eigen::MatrixXd single = Project<double>(parts, A, Y, 1);
  EXPECT_LT((single - plain.leftCols(23)).norm(), 1e-12 * plain.norm());
  const Eigen::MatrixXd C = Random(170, 23, 6);
  MultiVector rest = Y;
  SubtractCombination<double>(parts, C, rest, 1);
  const MultiVector plainRest = Y - MultiVector(Product(basis, C));
  EXPECT_LT((rest - plainRest).norm(), 1e-12 * plainRest.norm());

  EXPECT_TRUE(pair == ProjectPair<double>(parts, A, B, Y, 3));
  EXPECT_TRUE(single == Project<double>(parts, A, Y, 3));
  MultiVector again = Y;
  SubtractCombination<double>(parts, C, again, 3);
  EXPECT_TRUE(rest == again);
  EXPECT_THROW(Project<double>(parts, A, Random(rows - 1, 2, 8)), InvalidInput);
  EXPECT_THROW(ProjectPair<double>(parts, A, Tridiagonal(rows - 1, 1.0, 1.0), Y), InvalidInput);
}

TEST(Products, TakeColumnsOfAWiderBlock)
{
  const SparseMatrix A = Tridiagonal(700, 2.0, -1.0);
  const SparseMatrix B = Tridiagonal(700, 4.0, 0.5);
  const MultiVector wide = Random(700, 60, 7);
  const MultiVector X = wide.middleCols(3, 39);
  EXPECT_TRUE(ProjectPair<double>({ X }, A, B, X) ==
              ProjectPair<double>({ wide.middleCols(3, 39) }, A, B, wide.middleCols(3, 39)));
  const Eigen::VectorXd values = Ramp(39);
  MultiVector a;
  MultiVector b;
  Multiply(A, X, a);
  Multiply(B, X, b);
  const MultiVector plain = a - b * values.asDiagonal();
  const auto rowsOf = [&](const std::vector<Index>& columns)
  {
    MultiVector rows(700, static_cast<Id>(columns.size()));
    for (const Id begin : { 0, 300, 600 })
    {
      const Id end = std::min<Id>(700, begin + 300);
      EigenResidual<double>(A, B, wide.middleCols(3, 39), values, columns)
        .Rows(begin, end, rows.middleRows(begin, end - begin));
    }
    return rows;
  };
  for (const std::vector<Index>& columns :
    { std::vector<Index>{ 4, 5, 6 }, { 0, 17, 18, 38 }, { 20 }, {} })
  {
    const MultiVector wanted = plain(Eigen::indexing::all, columns);
    EXPECT_LE((rowsOf(columns) - wanted).norm(), 1e-13 * wanted.norm());
  }
  EXPECT_THROW(EigenResidual<double>(A, B, X, values.head(38), { 1 }), InvalidInput);
}

TEST(Products, InSinglePrecisionAreRoundedOnce)
{
  const Index rows = 5500;
  const SparseMatrix A = Tridiagonal(rows, 2.0, -1.0);
  const SparseMatrix B = Tridiagonal(rows, 4.0, 0.5);
  const Vectors<float> X = Random(rows, 40, 5).cast<float>();
  const Vectors<float> Y = Random(rows, 55, 10).cast<float>(); // groups of 32, 16, 4 and 1 columns
  const MultiVector wideX = X.cast<double>();
  const MultiVector wideY = Y.cast<double>();
  const BasisParts<float> parts = { X };
  const Eigen::MatrixXd pair = ProjectPair<float>(parts, A, B, Y, 1);
  const Eigen::MatrixXd exact = ProjectPair<double>({ wideX }, A, B, wideY, 1);
  // Sums of a few hundred products, each rounded to 6e-8, in which terms cancel.
  EXPECT_LT((pair - exact).norm(), 1e-6 * exact.norm());
  EXPECT_TRUE(pair == ProjectPair<float>(parts, A, B, Y, 3));
  // Residuals have seven roundings of sums of up to (514 + 0.37 * 516) times the largest entry.
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(55, 0.37);
  Vectors<float> single(256, 55);
  MultiVector wide(256, 55);
  std::vector<Index> all(55);
  std::iota(all.begin(), all.end(), 0);
  EigenResidual<float>(A, B, Y, values, all).Rows(256, 512, single);
  EigenResidual<double>(A, B, wideY, values, all).Rows(256, 512, wide);
  EXPECT_LT((single.cast<double>() - wide).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    7 * 6e-8 * 705 * wideY.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
}

template<class Real>
class BlockBuffers : public ::testing::Test
{
};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(BlockBuffers, Precisions, );

TYPED_TEST(BlockBuffers, KeepTheirMemoryAndTheirNumbers)
{
  BlockBuffer<TypeParam> buffer;
  buffer.Reserve(100, 8);
  buffer.Show(8);
  const Vectors<TypeParam> X = Random(100, 8, 10).cast<TypeParam>();
  buffer.View() = X;
  const TypeParam* memory = buffer.View().data();
  buffer.Reserve(100, 5);
  buffer.Show(3);
  EXPECT_EQ(buffer.View().data(), memory);
  EXPECT_EQ(buffer.Columns(), 3);
  EXPECT_TRUE(buffer.View() == X.leftCols(3));
  buffer.Show(8);
  buffer.Keep({ 1, 4, 7 });
  EXPECT_EQ(buffer.Columns(), 3);
  EXPECT_TRUE(buffer.View() == X(Eigen::indexing::all, std::vector<Index>{ 1, 4, 7 }));
  const Vectors<TypeParam> kept = buffer.View();
  buffer.Grow(100, 20);
  EXPECT_TRUE(buffer.View() == kept);
  buffer.Show(20);
  EXPECT_EQ(buffer.View().cols(), 20);
}

} // namespace
} // namespace gridfem
