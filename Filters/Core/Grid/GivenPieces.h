// Handles a mesh that was clipped earlier: every triangle is a piece in a known cell.
#ifndef GridFEM_GivenPieces_h
#define GridFEM_GivenPieces_h

#include "Grid/Clip.h"

#include <vector>

namespace gridfem
{

/// The grid cells that contain the triangles of a mesh.
struct GivenCells
{
  Grid grid;
  std::vector<MortonKey> cells;      // the occupied cells, ascending
  std::vector<MortonKey> ofTriangle; // the cell of each triangle
};

/// Returns the clipped mesh whose pieces are the triangles of `mesh`, with links.
/// @param mesh   all its points count as input points
/// @param given  cells of the triangles; a triangle whose cell is missing in `cells` is left out
/// @param weldCoincidentPoints  for the links, coincident points count as one
ClippedMesh ClipOfGivenCells(const TriangleMesh& mesh, const GivenCells& given,
  bool weldCoincidentPoints, const Progress& progress = {});

} // namespace gridfem

#endif
