// One rank's part of a clipped surface: the pieces in and around its cells. Their triangles may
// come from any rank.
#ifndef GridFEM_RankClip_h
#define GridFEM_RankClip_h

#include "Grid/GivenPieces.h"
#include "Parallel/TriangleCopies.h"
#include "Spaces/GridSpace.h"

#include <limits>
#include <memory>

namespace gridfem
{

struct RankSpaceOptions
{
  GridSpaceOptions space;   // its depth may be AutomaticDepth
  int granularity = 0;      // level of the blocks divided among the ranks; BlockPartition
  bool isBelowHats = false; // hat functions need memory, too
  /// For grids below hats: the grid is made coarser until it has at most this many functions per
  /// point of the surface. A granularity has to fit the coarser grid. [DepthForPoints]
  double functionsPerPoint = std::numeric_limits<double>::infinity();
  /// Cells of the rank's own triangles, which are pieces of its grid already. Null: triangles are
  /// clipped. Not for grids below hats.
  std::shared_ptr<const GivenCells> given;
};

struct RankClip
{
  /// Collective.
  /// @param own             this rank's triangles, world units
  /// @param progress        of this rank alone; it reports as often as its work requires
  /// @param copiesOfOthers  triangles of its points that are copies of another rank's triangles
  /// Throws RankFailure on all ranks if one rank fails, with its reason, and Aborted.
  RankClip(const Communicator& ranks, const TriangleMesh& own, const RankSpaceOptions& options,
    const Progress& progress = {}, const TriangleList& copiesOfOthers = {});

  /// Collective. Keeps only the pieces in the cells of this rank, without links. The pieces of all
  /// ranks, ordered by rank, are the pieces of a single rank that clips everything.
  void KeepOwn(const Communicator& ranks);

  std::shared_ptr<const BlockPartition> partition;
  std::shared_ptr<Redistribution> distribution;
  std::shared_ptr<const TriangleCopies> copies;
  std::shared_ptr<const TriangleMesh> mesh; // the received mesh that the pieces refer to
  ClippedMesh clipped;
};

} // namespace gridfem

#endif
