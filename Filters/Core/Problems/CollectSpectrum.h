// The result of an eigenproblem from its constants and its pairs.
#ifndef GridFEM_CollectSpectrum_h
#define GridFEM_CollectSpectrum_h

#include "Krylov/Lobpcg.h"
#include "Problems/Spectrum.h"

namespace gridfem
{

/// The first `zeros` constants in front, then the pairs of the report. Whatever the precision of
/// the blocks: each vector gets mass 1 and its value is its Rayleigh quotient, in double precision,
/// and values ascend. The entry of largest magnitude of M x becomes positive, near ties to the
/// lowest index. A vector whose mass is rounding stays as it is; its value is that of the pair, or
/// NaN, at the end, for pairs in single precision. Estimated errors: 0 for the constants, none yet
/// for the others. Takes the vectors out of `pairs`.
template<class Real>
Spectrum CollectSpectrum(const Constants& constants, Index zeros, EigenPairs<Real>& pairs,
  const BlockReport& report, const SpectralProblem<Real>& problem);

} // namespace gridfem

#endif
