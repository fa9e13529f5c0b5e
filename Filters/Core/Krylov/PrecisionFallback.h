// Solves that go on in double precision where a preconditioner in single precision turns out not to
// be enough.
#ifndef GridFEM_PrecisionFallback_h
#define GridFEM_PrecisionFallback_h

#include "Krylov/ConjugateGradients.h"
#include "Krylov/WithFallback.h"

namespace gridfem
{

enum class IterationType
{
  ConjugateGradients = 0, // with one cycle as preconditioner
  Cycles = 1              // the cycle alone
};

/// One cycle from zero, and one with factors in double precision.
WithFallback<Preconditioner> CycleWithFallback(const Multigrid& multigrid);

/// SolveConjugateGradients or SolveCycles. Where B may be replaced, an iteration that is too slow
/// (Stagnation::IsTooSlow) or breaks down begins anew, once, from the x it has reached or from
/// zero, for the iterations that are left, in double precision. That one ends at a standstill. What
/// the report says of the iteration of this change, `doubleSince`, is measured in double precision.
/// options.giveUp counts where B is in double precision from the start.
SolveReport SolveWithFallback(IterationType iteration, const LinearOperator& A,
  const WithFallback<Preconditioner>& B, const MultiVector& b, MultiVector& x,
  const SolveOptions& options, const Projection& project = {}, const Progress& progress = {});

} // namespace gridfem

#endif
