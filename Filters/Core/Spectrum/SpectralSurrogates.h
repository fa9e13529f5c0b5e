// Random functions with the spectrum of a given function.
#ifndef GridFEM_SpectralSurrogates_h
#define GridFEM_SpectralSurrogates_h

#include "Spectrum/SpectralDescriptors.h"

#include <cstdint>

namespace gridfem
{

/// Returns shares (ModeExpansion) of random functions. In each group of modes they have the energy
/// Σ share² of the given functions, and the same products between the functions. A random
/// orthogonal matrix, uniform among all, multiplies the rows of each group.
///
/// Constant modes keep their shares. The groups after them have 3, 5, 7, ... modes, as on a sphere,
/// where a group has equal eigenvalues. On other surfaces the eigenvalues of a group differ little.
/// [Koussis, Pang, Jeganathan, Paton, Fornito, Robinson, Misic, Breakspear: Generation of surrogate
/// brain maps preserving spatial autocorrelation through random rotation of geometric eigenmodes,
/// 2024]
/// @param constants  number of constant modes
/// @param number     of the surrogate; others are independent, as are those of other seeds
MultiVector RotateWithinGroups(
  const MultiVector& shares, Index constants, std::uint64_t seed, Id number);

} // namespace gridfem

#endif
