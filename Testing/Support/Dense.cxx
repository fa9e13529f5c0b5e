#include "Dense.h"

#include <Eigen/Dense>

#include <cmath>
#include <random>

namespace gridfem::testing
{

Eigen::MatrixXd Dense(const SparseMatrix& A)
{
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(A.rows, A.columns);
  for (Index row = 0; row < A.rows; ++row)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      dense(row, A.column[k]) += A.value[k];
    }
  }
  return dense;
}

MultiVector RandomValues(Id rows, Id columns, unsigned seed)
{
  std::mt19937 generator(seed);
  MultiVector result(rows, columns);
  for (Id i = 0; i < result.size(); ++i)
  {
    result.data()[i] = 2.0 * double(generator()) / double(std::mt19937::max()) - 1.0;
  }
  return result;
}

double RelativeDifference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return (a - b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() /
         b.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

MultiVector Product(const Eigen::MatrixXd& A, const MultiVector& x)
{
  return A * x;
}

Eigen::MatrixXd Product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B)
{
  return A * B;
}

Eigen::MatrixXd ProductWithTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B)
{
  return A * B.transpose();
}

Eigen::MatrixXd Congruent(const Eigen::MatrixXd& A, const Eigen::MatrixXd& V)
{
  return V.transpose() * Product(A, V);
}

Eigen::MatrixXd DenseSolution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b)
{
  return A.ldlt().solve(b);
}

Eigen::MatrixXd LeastSquares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b)
{
  return A.completeOrthogonalDecomposition().solve(b);
}

DenseEigenPairs DenseEigen(const Eigen::MatrixXd& A)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return { solver.eigenvalues(), solver.eigenvectors() };
}

DenseEigenPairs DenseEigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, B);
  return { solver.eigenvalues(), solver.eigenvectors() };
}

std::vector<double> DenseEigenvalues(const SparseMatrix& L, const SparseMatrix& M, int count)
{
  const Eigen::MatrixXd mass = Dense(M);
  const Eigen::MatrixXd K = Dense(L) + mass;
  const Eigen::VectorXd scale =
    K.diagonal().unaryExpr([](double d) { return d > 0.0 ? 1.0 / std::sqrt(d) : 0.0; });
  const DenseEigenPairs range = DenseEigen(scale.asDiagonal() * K * scale.asDiagonal());
  const Eigen::VectorXd weight = range.values.unaryExpr(
    [](double value) { return value > 1e-12 ? 1.0 / std::sqrt(value) : 0.0; });
  const Eigen::MatrixXd basis = scale.asDiagonal() * range.vectors * weight.asDiagonal();
  const DenseEigenPairs pairs = DenseEigen(basis.transpose() * mass * basis);
  std::vector<double> values;
  for (int j = 0; j < count; ++j)
  {
    values.push_back(1.0 / pairs.values[K.rows() - 1 - j] - 1.0);
  }
  return values;
}

} // namespace gridfem::testing
