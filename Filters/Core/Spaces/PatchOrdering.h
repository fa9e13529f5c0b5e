// Chooses the order in which a level's patches are relaxed.
#ifndef GridFEM_PatchOrdering_h
#define GridFEM_PatchOrdering_h

#include "Grid/PatchLevel.h"
#include "Multigrid/Smoother.h"

namespace gridfem
{

/// Makes blocks of 8 x 8 x 8 cells in eight colors, given by the parity of the block's i, j, k. A
/// sweep then stays in the cache, and every block is a serial job. Inside a block, patches are
/// visited by the parity of their cell, then in Morton order. Throws InvalidInput when patches are
/// not sorted by cell.
PatchOrder OrderPatches(const PatchLevel& level);

/// The same for quadratic functions. Along each axis, the functions of a block belong to cells
/// -1 .. 8, and their rows reach cells -3 .. 10. The next block of the color begins at cell 16 with
/// functions of cell 15, so blocks of one color are apart here as well.
PatchOrder OrderPatches(const SmoothLevel& level);

/// Orders some patches of a level. The rows of their functions also have entries of the level's
/// other functions.
PatchOrder OrderPatches(const PatchLevel& some, const PatchLevel& level);

} // namespace gridfem

#endif
