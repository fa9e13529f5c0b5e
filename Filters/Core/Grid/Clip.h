// Clipping of triangles by the faces of grid cells. [T §4.2, Computing Integrals]
// Every triangle falls into pieces: convex polygons, each inside one cell. Cut points that
// neighbouring triangles share are one point; what lies exactly on a face belongs to one cell.
#ifndef GridFEM_Clip_h
#define GridFEM_Clip_h

#include "Base/Array.h"
#include "Base/Progress.h"
#include "Grid/Grid.h"
#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// A point made by clipping, as a combination of the corners of one source triangle. The weights
/// sum to 1, so that two of them are enough.
class CutPoint
{
public:
  CutPoint() = default; // without a value
  CutPoint(Index source, const std::array<double, 3>& weight)
    : triangle(source), zero_(weight[0] == 0.0   ? 0
                              : weight[1] == 0.0 ? 1
                              : weight[2] == 0.0 ? 2
                                                 : None),
      first_(weight[(zero_ + 1) % 3]), second_(weight[(zero_ + 2) % 3])
  {
  }

  /// On the edge across from corner `opposite`; `first` belongs to the corner after that one.
  CutPoint(Index source, int opposite, double first, double second)
    : triangle(source), zero_(opposite), first_(first), second_(second)
  {
  }

  /// Per corner of the triangle. Points on a mesh edge have zero at the opposite corner.
  std::array<double, 3> Weights() const
  {
    std::array<double, 3> weight;
    weight[(zero_ + 1) % 3] = first_;
    weight[(zero_ + 2) % 3] = second_;
    weight[zero_ % 3] = zero_ == None ? 1.0 - first_ - second_ : 0.0;
    return weight;
  }

  Index triangle;

private:
  static constexpr Index None = 3; // as if it were corner 0
  Index zero_;
  double first_;
  double second_;
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
  bool isWelded = false; // coincident points count as one
  Array<CutPoint> cutPoints;
  Array<Vec3> position; // of all points, grid units

  std::vector<MortonKey> cells; // cells that contain a piece, ascending
  Array<Index> cellBegin;       // pieces of cell c: cellBegin[c] .. cellBegin[c + 1]

  Array<Index> pieceTriangle; // source triangle
  Array<Index> pieceBegin;    // corners of piece p: corners[pieceBegin[p] .. pieceBegin[p + 1])
  Array<Index> corners;       // point ids, oriented as the source triangle

  /// Connects the pieces that share an edge: within a cell at least as a tree, between two cells at
  /// least one pair per shared edge. Fixed order.
  Array<Link> links;

  Id NumberOfPieces() const { return static_cast<Id>(pieceTriangle.size()); }

  /// Index into cells, by bisection; where many are asked for see PieceCells.
  Index CellOf(Id piece) const;

  /// A piece with n corners is the fan of n - 2 triangles around its first corner; the triangles of
  /// all pieces are numbered one piece after the other.
  Id FirstTriangle(Id piece) const { return pieceBegin[piece] - 2 * piece; }
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
  bool joinAtPoints = false;        // pieces that share a point of the mesh are linked, too
};

/// Clips. Areas of the pieces add up to the areas of the triangles to rounding; a coordinate within
/// 1e-10 of a cell (or within the rounding of the input) of a face counts as lying on it.
/// Throws InvalidInput (see Validate; or more than 2^31 - 1 corners) and Aborted. The result is the
/// same for any number of threads.
ClippedMesh Clip(
  const TriangleMesh& mesh, const ClipOptions& options, const Progress& progress = {});

/// Index into cells of every piece.
Array<Index> PieceCells(const ClippedMesh& clipped, int threads = 1);

/// Area of one piece in grid units.
double PieceArea(const ClippedMesh& clipped, Id piece);

} // namespace gridfem

#endif
