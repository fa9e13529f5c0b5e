// The screened Poisson equation (λM + L) u = λ f + s on a surface that several ranks hold together.
// [Problems/Poisson.h, whose words hold here, too]
#ifndef GridFEM_RankPoisson_h
#define GridFEM_RankPoisson_h

#include "Parallel/RankSpace.h"
#include "Problems/Poisson.h"

namespace gridfem
{

/// Collective. The solve is that of one process, with the cycle of all ranks.
/// @param values     what this rank's patches add to ∫ f b_i: LoadOfValues of space.Own()
/// @param gradients  the same for ∫ <s, ∇b_i>; may have no rows on any rank for s = 0
/// @param options    λ per squared side of a cell; the start is not used
/// @return coefficients: rows = functions that touch this rank's cells; the rest is the same on all
///         ranks
/// Throws RankFailure on all ranks when one fails, InvalidInput for options out of range, and
/// Aborted.
PoissonSolution SolvePoisson(const RankSpace& space, const MultiVector& values,
  const MultiVector& gradients, const PoissonOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
