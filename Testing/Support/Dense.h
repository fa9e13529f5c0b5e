// Dense matrices, for references that are computed densely, and random ones. Eigen's dense solvers
// and products take long to compile, so they are compiled once for all tests.
#ifndef GridFEM_Testing_Dense_h
#define GridFEM_Testing_Dense_h

#include "Algebra/SparseMatrix.h"

#include <vector>

namespace gridfem::testing
{

Eigen::MatrixXd Dense(const SparseMatrix& A);

/// Returns random numbers in [-1, 1]. The same seed gives the same numbers.
MultiVector RandomValues(Id rows, Id columns, unsigned seed = 1);

/// Returns the largest difference, relative to the largest entry of the second matrix.
double RelativeDifference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// A x
MultiVector Product(const Eigen::MatrixXd& A, const MultiVector& x);
Eigen::MatrixXd Product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// A Bᵀ
Eigen::MatrixXd ProductWithTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Vᵀ A V
Eigen::MatrixXd Congruent(const Eigen::MatrixXd& A, const Eigen::MatrixXd& V);

/// Returns A⁻¹ b for a symmetric positive definite A.
Eigen::MatrixXd DenseSolution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// Returns, for any A, the smallest x that minimizes |A x - b|.
Eigen::MatrixXd LeastSquares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

struct DenseEigenPairs
{
  Eigen::VectorXd values; // ascending
  Eigen::MatrixXd vectors;
};

/// Solves A x = λ x with orthonormal x, for a symmetric A.
DenseEigenPairs DenseEigen(const Eigen::MatrixXd& A);

/// Solves A x = λ B x with B-orthonormal x, for a symmetric A and a positive definite B.
DenseEigenPairs DenseEigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Returns the smallest eigenvalues of L x = α M x for semidefinite L and M. Some x may have
/// neither energy nor mass. It therefore takes the range of K = L + M, and the largest values of M
/// in it.
std::vector<double> DenseEigenvalues(const SparseMatrix& L, const SparseMatrix& M, int count);

} // namespace gridfem::testing

#endif
