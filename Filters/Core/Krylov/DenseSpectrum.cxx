#include "Krylov/DenseSpectrum.h"

#include "Algebra/RayleighRitz.h"
#include "Base/PrecisionTraits.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// A level is solved densely up to AlwaysDense functions. With more pairs it is solved densely up
/// to DensePerPair functions per pair, but never beyond LargestDense.
constexpr double AlwaysDense = 600.0;
constexpr double DensePerPair = 3.5;
constexpr double LargestDense = 1200.0;

Eigen::MatrixXd ToDense(const SparseMatrix& A)
{
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(A.rows, A.columns);
  for (Index i = 0; i < A.rows; ++i)
  {
    for (Id k = A.rowBegin[i]; k < A.rowBegin[i + 1]; ++k)
    {
      dense(i, A.column[k]) = A.value[k];
    }
  }
  return dense;
}

} // namespace

bool IsDense(Id functions, Index blockSize)
{
  return double(functions) <= std::clamp(DensePerPair * blockSize, AlwaysDense, LargestDense);
}

template<class Real>
EigenPairs<Real> SolveDense(const SpectralProblem<Real>& problem, Index count)
{
  Eigen::MatrixXd mass = ToDense(problem.mass);
  problem.constants->Deflate(mass);
  const RitzPairs ritz = SolvePencil(ToDense(problem.stiffness), mass, problem.shift, count);
  // Coefficients of nearly dependent functions are large. Vectors that are rounded to Real
  // therefore have other products.
  EigenPairs<Real> pairs{ ritz.values, {}, !PrecisionTraits<Real>::IsSingle };
  pairs.vectors.Reserve(ritz.coefficients.rows(), count);
  pairs.vectors.Show(ritz.coefficients.cols());
  CopyBlock(ritz.coefficients, pairs.vectors.View(), problem.threads);
  problem.constants->template Remove<Real>(pairs.vectors.View());
  return pairs;
}

template EigenPairs<float> SolveDense(const SpectralProblem<float>&, Index);
template EigenPairs<double> SolveDense(const SpectralProblem<double>&, Index);

} // namespace gridfem
