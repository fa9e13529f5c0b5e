// The one data structure: a level of the hierarchy is an eight-node element mesh. [DESIGN §2]
// A patch is a connected piece of the surface inside one cell; it touches exactly eight functions.
// The plain space and the connectivity-aware space differ in the patch list alone. [T ch. 6]
#ifndef GridFEM_PatchLevel_h
#define GridFEM_PatchLevel_h

#include "Base/Job.h"
#include "Grid/Clip.h"

#include <vector>

namespace gridfem
{

/// Trilinear B-splines that do not vanish inside one cell, one per corner, x fastest.
constexpr int FunctionsPerPatch = 8;

struct PatchLevel
{
  int depth = 0;
  std::vector<MortonKey> cell;                           // per patch, ascending
  std::vector<std::array<Index, FunctionsPerPatch>> dof; // per patch, corner order x fastest
  Array<Index> parent;                                   // per patch; empty on the coarsest level
  Index numberOfFunctions = 0;

  Id NumberOfPatches() const { return static_cast<Id>(cell.size()); }
  int Octant(Id patch) const { return static_cast<int>(cell[patch] & 7); }
};

/// Which points of a patch list count as one function.
enum class FunctionSupport
{
  Plain,            // one function per grid corner
  ConnectivityAware // one function per connected component of the corner's support
};

/// Patches of the finest level: connected pieces of a cell (or all pieces of it, when plain).
struct PatchPartition
{
  Array<Index> piecePatch;     // per piece
  std::vector<MortonKey> cell; // per patch, ascending
  Array<Link> links;           // sorted, unique
};

/// Groups the pieces of a clipped mesh to patches. A patch whose area is below 1e-10 of a cell face
/// joins a patch it shares an edge with, if there is one: rounding makes no functions.
/// Cost O(pieces + links); the same for any number of threads.
PatchPartition BuildPatches(const ClippedMesh& clipped, FunctionSupport support, int threads = 0);

/// The links between the groups that linked items belong to: from pieces to their patches, from
/// patches to their parents. Sorted by first, then second; unique.
Array<Link> LinksOfGroups(const Array<Link>& links, const Array<Index>& group, int threads = 0);

/// The finest level on given patches; functions are numbered in the order of their first patch.
/// Throws InvalidInput when there are more than 2^31 - 1 functions.
PatchLevel BuildFinestLevel(
  int depth, const PatchPartition& patches, FunctionSupport support, int threads = 0);

/// The levels above `finest`, down to depth 0: coarse patches are unions of connected fine patches
/// inside the parent cell. Returns finest first; fills `parent` of every level but the last.
/// @param links  of the finest level's patches
std::vector<PatchLevel> BuildLevels(
  PatchLevel finest, Array<Link> links, FunctionSupport support, const Job& job = {});

/// Connected component of every function: functions of one patch are connected. Numbered 0, 1, ...
/// in the order of the lowest function.
std::vector<Index> FunctionComponents(const PatchLevel& level, int threads = 0);

} // namespace gridfem

#endif
