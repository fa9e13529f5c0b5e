// Many lowest eigenpairs of L x = θ M x on one level: a block iteration on one window of the
// spectrum after the other. What is found is locked: later windows stay orthogonal to it, so dense
// problems stay small and memory grows with the pairs alone. [NUMERICS §3]
#ifndef GridFEM_LobpcgWindows_h
#define GridFEM_LobpcgWindows_h

#include "Krylov/Lobpcg.h"

namespace gridfem
{

/// Pairs carried along beyond the wanted ones: they keep the gap to the rest open.
Index GuardedSize(Index wanted);

/// Columns of vectors that ImproveManyEigenPairs holds at its peak, in all blocks.
Id HeldColumns(Index wanted);

/// As ImproveEigenPairs, for any number of wanted pairs; one window where they are few. The
/// iterations reported are those of the slowest window.
template<class Real>
BlockReport ImproveManyEigenPairs(const SpectralProblem<Real>& problem, const BlockOptions& options,
  EigenPairs<Real>& pairs, const Progress& progress = {});

} // namespace gridfem

#endif
