// Solves that go on in double precision where the smoother's factors in single precision turn out
// not to be enough.
#ifndef GridFEM_PrecisionFallback_h
#define GridFEM_PrecisionFallback_h

#include "Krylov/ConjugateGradients.h"

namespace gridfem
{

enum class IterationType
{
  ConjugateGradients = 0, // with one cycle as preconditioner
  Cycles = 1              // the cycle alone
};

/// SolveConjugateGradients or SolveCycles. Where smoothers hold factors in single precision, an
/// iteration that is too slow (Stagnation::IsTooSlow) or breaks down begins anew, once, from the x
/// it has reached or from zero, for the iterations that are left: with a copy of the hierarchy
/// whose factors are in double precision. That one ends at a standstill. What the report says of
/// the iteration of this change, `doubleSince`, is measured in double precision. The copy takes
/// memory and time like new factors for the hierarchy, and only then. options.giveUp counts where
/// there are no factors in single precision.
SolveReport SolveWithFallback(IterationType iteration, const Multigrid& multigrid,
  const MultiVector& b, MultiVector& x, const SolveOptions& options, const Projection& project = {},
  const Progress& progress = {});

} // namespace gridfem

#endif
