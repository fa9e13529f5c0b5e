// Dense matrices, for references that are computed densely. Solvers and products of Eigen take long
// to compile, and are compiled once for all tests here.
#ifndef GridFEM_Testing_Dense_h
#define GridFEM_Testing_Dense_h

#include "Algebra/SparseMatrix.h"

#include <vector>

namespace gridfem::testing
{

Eigen::MatrixXd Dense(const SparseMatrix& A);

/// A x
MultiVector Product(const Eigen::MatrixXd& A, const MultiVector& x);
Eigen::MatrixXd Product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// A Bᵀ
Eigen::MatrixXd ProductWithTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Vᵀ A V
Eigen::MatrixXd Congruent(const Eigen::MatrixXd& A, const Eigen::MatrixXd& V);

/// A⁻¹ b of a symmetric positive definite A.
Eigen::MatrixXd DenseSolution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// The smallest of the x with the least |A x - b|, of any A.
Eigen::MatrixXd LeastSquares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

struct DenseEigenPairs
{
  Eigen::VectorXd values; // rising
  Eigen::MatrixXd vectors;
};

/// A x = λ x with orthonormal x, of a symmetric A.
DenseEigenPairs DenseEigen(const Eigen::MatrixXd& A);

/// A x = λ B x with B-orthonormal x, of a symmetric A and a positive definite B.
DenseEigenPairs DenseEigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// The smallest eigenvalues of L x = α M x for semidefinite L and M, also where x has neither
/// energy nor mass: the range of K = L + M, then the largest values of M in it.
std::vector<double> DenseEigenvalues(const SparseMatrix& L, const SparseMatrix& M, int count);

} // namespace gridfem::testing

#endif
