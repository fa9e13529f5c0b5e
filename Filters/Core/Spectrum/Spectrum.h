// The smallest eigenpairs of L x = α M x by a nested block method. [NUMERICS §3; T §4.3.1]
#ifndef GridFEM_Spectrum_h
#define GridFEM_Spectrum_h

#include "Spaces/SpaceLevels.h"

namespace gridfem
{

struct SpectrumOptions
{
  int numberOfModes = 10; // >= 1
  /// Wanted relative error of the eigenvalues: the square of the residual measure sqrt(rᵀBr / θ).
  /// The error of the space is far larger at any depth that fits into memory.
  double tolerance = 1e-6;     // in (0, 1)
  int maximumIterations = 100; // per level, >= 0
  /// Continues beyond numberOfModes to the end of the last multiplet. The constants are not
  /// completed, because ten thousand components have ten thousand of them.
  bool completeMultiplets = false;
  /// V: it needs at most one more step than W, and few steps are needed. A cycle costs a quarter
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
  bool singlePrecision = false;    // of all cycles (SpectrumCycle); the result is in double
  std::string where;               // the device of the cycles; see Multigrid::Where
  bool truncated = false;          // fewer modes exist than were asked for
  Index numberOfConstants = 0;     // how many exist: one per connected component
  bool cutsMultiplet = false;      // the next eigenvalue belongs to the multiplet of the last
  /// The relative error of each eigenvalue, as the error of the space. It follows from the values
  /// of the same modes on the two next coarser levels. It is 1 (unknown) if the next one has no
  /// such mode. [SpectrumAccuracy.h]
  std::vector<double> estimatedErrors;
  std::vector<char> isErrorTrusted; // per eigenvalue: the levels show that the error falls
};

/// Computes the smallest eigenpairs by a dense problem on a coarse level, prolongation, and block
/// iterations on each level. These use one multigrid cycle of L + σM and a rank-revealing
/// Rayleigh-Ritz (M may be singular). The zero modes are exact: one constant per connected
/// component, in the order of the components.
/// Start and sign are fixed: the entry of largest magnitude of M x is positive, near ties go to the
/// lowest index. Same bits for any number of threads. The blocks are in single precision if the
/// cycles are and the tolerance is at least 1e-7; this halves the memory. The result is orthonormal
/// and its values are Rayleigh quotients, in double precision.
/// Throws InvalidInput for options out of range, and Aborted. If the finest level does not contain
/// the next coarser one, the two steps below are taken.
Spectrum ComputeSpectrum(
  const SpaceLevels& space, const SpectrumOptions& options, const Progress& progress = {});

/// The same where all levels are nested, with any functions on them. Collective; progress is
/// aborted for all processes or none. Vectors have the rows of this process, and values are the
/// same everywhere.
Spectrum ComputeOnNestedLevels(
  const SpaceLevels& space, const SpectrumOptions& options, const Progress& progress = {});

/// The first step: the spectrum of the nested levels. It is the result if all levels are nested.
/// Otherwise it has guards beyond the wanted modes, to a loose tolerance.
Spectrum ComputeNestedSpectrum(
  const SpaceLevels& space, const SpectrumOptions& options, const Progress& progress = {});

/// The second step. It does nothing if all levels are nested. Otherwise it prolongs the pairs to
/// the finest level and improves them by block iterations with one cycle of the whole hierarchy.
/// Estimated errors are the errors of the nested levels plus the excess of the finest level's
/// values over the values of the nested levels. No space has eigenvalues below the eigenvalues of
/// the surface, so the sum is the error of the worse of the two.
/// @param nested  may have fewer modes than asked for, at the price of more iterations
Spectrum FinishSpectrum(const SpaceLevels& space, Spectrum nested, const SpectrumOptions& options,
  const Progress& progress = {});

/// Bytes of the computation beyond the space, for this number of functions on the finest level, in
/// single precision. Within a fifth, from 20 to 1,000 modes.
double EstimateSpectrumMemory(Id functions, Id modes, int threads = 0);

/// Seconds of the computation from a hundred modes on, on a processor of 2023: the part that grows
/// with the square of the number of modes. Within a factor of three.
double EstimateSpectrumSeconds(Id functions, Id modes, int threads = 0);

} // namespace gridfem

#endif
