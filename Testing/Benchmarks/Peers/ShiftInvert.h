// The usual way to the smallest eigenpairs of L x = α M x on hat functions: a shift-invert Krylov
// space on a factor by CHOLMOD. Spectra (Lanczos) and SLEPc (Krylov-Schur) do it.
#ifndef GridFEM_Benchmarks_ShiftInvert_h
#define GridFEM_Benchmarks_ShiftInvert_h

#include "CotangentSystem.h"

#include <vector>

namespace gridfem::benchmarks
{

struct HatSpectrum
{
  std::vector<double> eigenvalues; // ascending, 1 / L²; fewer than wanted when not all converged
  Eigen::MatrixXd vectors;         // mass norm 1, one column each; only from Spectra
  double solves = 0.0;             // substitutions
};

/// Tolerances of Ritz residuals. The error of an eigenvalue goes with their square: about 1e-6, as
/// ours. A loose tolerance can miss one of several equal eigenvalues, but a reference must not.
constexpr double PairTolerance = 1e-3;
constexpr double TruthTolerance = 1e-8;

/// The `count` smallest pairs. The BLAS has its own threads. Spectra gets a basis of 1.5 count
/// vectors, which is faster here than the usual 2 count.
HatSpectrum SpectraSpectrum(const CotangentSystem& hats, int count, double tolerance);

/// The same with SLEPc's own choices. MessagePassing must be alive.
HatSpectrum SlepcSpectrum(const CotangentSystem& hats, int count, double tolerance);

} // namespace gridfem::benchmarks

#endif
