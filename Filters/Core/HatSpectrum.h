// The smallest eigenpairs on the hat functions of a mesh, found through those on the grid.
#ifndef GridFEM_HatSpectrum_h
#define GridFEM_HatSpectrum_h

#include "HatMultigrid.h"
#include "Spectrum.h"

namespace gridfem
{

/// The pairs on the grid, to a loose tolerance, carried over to the hats, then block iterations
/// with one cycle of the hybrid hierarchy. The result is that of any solver for the cotangent
/// stiffness and the area mass; constants of the components are exact. `vectors` has one row per
/// hat. `estimatedErrors` are the relative differences from the eigenvalues on the grid: two
/// discretisations of one surface. With options.completeMultiplets the list is as long as on the
/// grid. Same bits for any number of threads. Throws like ComputeSpectrum.
Spectrum ComputeHatSpectrum(const HatHierarchy& hats, const FunctionSpace& space,
  const System& system, const SpectrumOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
