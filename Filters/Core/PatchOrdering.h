// The order in which a level's patches are relaxed.
#ifndef GridFEM_PatchOrdering_h
#define GridFEM_PatchOrdering_h

#include "Level.h"
#include "Smoother.h"

namespace gridfem
{

/// Blocks of 8 x 8 x 8 cells (patches in Morton order inside), coloured by the parity of the
/// block's i, j, k: eight colours. A sweep then stays in the cache and every block is a serial job.
PatchOrder OrderPatches(const Level& level);

} // namespace gridfem

#endif
