// The screened Poisson equation (λM + L) u = λ f + s on a surface that several ranks hold together.
// [Problems/Poisson.h, whose words hold here, too]
#ifndef GridFEM_RankPoisson_h
#define GridFEM_RankPoisson_h

#include "Multigrid/Multigrid.h"
#include "Parallel/RankSpace.h"
#include "Problems/Poisson.h"

namespace gridfem
{

struct RankPoissonOptions
{
  double screeningWeight = 1.0; // λ >= 0, per squared side of a cell
  MultigridOptions multigrid;
  SolveOptions solve; // by the energy residual, from zero, without a measure of its own
};

/// Collective. Solves for all columns, one after the other.
/// @param values     what this rank's patches add to ∫ f b_i: LoadOfValues of space.Own()
/// @param gradients  the same for ∫ <s, ∇b_i>; may have no rows on any rank for s = 0
/// @return coefficients: rows = functions that touch this rank's cells
/// Throws RankFailure on all ranks when one fails, and Aborted.
PoissonSolution SolvePoisson(const RankSpace& space, const MultiVector& values,
  const MultiVector& gradients, const RankPoissonOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
