// A mesh that was clipped before: every triangle is a piece, in a cell that is known.
#ifndef GridFEM_GivenPieces_h
#define GridFEM_GivenPieces_h

#include "Grid/Clip.h"

#include <vector>

namespace gridfem
{

/// Which cells of a grid the triangles of a mesh lie in.
struct GivenCells
{
  Grid grid;
  std::vector<MortonKey> cells;      // those that there are, ascending
  std::vector<MortonKey> ofTriangle; // each among them
};

/// The clipped mesh whose pieces are the triangles, with links.
/// @param mesh   all of whose points count as input
/// @param given  of its triangles; a triangle in a cell that `cells` lacks is left out
/// @param weldCoincidentPoints  coincident points count as one for the links
ClippedMesh ClipOfGivenCells(const TriangleMesh& mesh, const GivenCells& given,
  bool weldCoincidentPoints, const Progress& progress = {});

} // namespace gridfem

#endif
