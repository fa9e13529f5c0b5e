// Which pieces of a clipped mesh share an edge.
#ifndef GridFEM_Links_h
#define GridFEM_Links_h

#include "Clip.h"

#include <vector>

namespace gridfem
{

/// A piece has an edge; edges are numbered, and equal for all pieces that share them.
struct EdgeUse
{
  Id edge;
  Id piece;
};

/// Appends a link for every two pieces that use the same edge. Where more than two do (non-manifold
/// edges) all get connected: pieces of one cell in a star, the stars of different cells pairwise.
/// @param uses  in blocks; the result depends on their order, not on the number of threads
void LinkByEdges(const std::vector<std::vector<EdgeUse>>& uses, Id numberOfEdges,
  const std::vector<Id>& pieceCell, int threads, std::vector<PieceLink>& links);

} // namespace gridfem

#endif
