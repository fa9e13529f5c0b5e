// Many lowest eigenpairs of L x = θ M x on one level, by block iterations on successive windows of
// the spectrum. Found pairs are locked, and later windows stay orthogonal to them. Dense problems
// therefore stay small, and memory grows with the pairs alone. [NUMERICS §3]
#ifndef GridFEM_LobpcgWindows_h
#define GridFEM_LobpcgWindows_h

#include "Krylov/Lobpcg.h"

namespace gridfem
{

/// The number of pairs to carry along for `wanted` pairs. The additional pairs keep the gap to the
/// rest of the spectrum open.
Index GuardedSize(Index wanted);

/// Columns of vectors that ImproveManyEigenPairs holds at its peak, in all blocks together.
Id HeldColumns(Index wanted);

/// Does the work of ImproveEigenPairs for any number of wanted pairs. A small number needs one
/// window only. The report has the iterations of the slowest window.
template<class Real>
BlockReport ImproveManyEigenPairs(const SpectralProblem<Real>& problem, const BlockOptions& options,
  EigenPairs<Real>& pairs, const Progress& progress = {});

} // namespace gridfem

#endif
