// The smallest Ritz value of conjugate gradients against known eigenvalues.
#include "Krylov/ConjugateGradients.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gridfem
{
namespace
{

/// A diagonal matrix as an operator.
LinearOperator Diagonal(const Eigen::ArrayXd& values)
{
  LinearOperator A;
  A.multiply = [values](const MultiVector& x, MultiVector& y) { y = x.array().colwise() * values; };
  A.residual = [values](const MultiVector& x, const MultiVector& b, MultiVector& r)
  { r = b.array() - x.array().colwise() * values; };
  A.rows = values.size();
  A.products = [](const MultiVector& x, const MultiVector& y)
  { return Columns((x.array() * y.array()).colwise().sum().transpose()); };
  return A;
}

/// The smallest Ritz values of each column, before each iteration and at the end.
std::vector<Columns> SmallestOnTheWay(const Eigen::ArrayXd& values, const MultiVector& b)
{
  std::vector<Columns> smallest;
  SolveOptions options;
  options.tolerance = 1e-14;
  options.maximumIterations = static_cast<int>(values.size());
  options.measureBy = [&smallest](const Iterate& iterate)
  {
    smallest.push_back(iterate.slowest);
    return ColumnMeasures{ Columns::Ones(iterate.x.cols()), Columns::Zero(iterate.x.cols()) };
  };
  const Preconditioner identity = [](const MultiVector& r, MultiVector& z) { z = r; };
  MultiVector x = MultiVector::Zero(b.rows(), b.cols());
  SolveConjugateGradients(Diagonal(values), identity, b, x, options);
  return smallest;
}

TEST(RitzValues, FallToTheSmallestEigenvalueThatIsExcited)
{
  Eigen::ArrayXd values(5);
  values << 0.04, 0.2, 0.5, 0.7, 1.0;
  MultiVector b = MultiVector::Ones(5, 2);
  b(0, 1) = 0.0; // the second column does not see the first eigenvector
  const std::vector<Columns> smallest = SmallestOnTheWay(values, b);
  ASSERT_GE(smallest.size(), 5u);
  EXPECT_TRUE(smallest.front().isNaN().all());
  for (std::size_t k = 2; k < smallest.size(); ++k)
  {
    EXPECT_LE(smallest[k][0], smallest[k - 1][0] * (1 + 1e-12));
    EXPECT_GE(smallest[k][0], 0.04 * (1 - 1e-12));
    EXPECT_GE(smallest[k][1], 0.2 * (1 - 1e-12));
  }
  EXPECT_GT(smallest[1][0], 0.3); // the Rayleigh quotient of b
  EXPECT_NEAR(smallest.back()[0], 0.04, 1e-8);
  EXPECT_NEAR(smallest.back()[1], 0.2, 1e-8);
}

} // namespace
} // namespace gridfem
