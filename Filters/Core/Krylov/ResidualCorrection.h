// Residuals of Ritz pairs and their corrections by a preconditioner, a panel of columns at a time.
// [NUMERICS §3]
#ifndef GridFEM_ResidualCorrection_h
#define GridFEM_ResidualCorrection_h

#include "Krylov/SoftLocking.h"
#include "Krylov/SpectralProblem.h"

#include <vector>

namespace gridfem
{

/// W = B (L X - M X diag(θ)) for the columns at work, but for panels that have converged as a
/// whole, and P = B F for loads F that go with them: a cycle takes as long for a few columns as for
/// a panel. Measures are those of the columns at work, as many as W has.
/// @param load  F; as many columns as P has
template<class Real>
ResidualMeasures CorrectResiduals(const SpectralProblem<Real>& problem,
  const BlockPreconditioner<Real>& precondition, const EigenPairs<Real>& pairs,
  const SoftLocking& locking, Block<Real> W, const MultiVector& load, Block<Real> P);

/// rᵀr of these columns. A cycle for each would cost far more.
template<class Real>
Eigen::VectorXd SquaredResiduals(const SpectralProblem<Real>& problem,
  const EigenPairs<Real>& pairs, const std::vector<Index>& columns);

} // namespace gridfem

#endif
