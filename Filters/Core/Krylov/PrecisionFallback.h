// Solves that start with a preconditioner in single precision and go on in double precision where
// that is not enough.
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

/// One cycle from zero as the preconditioner, and the same cycle with factors in double precision
/// as its replacement.
WithFallback<Preconditioner> CycleWithFallback(const Multigrid& multigrid);

/// Calls SolveConjugateGradients or SolveCycles, with at most one fallback to double precision. An
/// iteration falls back if it is too slow (Stagnation::IsTooSlow) or breaks down, and if B has a
/// replacement.
/// The second iteration starts from the x reached so far, or from zero after a breakdown, and has
/// the iterations that are left. It ends at a standstill. The record of the iteration `doubleSince`
/// is measured in double precision. options.giveUp applies only where B is in double precision from
/// the start.
SolveReport SolveWithFallback(IterationType iteration, const LinearOperator& A,
  const WithFallback<Preconditioner>& B, const MultiVector& b, MultiVector& x,
  const SolveOptions& options, const Projection& project = {}, const Progress& progress = {});

} // namespace gridfem

#endif
