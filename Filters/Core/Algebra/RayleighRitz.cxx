#include "Algebra/RayleighRitz.h"

#include "Algebra/PivotedCholesky.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace gridfem
{
namespace
{

/// Pairs of mass c = μ K c with μ below this fraction of the largest count as μ = 0 (infinite θ).
constexpr double MasslessFraction = 1e-12;

/// Returns 1 / sqrt(diagonal), or 0 where the diagonal is zero.
Eigen::VectorXd DiagonalScale(const Eigen::MatrixXd& A)
{
  const double floor = 1e-300;
  return A.diagonal().unaryExpr([floor](double d) { return d > floor ? 1.0 / std::sqrt(d) : 0.0; });
}

Eigen::MatrixXd Select(
  const Eigen::MatrixXd& A, const Eigen::VectorXd& scale, const std::vector<Index>& kept)
{
  const Index size = static_cast<Index>(kept.size());
  Eigen::MatrixXd block(size, size);
  for (Index j = 0; j < size; ++j)
  {
    for (Index i = 0; i < size; ++i)
    {
      block(i, j) = scale[kept[i]] * A(kept[i], kept[j]) * scale[kept[j]];
    }
  }
  return block;
}

} // namespace

RitzPairs SolvePencil(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, double shift,
  Index wanted, double smallest)
{
  const Eigen::MatrixXd shifted = stiffness + shift * mass;
  const Eigen::VectorXd scale = DiagonalScale(shifted);
  Eigen::MatrixXd factor = scale.asDiagonal() * shifted * scale.asDiagonal();
  const std::vector<Index> kept = PivotedCholesky(factor, smallest);
  const Index rank = static_cast<Index>(kept.size());
  RitzPairs result;
  result.values.resize(0);
  result.coefficients.resize(mass.rows(), 0);
  if (rank == 0)
  {
    return result;
  }
  const auto lower = factor.topLeftCorner(rank, rank).triangularView<Eigen::Lower>();
  Eigen::MatrixXd whitened = Select(mass, scale, kept);
  lower.solveInPlace(whitened);
  whitened.transposeInPlace();
  lower.solveInPlace(whitened);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(whitened);
  const Eigen::VectorXd& mu = solver.eigenvalues();

  Index count = 0;
  while (count < std::min(wanted, rank) && mu[rank - 1 - count] > MasslessFraction * mu[rank - 1])
  {
    ++count;
  }
  const Eigen::VectorXd top = mu.tail(count).reverse();
  Eigen::MatrixXd vectors = solver.eigenvectors().rightCols(count).rowwise().reverse();
  vectors *= top.cwiseSqrt().cwiseInverse().asDiagonal();
  lower.transpose().solveInPlace(vectors);
  result.values = top.cwiseInverse().array() - shift;
  result.coefficients.setZero(mass.rows(), count);
  for (Index i = 0; i < rank; ++i)
  {
    result.coefficients.row(kept[i]) = scale[kept[i]] * vectors.row(i);
  }
  return result;
}

} // namespace gridfem
