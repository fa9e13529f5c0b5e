// The smallest eigenpairs of the Laplacian on a surface that several ranks hold together.
// [Problems/Spectrum.h, whose words hold here, too]
#ifndef GridFEM_RankSpectrum_h
#define GridFEM_RankSpectrum_h

#include "Parallel/RankSpace.h"
#include "Problems/Spectrum.h"

namespace gridfem
{

/// Collective. On the levels that all ranks share each of them computes the same; the pairs are
/// then carried over to the divided ones and improved there by the same block iteration, with the
/// cycle of the ranks. All in double precision. Components come in another order than on one rank,
/// so that the zero modes of several do, too.
/// @return the same on all ranks but for the vectors: rows = functions that touch this rank's cells
/// Throws RankFailure on all ranks when one fails, InvalidInput for options out of range, and
/// Aborted.
Spectrum ComputeSpectrum(
  const RankSpace& space, const SpectrumOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
