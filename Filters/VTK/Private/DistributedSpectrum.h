// The spectrum of the pieces of a surface that several MPI ranks hold: none of them gathers it.
// Without MPI there is no such way.
#ifndef GridFEM_DistributedSpectrum_h
#define GridFEM_DistributedSpectrum_h

#include "SurfaceSolverState.h"

#include "Problems/Spectrum.h"

namespace gridfem
{

struct DistributedModes
{
  Spectrum spectrum;       // grid units; without its vectors
  double unitLength = 1.0; // of these
  MultiVector values;      // at the points of this rank's piece, a column per mode, world units
};

/// Collective, on the ranks of VTK's global controller.
/// @param mesh     of this rank's piece; without triangles where it has none
/// @param options  a depth is chosen, functions are those of a grid
/// Throws on all ranks when it throws on one: Aborted on all, or the error on the first rank and
/// FailedElsewhere on the others.
DistributedModes FindModesTogether(const InputMesh& mesh, int numberOfModes,
  bool completeMultiplets, const SurfaceOptions& options, const Progress& progress);

} // namespace gridfem

#endif
