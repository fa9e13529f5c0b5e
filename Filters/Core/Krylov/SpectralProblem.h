// The eigenproblem of one level, L x = θ M x, and pairs that solve it. What the block iteration,
// the dense solve and the collection of results share.
#ifndef GridFEM_SpectralProblem_h
#define GridFEM_SpectralProblem_h

#include "Algebra/Constants.h"
#include "Algebra/SparseMatrix.h"
#include "Multigrid/BlockPreconditioner.h"

#include <functional>

namespace gridfem
{

/// One level's eigenproblem, for blocks of vectors of one precision.
template<class Real>
struct SpectralProblem
{
  SparseMatrix stiffness;
  SparseMatrix mass;
  double shift = 1.0;
  /// Approximate inverse, symmetric positive semi-definite, of stiffness + shift mass.
  BlockPreconditioner<Real> precondition;
  /// Makes a better one, where there is: it takes over when convergence is slow.
  std::function<BlockPreconditioner<Real>()> fallback;
  const Constants* constants = nullptr; // the pairs found are orthogonal to them
  int threads = 0;
};

template<class Real>
struct EigenPairs
{
  Eigen::VectorXd values;    // ascending
  BlockBuffer<Real> vectors; // columns orthonormal in the mass matrix, up to rounding of Real
  /// By Rayleigh-Ritz on these vectors or on those they are prolonged from: XᵀLX = diag(values) and
  /// XᵀMX = 1 up to rounding of Real, not up to that of many steps.
  bool isRenewed = false;
};

} // namespace gridfem

#endif
