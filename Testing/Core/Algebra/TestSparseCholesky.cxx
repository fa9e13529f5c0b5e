// The factor against dense solutions, for any number of columns.
#include "Algebra/SparseCholesky.h"

#include "Dense.h"
#include "Meshes.h"
#include "Spaces.h"
#include "Spaces/HatSpace.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

SparseMatrix Laplacian(const TriangleMesh& mesh, double lambda)
{
  return BuildHatSpace(mesh, {}).Matrix(0, lambda, 1.0);
}

} // namespace

TEST(SparseCholesky, SolvesForAnyNumberOfColumns)
{
  const SparseMatrix A = Laplacian(GeodesicSphere(6), 0.3);
  const SparseCholesky factor(A);
  ASSERT_TRUE(factor.IsDefinite());
  const Eigen::PartialPivLU<Eigen::MatrixXd> dense(Dense(A));
  for (const Id columns : { 1, 15, 16, 17, 50 })
  {
    const MultiVector b = RandomValues(A.rows, columns);
    const MultiVector expected = dense.solve(Eigen::MatrixXd(b));
    MultiVector x = b;
    factor.Solve(x, x, 2); // in place
    EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm()) << columns;
    MultiVector onOne;
    factor.Solve(b, onOne, 1);
    EXPECT_TRUE(onOne == x) << columns;
  }
}

TEST(SparseCholesky, HasNoFactorOfAnIndefiniteMatrix)
{
  EXPECT_FALSE(SparseCholesky(Laplacian(GeodesicSphere(6), -0.3)).IsDefinite());
}
