// What the spectra on the grid and on the hat functions of the mesh share.
#ifndef GridFEM_CollectSpectrum_h
#define GridFEM_CollectSpectrum_h

#include "BlockIteration.h"
#include "Multigrid.h"
#include "Spectrum.h"

namespace gridfem
{

/// The first `zeros` constants in front, then the pairs of the report; the entry of largest
/// magnitude of M x becomes positive, near ties to the lowest index. Estimated errors: 0 for the
/// constants, none yet for the others. Takes the vectors out of `pairs`: they become the result in
/// the same memory where they are wide enough.
Spectrum CollectSpectrum(const Constants& constants, Index zeros, EigenPairs& pairs,
  const BlockReport& report, const SparseMatrix& mass, int threads);

/// One cycle from `level` on, from zero. The hierarchy has to outlive it.
Preconditioner CyclePreconditioner(const Multigrid& multigrid, std::size_t level);

} // namespace gridfem

#endif
