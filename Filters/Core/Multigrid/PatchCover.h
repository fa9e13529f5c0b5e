// A subset of a level's patches that still reaches every function: a cheaper sweep.
#ifndef GridFEM_PatchCover_h
#define GridFEM_PatchCover_h

#include "Multigrid/Smoother.h"

namespace gridfem
{

/// Patches of `order`, in the same order, blocks and colours, such that every unknown lies in at
/// least `times` of them, or in all that contain it. Chosen greedily: first patches that help all
/// eight unknowns, then those that help seven, ... Once needs a quarter (flat pieces in cells) to
/// half (curved surfaces) of the patches.
/// @param times  >= 1
/// Throws InvalidInput when `times` is smaller or a patch names an unknown that is not there.
PatchOrder CoverUnknowns(const PatchOrder& order, Index unknowns, int times);

} // namespace gridfem

#endif
