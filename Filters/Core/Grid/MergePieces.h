// The pieces that several threads made, joined into one clipped mesh in the order of their cells.
#ifndef GridFEM_MergePieces_h
#define GridFEM_MergePieces_h

#include "Base/Job.h"
#include "Grid/TriangleClipper.h"

#include <vector>

namespace gridfem
{

/// One range of triangles: its part of the store of the thread that clipped it.
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
  std::vector<ClipBuffer> stores; // per thread
  std::vector<ClipBlock> blocks;  // per range of triangles, in their order
};

/// Gives the clipped mesh its cells, pieces, interior points (after the points it has), and the
/// links inside triangles. The same for any number of threads.
/// Throws InvalidInput when there are too many.
/// @return the place of each piece in the clipped mesh, by its number
Array<Index> JoinPieces(
  ClippedTriangles parts, const ClipInput& input, const Job& job, ClippedMesh& clipped);

} // namespace gridfem

#endif
