// Block iteration for the lowest eigenpairs of L x = θ M x on one level (LOBPCG). Each step is a
// Rayleigh-Ritz on the vectors, their preconditioned residuals and the last directions. It knows no
// mesh. [NUMERICS §3]
#ifndef GridFEM_Lobpcg_h
#define GridFEM_Lobpcg_h

#include "Algebra/BasisProducts.h"
#include "Base/Progress.h"
#include "Krylov/SpectralProblem.h"

#include <vector>

namespace gridfem
{

struct BlockOptions
{
  Index wanted = 1;        // lowest pairs that have to converge
  Index blockSize = 1;     // pairs carried along, >= wanted
  double tolerance = 1e-8; // on rᵀBr / θ
  int maximumIterations = 100;
  int minimumIterations = 0; // 1: uses the random directions even if all has converged
  /// False: the pairs are a start for a finer level. They are renewed, and the last step is not
  /// measured.
  bool measureLast = true;
};

struct BlockReport
{
  std::vector<double> residuals; // per wanted pair, when last measured: sqrt(rᵀBr / max(θ, shift))
  double nextResidual = 1.0;     // of the first pair beyond the wanted ones; 1 when there is none
  Index numberOfConverged = 0;   // among the wanted pairs
  int iterations = 0;            // Rayleigh-Ritz steps
};

/// Memory of an iteration, kept for the next iteration.
template<class Real>
struct BlockWorkspace
{
  BlockBuffer<Real> directions;
  BlockBuffer<Real> corrections;
};

/// Improves `pairs` until the wanted pairs reach the tolerance. `pairs` may be orthonormal Ritz
/// pairs, vectors of any kind without values, fewer than blockSize of either, or empty. Returns at
/// most blockSize pairs, fewer when fewer exist.
/// Converged columns drop out of the work until they move again. A few fixed random directions are
/// mixed in, so that no eigenvector stays hidden.
/// Blocks in single precision halve the memory and the time of dense products. Projected matrices
/// are added up in double precision, so tolerances down to 1e-7 are reached in the same steps. Same
/// bits for any number of threads. Throws Aborted.
/// @param known  orthonormal in the mass matrix; the pairs found are orthogonal to these vectors
template<class Real>
BlockReport ImproveEigenPairs(const SpectralProblem<Real>& problem, const BlockOptions& options,
  const BasisParts<Real>& known, EigenPairs<Real>& pairs, BlockWorkspace<Real>& workspace,
  const Progress& progress = {});

} // namespace gridfem

#endif
