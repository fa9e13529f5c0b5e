// Numbers the functions of a level over all ranks.
#ifndef GridFEM_LevelNumbering_h
#define GridFEM_LevelNumbering_h

#include "Grid/PatchLevel.h"
#include "Parallel/BlockPartition.h"

#include <vector>

namespace gridfem
{

/// Another rank, and the functions here that also touch its cells. They are in ascending order of
/// their numbers, so both ranks list them in the same order.
struct RankNeighbor
{
  int rank;
  std::vector<Index> functions;
};

/// The functions that touch a cell of this rank; for hats, the functions that the rank holds
/// (RankHats). A function belongs to the lowest rank whose cells it touches. Functions of other
/// ranks therefore have lower numbers and come first here. Numbers ascend, and the numbers of one
/// rank are contiguous.
struct LevelNumbering
{
  Id begin = 0; // number of this rank's first function
  Id total = 0; // functions of all ranks
  std::vector<Id> number;
  std::vector<Index> touching;         // number of ranks that each function touches
  Index ghosts = 0;                    // number of functions that belong to other ranks
  std::vector<RankNeighbor> neighbors; // ascending by rank

  Index Functions() const { return static_cast<Index>(number.size()); }
  Index OwnFunctions() const { return this->Functions() - ghosts; }
};

/// Patches first .. last of a level are the patches in cells that this rank owns.
struct PatchRange
{
  Index first = 0;
  Index last = 0;
};

PatchRange OwnPatches(const PatchLevel& level, const BlockPartition& partition, int rank);

/// Collective. Decides from the patches around this rank's cells which rank owns each function.
/// Owners then send the numbers.
/// @param level  with all patches in and around this rank's cells
/// @param place  gets, per function of `level`, its place in the numbering; -1 elsewhere
LevelNumbering NumberLevel(const Communicator& ranks, const BlockPartition& partition,
  const PatchLevel& level, std::vector<Index>& place);

/// The place of a patch among the patches of its cell. It is the same on all ranks that see the
/// cell.
Index PlaceInCell(const PatchLevel& level, Index patch);

/// The first patch in a cell; if there is none, the first patch behind it.
Index FirstInCell(const PatchLevel& level, MortonKey cell);

} // namespace gridfem

#endif
