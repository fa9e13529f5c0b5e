// The smallest eigenpairs on a finest level that does not contain the levels below it, found
// through those.
#ifndef GridFEM_UnnestedSpectrum_h
#define GridFEM_UnnestedSpectrum_h

#include "Problems/Spectrum.h"

namespace gridfem
{

/// What to ask the nested levels for to get a good start: guards behind the wanted modes, to a
/// loose tolerance.
SpectrumOptions StartOptions(SpectrumOptions options);

/// The second step of ComputeSpectrum. The result is that of any solver for the finest matrices;
/// constants of the components are exact. Same bits for any number of threads. Throws Aborted.
/// @param start  of the nested levels, with StartOptions
Spectrum ImproveSpectrum(const SurfaceSpace& space, const Spectrum& start,
  const SpectrumOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
