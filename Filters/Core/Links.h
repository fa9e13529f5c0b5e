// Which pieces of a clipped mesh share an edge.
#ifndef GridFEM_Links_h
#define GridFEM_Links_h

#include "Clip.h"
#include "MeshEdges.h"

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
/// pairwise. Sorts `uses`.
void LinkStars(std::vector<EdgeUse>& uses, const Array<Index>& pieceCell, Array<Link>& links);

/// The pieces along the mesh edges of every triangle (see TriangleClipper): those of triangle t are
/// piece[begin[t] .. begin[t + 1]).
struct Stretches
{
  Array<Index> begin;
  Array<Index> piece; // -1: none
};

/// Makes room for the stretches of all triangles. Throws InvalidInput when there are too many.
Stretches AllocateStretches(const MeshEdges& edges, int threads);

/// Appends a link for every two pieces on different sides of a mesh edge that share a stretch of
/// it; where more than two do, as LinkStars. The same for any number of threads.
void LinkAlongEdges(const MeshEdges& edges, const Stretches& stretches, int threads,
  const Progress& progress, ClippedMesh& clipped);

} // namespace gridfem

#endif
