// Residuals of Ritz pairs and their corrections by a preconditioner, a panel of columns at a time.
// [NUMERICS §3]
#ifndef GridFEM_ResidualCorrection_h
#define GridFEM_ResidualCorrection_h

#include "SpectralProblem.h"

#include <vector>

namespace gridfem
{

/// W = B (L X - M X diag(θ)) for some columns of X, and P = B F for loads F that go with them: a
/// cycle takes as long for a few columns as for a whole panel. Measures are those of W.
/// @param columns  of the pairs, ascending; as many as W has
/// @param load     F; as many columns as P has
template<class Real>
ResidualMeasures CorrectResiduals(const SpectralProblem<Real>& problem,
  const Preconditioner<Real>& precondition, const EigenPairs<Real>& pairs,
  const std::vector<Index>& columns, Block<Real> W, const MultiVector& load, Block<Real> P);

/// rᵀr of these columns. A cycle for each would cost far more.
template<class Real>
Eigen::VectorXd SquaredResiduals(const SpectralProblem<Real>& problem,
  const EigenPairs<Real>& pairs, const std::vector<Index>& columns);

} // namespace gridfem

#endif
