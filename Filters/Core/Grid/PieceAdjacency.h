// Finds the pieces of a clipped mesh that share an edge.
#ifndef GridFEM_PieceAdjacency_h
#define GridFEM_PieceAdjacency_h

#include "Base/Job.h"
#include "Grid/Clip.h"
#include "Grid/MeshEdges.h"

#include <vector>

namespace gridfem
{

/// One piece at one edge. All pieces that share an edge have the same edge number.
struct EdgeUse
{
  Index edge;
  Index piece;
};

/// Appends links between the pieces at each edge. Pieces in one cell are linked to the first of
/// them; these first pieces of different cells are linked pairwise. The links are appended edge by
/// edge and are the same for any number of threads.
/// @param uses   ascending by piece for each edge; a piece may use an edge twice
/// @param edges  number of edges
void LinkStars(const Array<EdgeUse>& uses, Id edges, const Array<Index>& pieceCell, int threads,
  Array<Link>& links);

/// Appends a link for every two pieces on different sides of a mesh edge that share a stretch of
/// it. More than two pieces at a stretch are linked as in LinkStars. The result is the same for any
/// number of threads.
/// @param stretches  number of the piece at each place of a stretch (see EdgeSide); -1: none
/// @param place      index of each piece in the clipped mesh, by the piece's number
void LinkAlongEdges(const MeshEdges& edges, const Array<Index>& stretches,
  const Array<Index>& place, const Job& job, ClippedMesh& clipped);

/// Appends links between pieces that share a point of the mesh, as in LinkStars. The result is the
/// same for any number of threads.
/// @param pointClass  a number for each input point, equal for points that count as one
void LinkAtPoints(const Array<Index>& pointClass, int threads, ClippedMesh& clipped);

} // namespace gridfem

#endif
