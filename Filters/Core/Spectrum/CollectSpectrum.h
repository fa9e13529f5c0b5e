// Makes the result of an eigenproblem from its constants and its pairs.
#ifndef GridFEM_CollectSpectrum_h
#define GridFEM_CollectSpectrum_h

#include "Krylov/Lobpcg.h"
#include "Spectrum/Spectrum.h"

namespace gridfem
{

/// Puts the first `zeros` constants in front, then the pairs of the report. In any precision of the
/// blocks, each vector gets mass 1. Its value is its Rayleigh quotient, in double precision, and
/// values ascend. The entry of largest magnitude of M x becomes positive; near ties go to the
/// lowest index.
/// A vector whose mass is only rounding is dropped. From pairs in single precision it stays, at the
/// end and with the value NaN, because it may have a mass in double precision. Estimated errors are
/// 0 for the constants and not set for the others. Takes the vectors out of `pairs`.
/// @param tolerance  a pair has converged when the square of its residual is no larger
/// @param ofPairs    a row of numbers for each pair of the report; they become the rows of the
///   vectors behind the constants
template<class Real>
Spectrum CollectSpectrum(const Constants& constants, Index zeros, EigenPairs<Real>& pairs,
  const BlockReport& report, double tolerance, const SpectralProblem<Real>& problem,
  Eigen::MatrixXd& ofPairs, const Progress& progress = {});

} // namespace gridfem

#endif
