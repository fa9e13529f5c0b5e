// Block iteration for the lowest eigenpairs of L x = θ M x on one level: Rayleigh-Ritz on the
// vectors, their preconditioned residuals and the last directions (LOBPCG). Knows no mesh.
// [NUMERICS §3]
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
  int minimumIterations = 0; // 1: the random directions have their say even if all has converged
  /// False: pairs for a finer level. They are renewed, and the last step allowed is not measured.
  bool measureLast = true;
};

struct BlockReport
{
  std::vector<double> residuals; // per wanted pair when last looked at: sqrt(rᵀBr / max(θ, shift))
  double nextResidual = 1.0;     // of the first pair behind them; 1 when there is none
  Index numberOfConverged = 0;   // of the wanted ones
  int iterations = 0;            // Rayleigh-Ritz steps
};

/// Memory of an iteration, for one that comes after it.
template<class Real>
struct BlockWorkspace
{
  BlockBuffer<Real> directions;
  BlockBuffer<Real> corrections;
};

/// Improves `pairs` (orthonormal Ritz pairs, or vectors of any kind without values; may be fewer
/// than blockSize, or none) until the wanted ones reach the tolerance. Columns that did drop out of
/// the work until they move again. A few fixed random directions are mixed in, so that no
/// eigenvector stays hidden. Returns at most blockSize pairs, fewer when fewer exist. Blocks in
/// single precision halve memory and the time of dense products; projected matrices are added up in
/// double, so that tolerances down to 1e-7 are reached in the same steps. Same bits for any number
/// of threads. Throws Aborted.
/// @param known  orthonormal in the mass matrix; the pairs found are orthogonal to them
template<class Real>
BlockReport ImproveEigenPairs(const SpectralProblem<Real>& problem, const BlockOptions& options,
  const BasisParts<Real>& known, EigenPairs<Real>& pairs, BlockWorkspace<Real>& workspace,
  const Progress& progress = {});

} // namespace gridfem

#endif
