// Which pieces of a clipped mesh share an edge.
#ifndef GridFEM_PieceAdjacency_h
#define GridFEM_PieceAdjacency_h

#include "Base/Job.h"
#include "Grid/Clip.h"
#include "Grid/MeshEdges.h"

#include <vector>

namespace gridfem
{

/// A piece has an edge; edges are numbered, and equal for all pieces that share them.
struct EdgeUse
{
  Index edge;
  Index piece;
};

/// Links for edges given by their uses: pieces of one cell in a star, the stars of different cells
/// pairwise. Appended edge by edge, the same for any number of threads.
/// @param uses   ascending by piece for each edge; a piece may have one twice
/// @param edges  their number
void LinkStars(const Array<EdgeUse>& uses, Id edges, const Array<Index>& pieceCell, int threads,
  Array<Link>& links);

/// Appends a link for every two pieces on different sides of a mesh edge that share a stretch of
/// it; where more than two do, as LinkStars. The same for any number of threads.
/// @param stretches  number of the piece at every place of a stretch, -1: none (see EdgeSide)
/// @param place      of every piece in the clipped mesh, by its number
void LinkAlongEdges(const MeshEdges& edges, const Array<Index>& stretches,
  const Array<Index>& place, const Job& job, ClippedMesh& clipped);

/// Appends links for pieces that share a point of the mesh, as LinkStars. The same for any number
/// of threads.
/// @param pointClass  per input point: equal for points that count as one
void LinkAtPoints(const Array<Index>& pointClass, int threads, ClippedMesh& clipped);

} // namespace gridfem

#endif
