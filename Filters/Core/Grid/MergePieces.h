// Joins the pieces made by several threads into one clipped mesh, in the order of their cells.
#ifndef GridFEM_MergePieces_h
#define GridFEM_MergePieces_h

#include "Base/Job.h"
#include "Grid/TriangleClipper.h"

#include <vector>

namespace gridfem
{

/// The pieces of one range of triangles, inside the store of the thread that clipped it.
struct ClipBlock
{
  ClipBuffer* store;
  Index firstPiece;
  Index firstCorner;
  Index firstInterior;
  Index firstLink;
  Index pieces;
  Index corners;
  Index interiors;
  Index links;
};

struct ClippedTriangles
{
  std::vector<ClipBuffer> stores; // one per thread
  std::vector<ClipBlock> blocks;  // one per range of triangles, in their order
};

/// Fills the cells, pieces, interior points and the links inside triangles of the clipped mesh.
/// Interior points follow the existing points. The result is the same for any number of threads.
/// Throws InvalidInput when there are too many items of a kind.
/// @return the index in the clipped mesh of each piece, by the piece's number
Array<Index> JoinPieces(
  ClippedTriangles parts, const ClipInput& input, const Job& job, ClippedMesh& clipped);

} // namespace gridfem

#endif
