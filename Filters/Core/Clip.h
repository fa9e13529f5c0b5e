// Clipping of triangles by the faces of grid cells. [T §4.2, Computing Integrals]
// Every triangle falls into pieces: convex polygons, each inside one cell. Cut points that
// neighbouring triangles share are one point; what lies exactly on a face belongs to one cell.
#ifndef GridFEM_Clip_h
#define GridFEM_Clip_h

#include "Array.h"
#include "Grid.h"
#include "Progress.h"
#include "TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// A point made by clipping, as a combination of the corners of one source triangle. Points on a
/// mesh edge have a zero weight at the opposite corner.
struct CutPoint
{
  Index triangle;
  std::array<double, 3> weight; // sums to 1
};

/// Two pieces, or two patches, that share an edge of the clipped mesh; first < second.
struct Link
{
  Index first;
  Index second;
  bool operator==(const Link& other) const
  {
    return first == other.first && second == other.second;
  }
};

/// A mesh clipped by the cells of a grid.
/// Point ids: the input's points first, then the cut points.
/// Pieces are sorted by the Morton key of their cell, then by source triangle.
/// What is numbered here has 32 bits: it fills most of the memory of a run, and half the size is
/// half the time. Clip refuses what does not fit.
struct ClippedMesh
{
  Grid grid;
  Id numberOfInputPoints = 0;
  Array<CutPoint> cutPoints;
  Array<Vec3> position; // of all points, grid units

  std::vector<MortonKey> cells; // cells that contain a piece, ascending

  Array<Index> pieceCell;     // index into cells
  Array<Index> pieceTriangle; // source triangle
  Array<Index> pieceBegin;    // corners of piece p: corners[pieceBegin[p] .. pieceBegin[p + 1])
  Array<Index> corners;       // point ids, oriented as the source triangle

  /// Connects the pieces that share an edge: within a cell at least as a tree, between two cells at
  /// least one pair per shared edge. Fixed order.
  Array<Link> links;

  Id NumberOfPieces() const { return static_cast<Id>(pieceCell.size()); }

  /// A piece with n corners is the fan of n - 2 triangles around its first corner.
  Id NumberOfTriangles() const
  {
    return static_cast<Id>(corners.size()) - 2 * this->NumberOfPieces();
  }
};

struct ClipOptions
{
  int depth = 7;                    // 2^depth cells along the longest side, 2..14
  bool weldCoincidentPoints = true; // coincident points count as one for links and cut points
  int threads = 0;                  // 0: all
};

/// Clips. Areas of the pieces add up to the areas of the triangles to rounding; a coordinate within
/// 1e-10 of a cell (or within the rounding of the input) of a face counts as lying on it.
/// Throws InvalidInput (see Validate; or more than 2^31 - 1 corners) and Aborted. The result is the
/// same for any number of threads.
ClippedMesh Clip(
  const TriangleMesh& mesh, const ClipOptions& options, const Progress& progress = {});

/// Area of one piece in grid units.
double PieceArea(const ClippedMesh& clipped, Id piece);

} // namespace gridfem

#endif
