// The clipped surface of several ranks, as one of them sees it: the pieces in and around its cells,
// wherever their triangles come from.
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
  GridSpaceOptions space;   // of a depth that may be AutomaticDepth
  int granularity = 0;      // level of the blocks that are divided among the ranks; BlockPartition
  bool isBelowHats = false; // which need memory, too
  /// Below hats: the grid is made coarser until it has at most so many functions for each point of
  /// the surface. A granularity is to fit it then. [DepthForPoints]
  double functionsPerPoint = std::numeric_limits<double>::infinity();
  /// Of the rank's own triangles, which are pieces of its grid already; null: they are clipped. Not
  /// below hats.
  std::shared_ptr<const GivenCells> given;
};

struct RankClip
{
  /// Collective.
  /// @param own     this rank's triangles, world units
  /// @param progress        of this rank alone, which reports as often as its work is long
  /// @param copiesOfOthers  triangles of its points that it has as copies of another rank's
  /// Throws RankFailure, on all ranks, with what went wrong on one, and Aborted.
  RankClip(const Communicator& ranks, const TriangleMesh& own, const RankSpaceOptions& options,
    const Progress& progress = {}, const TriangleList& copiesOfOthers = {});

  /// Collective. Leaves the pieces in the cells of this rank, without links. Those of all ranks,
  /// one rank after the other, are the pieces of one that clips all.
  void KeepOwn(const Communicator& ranks);

  std::shared_ptr<const BlockPartition> partition;
  std::shared_ptr<Redistribution> distribution;
  std::shared_ptr<const TriangleCopies> copies;
  std::shared_ptr<const TriangleMesh> mesh; // received: what the pieces refer to
  ClippedMesh clipped;
};

} // namespace gridfem

#endif
