// The one data structure: a level of the hierarchy is an element mesh [DESIGN §2]. A patch is a
// connected piece of the surface inside one cell. It touches a fixed number of functions.
// The plain space and the connectivity-aware space differ only in their lists of patches. [T ch. 6]
#ifndef GridFEM_PatchLevel_h
#define GridFEM_PatchLevel_h

#include "Base/Job.h"
#include "Grid/Clip.h"

#include <vector>

namespace gridfem
{

/// Number of trilinear B-splines that do not vanish inside a cell: one per corner, x fastest.
constexpr int FunctionsPerPatch = 8;

/// Number of quadratic B-splines that do not vanish inside a cell: one for each cell around it and
/// for the cell itself, x fastest. See SmoothLevels.h.
constexpr int SmoothFunctionsPerPatch = 27;

template<int Functions>
struct BasicPatchLevel
{
  int depth = 0;
  std::vector<MortonKey> cell;                   // per patch, ascending
  std::vector<std::array<Index, Functions>> dof; // per patch, x fastest
  Array<Index> parent;                           // per patch; empty on the coarsest level
  Index numberOfFunctions = 0;

  Id NumberOfPatches() const { return static_cast<Id>(cell.size()); }
  int Octant(Id patch) const { return static_cast<int>(cell[patch] & 7); }
};

using PatchLevel = BasicPatchLevel<FunctionsPerPatch>;
using SmoothLevel = BasicPatchLevel<SmoothFunctionsPerPatch>;

/// Decides which corners of patches share one function.
enum class FunctionSupport
{
  Plain,            // one function per grid corner
  ConnectivityAware // one function per connected component of the corner's support
};

/// The patches of the finest level. A patch is a connected group of pieces in a cell, or all pieces
/// in it for FunctionSupport::Plain.
struct PatchPartition
{
  Array<Index> piecePatch;     // per piece
  std::vector<MortonKey> cell; // per patch, ascending
  Array<Link> links;           // sorted, unique
};

/// Groups the pieces of a clipped mesh into patches. A patch whose area is below 1e-10 of a cell
/// face joins a patch that shares an edge with it, if there is one. Rounding errors therefore
/// create no functions. Cost O(pieces + links); the result is the same for any number of threads.
PatchPartition BuildPatches(const ClippedMesh& clipped, FunctionSupport support, int threads = 0);

/// Returns the links between groups whose items are linked: between patches whose pieces are
/// linked, or between parents whose patches are linked. Sorted by first, then by second; unique.
Array<Link> LinksOfGroups(const Array<Link>& links, const Array<Index>& group, int threads = 0);

/// Builds the finest level on given patches. Functions are numbered in the order of their first
/// patch. Throws InvalidInput when there are more than 2^31 - 1 functions.
PatchLevel BuildFinestLevel(
  int depth, const PatchPartition& patches, FunctionSupport support, int threads = 0);

/// Builds the coarser levels, down to depth 0. A coarse patch is the union of connected fine
/// patches inside the parent cell. Returns all levels, finest first, and fills `parent` of every
/// level except the last.
/// @param links  links between the patches of the finest level
std::vector<PatchLevel> BuildLevels(
  PatchLevel finest, Array<Link> links, FunctionSupport support, const Job& job = {});

/// Returns the connected component of every function: the functions of a patch are connected.
/// Components are numbered 0, 1, ... in the order of their lowest function.
template<int Functions>
std::vector<Index> FunctionComponents(const BasicPatchLevel<Functions>& level, int threads = 0);

/// Returns the number of components that functions have.
/// @param component  of each function (FunctionComponents)
Index NumberOfComponents(const std::vector<Index>& component);

/// Returns the number of functions of the largest connected component.
template<int Functions>
Index LargestComponent(const BasicPatchLevel<Functions>& level, int threads = 0);

} // namespace gridfem

#endif
