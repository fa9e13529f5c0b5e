// The order in which a level's patches are relaxed.
#ifndef GridFEM_PatchOrdering_h
#define GridFEM_PatchOrdering_h

#include "Grid/PatchLevel.h"
#include "Multigrid/Smoother.h"

namespace gridfem
{

/// Blocks of 8 x 8 x 8 cells, coloured by the parity of the block's i, j, k: eight colours. A sweep
/// then stays in the cache and every block is a serial job. Inside a block, patches are visited by
/// the parity of their cell, then in Morton order. Throws InvalidInput when patches are not sorted
/// by cell.
PatchOrder OrderPatches(const PatchLevel& level);

/// The same for some patches of a level, the rows of whose functions have entries of the others.
PatchOrder OrderPatches(const PatchLevel& some, const PatchLevel& level);

} // namespace gridfem

#endif
