// The smallest eigenpairs of L x = α M x by a nested block method. [NUMERICS §3; T §4.3.1]
#ifndef GridFEM_Spectrum_h
#define GridFEM_Spectrum_h

#include "Spaces/SurfaceSpace.h"

namespace gridfem
{

struct SpectrumOptions
{
  int numberOfModes = 10; // >= 1
  /// Wanted relative error of the eigenvalues: the square of the residual measure sqrt(rᵀBr / θ).
  /// The error of the space is far larger at any depth that fits into memory.
  double tolerance = 1e-6;     // in (0, 1)
  int maximumIterations = 100; // per level, >= 0
  /// Go on behind numberOfModes to the end of the multiplet that is cut there, but not to that of
  /// the constants: ten thousand components have ten thousand.
  bool completeMultiplets = false;
  /// V: the few steps that are needed are at most one more than with W, and a cycle costs a quarter
  /// less.
  MultigridOptions multigrid{ CycleType::V };
};

/// Throws InvalidInput for numbers out of range.
void Validate(const SpectrumOptions& options);

struct Spectrum
{
  std::vector<double> eigenvalues; // ascending, per squared unit of length of the space
  MultiVector vectors;             // columns M-orthonormal; rows = finest functions
  std::vector<double> residuals;   // per pair: sqrt(rᵀBr / max(θ, shift)), r = L x - θ M x
  bool converged = false;          // all pairs reached the tolerance
  int numberOfConverged = 0;       // how many did
  int iterations = 0;              // on the finest level
  bool singlePrecision = false;    // of all cycles, see SpectrumCycle; the result is in double
  bool truncated = false;          // fewer modes exist than were asked for
  Index numberOfConstants = 0;     // that exist: one per connected component
  bool cutsMultiplet = false;      // the next eigenvalue belongs to the multiplet of the last
  /// Per pair: the relative error of the eigenvalue, as that of the space, from the next coarser
  /// level, whose error is four times as large; 1 (unknown) where that level has no such pair.
  std::vector<double> estimatedErrors;
};

/// Dense problem on a coarse level, prolongation, block iterations with one multigrid cycle of
/// L + σM per level, rank-revealing Rayleigh-Ritz (M may be singular). The zero modes, one constant
/// per connected component in the order of the components, are exact. Fixed start and sign (the
/// entry of largest magnitude of M x is positive, near ties to the lowest index): same bits for any
/// number of threads. Where cycles are in single precision and the tolerance is at least 1e-7, so
/// are the vectors that are worked on: half the memory; the result is orthonormal and its values
/// are Rayleigh quotients in double. Throws InvalidInput for options out of range, and Aborted.
/// Where the finest level does not contain the next coarser one the two steps below are taken.
Spectrum ComputeSpectrum(
  const SurfaceSpace& space, const SpectrumOptions& options, const Progress& progress = {});

/// The same where all levels are nested, whatever lies on them. Where processes divide levels, all
/// of them call it, with a progress that is aborted for all or none; vectors have the rows of this
/// process, and values are the same everywhere.
Spectrum ComputeOnNestedLevels(
  const SpaceLevels& space, const SpectrumOptions& options, const Progress& progress = {});

/// The first step: the spectrum of the nested levels, which is the result where all are nested.
/// Else it has guards behind the wanted modes, to a loose tolerance.
Spectrum ComputeNestedSpectrum(
  const SurfaceSpace& space, const SpectrumOptions& options, const Progress& progress = {});

/// The second: nothing where all levels are nested. Else carries the pairs over to the finest level
/// and improves them by block iterations with one cycle of the whole hierarchy. Estimated errors
/// are those of the nested levels, and what the finest level lies above them: no space has
/// eigenvalues below the surface's, so this is the error of the worse of the two.
/// @param nested  fewer modes than asked for do, too, at the price of more iterations
Spectrum FinishSpectrum(const SurfaceSpace& space, Spectrum nested, const SpectrumOptions& options,
  const Progress& progress = {});

/// Bytes that it takes beyond the space, for so many functions on the finest level, in
/// single precision: within a fifth, from 20 to 1,000 modes.
double EstimateSpectrumMemory(Id functions, Id modes, int threads = 0);

/// Seconds that it takes from a hundred modes on, on a processor of 2023: what grows with the
/// square of the number of modes. Within a factor of three.
double EstimateSpectrumSeconds(Id functions, Id modes, int threads = 0);

} // namespace gridfem

#endif
