// Heat that has spread from its sources for a time t, to the same relative accuracy everywhere,
// however little of it arrives: (M + t L) u = b, u ~ exp(-distance / sqrt(t)).
#ifndef GridFEM_DistantHeat_h
#define GridFEM_DistantHeat_h

#include "Problems/Poisson.h"

namespace gridfem
{

struct DistantHeat
{
  MultiVector coefficients; // one column
  /// Functions to which no heat came because it would be below the smallest number, 1e-308, or the
  /// solver did not converge. Components without sources do not count: there is no heat at all.
  Id unreached = 0;
  int solves = 0;
  SolveReport report; // of the solve that took most iterations; not converged if one was not
};

/// The error of an iteration is a share of the largest value, so that one solve is worth nothing
/// where less heat than that has come. So what is known well enough is kept, and what follows is
/// solved for anew with the heat at the rim of the known part as its source, until the whole
/// surface is reached. A solve takes the front about 23 sqrt(t) farther.
/// @param load       one column: Σ b_i(source)
/// @param multigrid  of M / t + L
/// Throws InvalidInput and Aborted. Same bits for any number of threads.
DistantHeat SpreadHeat(const FiniteElementSpace& space, const Multigrid& multigrid, double t,
  const MultiVector& load, int maximumIterations, const Job& job = {});

} // namespace gridfem

#endif
