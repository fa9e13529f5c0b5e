// Proposes functional maps between few modes, from which refinements start.
#ifndef GridFEM_MapStarts_h
#define GridFEM_MapStarts_h

#include "Spectrum/MapRefinement.h"

#include <vector>

namespace gridfem
{

/// Maps of the constant and of the next five modes: each mode is a mode of the reference with
/// either sign. Two modes also change places if their eigenvalues differ by less than 30 % on one
/// of the surfaces.
std::vector<MultiVector> StartsBySigns(const ModeRows& surface, const ModeRows& reference);

/// A map of the first twenty modes. As well as possible, it takes functions around each landmark to
/// functions around its partner, and modes to modes with similar eigenvalues. [Ovsjanikov et al.
/// 2012]
/// @param landmarks  at least one
MultiVector StartByLandmarks(
  const ModeRows& surface, const ModeRows& reference, const std::vector<Landmark>& landmarks);

} // namespace gridfem

#endif
