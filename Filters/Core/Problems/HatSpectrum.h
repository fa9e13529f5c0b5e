// The smallest eigenpairs on the hat functions of a mesh, found through those on the grid.
#ifndef GridFEM_HatSpectrum_h
#define GridFEM_HatSpectrum_h

#include "Problems/Spectrum.h"
#include "Spaces/HatMultigrid.h"

namespace gridfem
{

/// What to ask ComputeSpectrum for to get a good start: guards behind the wanted modes, to a loose
/// tolerance.
SpectrumOptions HatStartOptions(SpectrumOptions options);

/// Carries the pairs on the grid over to the hats and improves them by block iterations with one
/// cycle of the hybrid hierarchy. The result is that of any solver for the cotangent stiffness and
/// the area mass; constants of the components are exact. `vectors` has one row per hat.
/// `estimatedErrors` are relative errors as eigenvalues of the surface: what is estimated for the
/// grid, and what the hats lie above it. Both spaces lie within that of all functions, so that no
/// eigenvalue falls below the surface's, and this is the error of the worse of the two.
/// @param grid  of HatStartOptions(options); fewer modes do, too, at the price of more iterations
/// Same bits for any number of threads. Throws Aborted.
Spectrum ComputeHatSpectrum(const HatHierarchy& hats, const GridFunctions& space,
  const LevelOperators& system, const Spectrum& grid, const SpectrumOptions& options,
  const Progress& progress = {});

/// The same with its own start. Throws like ComputeSpectrum.
Spectrum ComputeHatSpectrum(const HatHierarchy& hats, const GridFunctions& space,
  const LevelOperators& system, const SpectrumOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
