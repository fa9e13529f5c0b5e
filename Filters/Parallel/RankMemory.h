// Checks whether the ranks have the memory for a surface, before they use it.
#ifndef GridFEM_RankMemory_h
#define GridFEM_RankMemory_h

#include "Parallel/Communicator.h"

#include "Grid/TriangleMesh.h"

namespace gridfem
{

struct Grid;
struct MemoryNeed;

/// Collective. Refuses a job without enough memory before it takes long. It compares the need of
/// all ranks on a machine with the machine's memory, and the need of each rank with the limit of
/// its process (`ulimit -v`).
/// @param own  the need of this rank
/// Throws RankFailure on all ranks.
void RequireMemory(const Communicator& ranks, const MemoryNeed& own);

/// Collective. Whether the ranks should have enough memory for a surface that is divided evenly
/// among them.
/// @param own  this rank's triangles, wherever they are
bool FitsMemory(
  const Communicator& ranks, const TriangleMesh& own, const Grid& grid, bool hasHats = false);

/// Collective. Refuses a surface if there is not enough memory.
/// @param received  the triangles that this rank clips
/// @param hasHats   there are hat functions above the grid
/// Throws RankFailure on all ranks.
void RequireMemory(
  const Communicator& ranks, const TriangleMesh& received, const Grid& grid, bool hasHats = false);

} // namespace gridfem

#endif
