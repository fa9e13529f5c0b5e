// The numbers that the functions of a level have on all ranks together.
#ifndef GridFEM_LevelNumbering_h
#define GridFEM_LevelNumbering_h

#include "Grid/PatchLevel.h"
#include "Parallel/BlockPartition.h"

#include <vector>

namespace gridfem
{

/// Another rank, and functions here that touch its cells, too: in ascending order of their numbers,
/// so that both ranks list them in the same order.
struct RankNeighbour
{
  int rank;
  std::vector<Index> functions;
};

/// The functions that touch a cell of this rank; of hats those that it holds (RankHats). A function
/// belongs to the lowest rank whose cells it touches, so that those of others have lower numbers:
/// they come first here, and the numbers ascend. Numbers of one rank are contiguous.
struct LevelNumbering
{
  Id begin = 0; // number of this rank's first function
  Id total = 0; // functions of all ranks
  std::vector<Id> number;
  std::vector<Index> touching;           // how many ranks each function touches
  Index foreign = 0;                     // functions of other ranks among them
  std::vector<RankNeighbour> neighbours; // ascending by rank

  Index Functions() const { return static_cast<Index>(number.size()); }
  Index OwnFunctions() const { return this->Functions() - foreign; }
};

/// Patches first .. last of a level, whose cells this rank owns.
struct PatchRange
{
  Index first = 0;
  Index last = 0;
};

PatchRange OwnPatches(const PatchLevel& level, const BlockPartition& partition, int rank);

/// Collective. Decides from the patches around this rank's cells which rank owns what; owners then
/// tell the numbers.
/// @param level  with all patches in and around this rank's cells
/// @param place  gets, per function of `level`, its place in the numbering; -1 elsewhere
LevelNumbering NumberLevel(const Communicator& ranks, const BlockPartition& partition,
  const PatchLevel& level, std::vector<Index>& place);

/// The place of a patch among those of its cell: the same on all ranks that see the cell.
Index PlaceInCell(const PatchLevel& level, Index patch);

/// The first patch in a cell; where there is none, the first behind it.
Index FirstInCell(const PatchLevel& level, MortonKey cell);

} // namespace gridfem

#endif
