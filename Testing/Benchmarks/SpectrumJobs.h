// The smallest eigenpairs from the triangles on, by the grid and by the usual way on hat functions,
// each in a process of its own.
#ifndef GridFEM_Benchmarks_SpectrumJobs_h
#define GridFEM_Benchmarks_SpectrumJobs_h

#include "Grid/GridFunctions.h"
#include "ShiftInvert.h"
#include "Spaces/FunctionKind.h"

#include <cmath>
#include <vector>

namespace gridfem::benchmarks
{

struct SpectrumJob
{
  double unknowns = 0.0;
  double setup = 0.0;   // seconds of clip, space and system; of assembly
  double seconds = 0.0; // of everything
  double peak = 0.0;    // bytes beyond the mesh
  double steps = 0.0;   // block iterations on the finest level; substitutions
  double converged = 0.0;
  bool isStopped = false;          // before its end: seconds and peak until then, and nothing else
  std::vector<double> eigenvalues; // ascending, world units
};

SpectrumJob GridSpectrum(const TriangleMesh& mesh, int depth, int modes, int threads,
  FunctionSupport support = FunctionSupport::ConnectivityAware);

/// The same by the solver of Laplace Spectrum, with any kind of functions.
SpectrumJob SolverSpectrum(
  const TriangleMesh& mesh, FunctionKind kind, int depth, int modes, int threads);

/// SpectraSpectrum or SlepcSpectrum.
using HatEigensolver = HatSpectrum (*)(const CotangentSystem&, int, double);
/// @param tolerance  PairTolerance or TruthTolerance
/// @param limit      seconds after which it is stopped
SpectrumJob ShiftInvertSpectrum(HatEigensolver solver, const TriangleMesh& mesh, int modes,
  int blasThreads, double tolerance, double limit = HUGE_VAL);

/// The exact eigenvalues of the unit sphere: l (l + 1), 2 l + 1 times.
std::vector<double> SphereEigenvalues(std::size_t count);

} // namespace gridfem::benchmarks

#endif
