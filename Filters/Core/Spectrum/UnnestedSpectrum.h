// Finds the smallest eigenpairs on a finest level that does not contain the levels below it, with
// the help of those levels.
#ifndef GridFEM_UnnestedSpectrum_h
#define GridFEM_UnnestedSpectrum_h

#include "Spectrum/Spectrum.h"

namespace gridfem
{

/// Options of the nested levels that give a good start: guards beyond the wanted modes, and a loose
/// tolerance.
SpectrumOptions StartOptions(SpectrumOptions options);

/// The second step of ComputeSpectrum. The result is the same as from any solver for the finest
/// matrices. Constants of the components are exact. Same bits for any number of threads. Throws
/// Aborted.
/// @param start  of the nested levels, with StartOptions
Spectrum ImproveSpectrum(const SpaceLevels& space, Spectrum start, const SpectrumOptions& options,
  const Progress& progress = {});

} // namespace gridfem

#endif
