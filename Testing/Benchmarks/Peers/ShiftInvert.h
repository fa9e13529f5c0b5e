// The usual way to the smallest eigenpairs of L x = α M x on hat functions: shift-invert Lanczos
// (Spectra) on a factor by CHOLMOD.
#ifndef GridFEM_Benchmarks_ShiftInvert_h
#define GridFEM_Benchmarks_ShiftInvert_h

#include "HatMatrices.h"

#include <vector>

namespace gridfem::benchmarks
{

struct HatSpectrum
{
  std::vector<double> eigenvalues; // ascending, 1 / L²; fewer than wanted when not all converged
  double solves = 0.0;             // substitutions
};

/// The `count` smallest, basis of 2 count vectors, Ritz residuals to 1e-6. One thread but for the
/// BLAS of the factor.
HatSpectrum ComputeHatSpectrum(const HatMatrices& hats, int count);

} // namespace gridfem::benchmarks

#endif
