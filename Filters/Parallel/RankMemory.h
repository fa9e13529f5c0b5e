// Whether the ranks have the memory that a surface takes, before they take it.
#ifndef GridFEM_RankMemory_h
#define GridFEM_RankMemory_h

#include "Parallel/Communicator.h"

#include "Grid/TriangleMesh.h"

namespace gridfem
{

struct Grid;
struct MemoryNeed;

/// Collective. A run that would not have the memory is refused before it takes long: when the ranks
/// of a machine need more than it has, or one rank more than the limit of its process (`ulimit -v`)
/// leaves.
/// @param own  what this rank needs
/// Throws RankFailure on all ranks.
void RequireMemory(const Communicator& ranks, const MemoryNeed& own);

/// Collective. Whether the ranks should have the memory for a surface that is divided evenly among
/// them.
/// @param own  this rank's triangles, wherever they are
bool FitsMemory(
  const Communicator& ranks, const TriangleMesh& own, const Grid& grid, bool hasHats = false);

/// Collective. Refuses a surface for which the memory is not enough.
/// @param received  the triangles that this rank clips
/// @param hasHats   hat functions come above those of the grid
/// Throws RankFailure on all ranks.
void RequireMemory(
  const Communicator& ranks, const TriangleMesh& received, const Grid& grid, bool hasHats = false);

} // namespace gridfem

#endif
