// Clips triangles by the faces of grid cells. [T §4.2, Computing Integrals]
// Every triangle is cut into pieces: convex polygons, each inside one cell. A cut point that
// neighboring triangles share is a single point. A part of the surface that lies exactly on a face
// belongs to one cell.
#ifndef GridFEM_Clip_h
#define GridFEM_Clip_h

#include "Base/Array.h"
#include "Base/Progress.h"
#include "Grid/Grid.h"
#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// A point made by clipping, stored as a combination of the corners of one source triangle. The
/// weights sum to 1, so storing two of them is enough.
class CutPoint
{
public:
  CutPoint() = default; // leaves the members uninitialized
  CutPoint(Index source, const std::array<double, 3>& weight)
    : triangle(source), zero_(weight[0] == 0.0   ? 0
                              : weight[1] == 0.0 ? 1
                              : weight[2] == 0.0 ? 2
                                                 : None),
      first_(weight[(zero_ + 1) % 3]), second_(weight[(zero_ + 2) % 3])
  {
  }

  /// A point on the edge opposite to corner `opposite`. `first` is the weight of the next corner,
  /// `second` the weight of the corner after it.
  CutPoint(Index source, int opposite, double first, double second)
    : triangle(source), zero_(opposite), first_(first), second_(second)
  {
  }

  /// One weight per corner of the triangle. Points on a mesh edge have weight 0 at the opposite
  /// corner.
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
  static constexpr Index None = 3; // (None + 1) % 3 is 1, as for corner 0
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
/// Point ids: the input's points come first, then the cut points.
/// Pieces are sorted by the Morton key of their cell, then by source triangle.
/// Ids and offsets have 32 bits, because they fill most of the memory of a run, and half the size
/// takes half the time. Clip refuses meshes that do not fit.
struct ClippedMesh
{
  Grid grid;
  Id numberOfInputPoints = 0;
  bool isWelded = false; // coincident points count as one
  Array<CutPoint> cutPoints;
  Array<Vec3> position; // of all points, in grid units

  std::vector<MortonKey> cells; // cells that contain a piece, ascending
  Array<Index> cellBegin;       // cell c has the pieces cellBegin[c] .. cellBegin[c + 1] - 1

  Array<Index> pieceTriangle; // source triangle
  Array<Index> pieceBegin;    // corners of piece p: corners[pieceBegin[p] .. pieceBegin[p + 1])
  Array<Index> corners;       // point ids, in the orientation of the source triangle

  /// Links between pieces that share an edge. Within a cell, the links contain at least a spanning
  /// tree. Between two cells, there is at least one link per shared edge. The order is fixed.
  Array<Link> links;

  Id NumberOfPieces() const { return static_cast<Id>(pieceTriangle.size()); }

  /// Index of the piece's cell in `cells`, found by bisection. PieceCells is faster for many
  /// pieces.
  Index CellOf(Id piece) const;

  /// A piece with n corners is the fan of n - 2 triangles around its first corner. The triangles of
  /// all pieces are numbered piece after piece.
  Id FirstTriangle(Id piece) const { return pieceBegin[piece] - 2 * piece; }
  Id NumberOfTriangles() const
  {
    return static_cast<Id>(corners.size()) - 2 * this->NumberOfPieces();
  }
};

struct ClipOptions
{
  int depth = 7;                    // 2^depth cells along the longest side, 2..14
  bool weldCoincidentPoints = true; // for links and cut points, coincident points count as one
  int threads = 0;                  // 0: all processors
  bool joinAtPoints = false;        // also link pieces that share a point of the mesh
};

/// Clips a mesh by the cells of a grid. The areas of the pieces add up to the areas of the
/// triangles, up to rounding. A coordinate counts as lying on a face if their distance is at most
/// 1e-10 cells, or at most the rounding of the input.
/// Throws InvalidInput (see Validate; also for more than 2^31 - 1 corners) and Aborted. The result
/// is the same for any number of threads.
ClippedMesh Clip(
  const TriangleMesh& mesh, const ClipOptions& options, const Progress& progress = {});

/// Returns the index in `cells` of the cell of every piece.
Array<Index> PieceCells(const ClippedMesh& clipped, int threads = 1);

/// Returns the area of one piece in grid units.
double PieceArea(const ClippedMesh& clipped, Id piece);

} // namespace gridfem

#endif
