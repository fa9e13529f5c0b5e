// Which pieces of a clipped mesh share an edge.
#ifndef GridFEM_Links_h
#define GridFEM_Links_h

#include "Clip.h"
#include "Parallel.h"

#include <atomic>
#include <limits>
#include <vector>

namespace gridfem
{

/// A piece has an edge; edges are numbered, and equal for all pieces that share them.
struct EdgeUse
{
  Id edge;
  Id piece;
};

/// Links for edges that more than two pieces use: pieces of one cell in a star, the stars of
/// different cells pairwise. Sorts `uses`.
void LinkStars(
  std::vector<EdgeUse>& uses, const std::vector<Id>& pieceCell, std::vector<PieceLink>& links);

/// Appends a link for every two pieces that use the same edge.
/// @param forUses  forUses(block, visit) calls visit(edge, piece) for every use in that block; it
/// is
///                 called twice. The links depend on that order, not on the number of threads.
template<class ForUses>
void LinkByEdges(Id blocks, const ForUses& forUses, Id numberOfEdges,
  const std::vector<Id>& pieceCell, int threads, std::vector<PieceLink>& links,
  const Progress& progress)
{
  // The lowest piece and the number of uses of each edge: neither depends on the order in which
  // threads arrive.
  struct Edge
  {
    std::atomic<Id> lowest{ std::numeric_limits<Id>::max() };
    std::atomic<Id> count{ 0 };
  };
  std::vector<Edge> edges(numberOfEdges);
  ParallelBlocks(
    blocks, threads,
    [&](Id block)
    {
      forUses(block,
        [&](Id e, Id piece)
        {
          Edge& edge = edges[e];
          edge.count.fetch_add(1, std::memory_order_relaxed);
          Id known = edge.lowest.load(std::memory_order_relaxed);
          while (piece < known &&
                 !edge.lowest.compare_exchange_weak(known, piece, std::memory_order_relaxed))
          {
          }
        });
    },
    progress.Part(0.0, 0.4));
  std::vector<std::vector<PieceLink>> pairs(blocks);
  std::vector<std::vector<EdgeUse>> shared(blocks);
  ParallelBlocks(
    blocks, threads,
    [&](Id block)
    {
      forUses(block,
        [&](Id e, Id piece)
        {
          const Id other = edges[e].lowest.load(std::memory_order_relaxed);
          if (edges[e].count.load(std::memory_order_relaxed) > 2)
          {
            shared[block].push_back({ e, piece });
          }
          else if (other != piece)
          {
            pairs[block].push_back({ other, piece });
          }
        });
    },
    progress.Part(0.4, 0.8));
  std::vector<EdgeUse> stars;
  for (Id block = 0; block < blocks; ++block)
  {
    links.insert(links.end(), pairs[block].begin(), pairs[block].end());
    stars.insert(stars.end(), shared[block].begin(), shared[block].end());
  }
  LinkStars(stars, pieceCell, links);
}

} // namespace gridfem

#endif
