// Clips one triangle by the planes of a grid, axis by axis. Points are named by what makes them (a
// corner; an edge and a plane; two planes), so no search is needed to know equal ones.
#ifndef GridFEM_TriangleClipper_h
#define GridFEM_TriangleClipper_h

#include "Clip.h"
#include "MeshEdges.h"

#include <unordered_map>
#include <vector>

namespace gridfem
{

/// What the triangles fall into that one thread clips, in the order it meets them.
/// Corner ids: input points and cuts of mesh edges have their global id; -1 - k is interior point
/// k.
struct PieceStore
{
  Array<MortonKey> key;
  Array<Index> triangle;
  Array<Index> cornerBegin; // one more than pieces
  Array<Index> corner;
  Array<CutPoint> interior; // points where two planes cut a triangle
  Array<Link> links;        // pieces of one triangle that share an edge
};

/// What the clipper knows of the mesh; all of it outlives the clipper.
struct ClipInput
{
  const std::vector<std::array<Id, 3>>& triangles;
  const Array<Index>& pointClass; // welded id of each point
  const Array<Vec3>& position;    // of the input points, grid units, snapped to the planes
  const MeshEdges& edges;
  int cellsPerSide;
  double tolerance; // of snapping
};

/// Cut points divide an edge of a triangle into stretches. A stretch is numbered by its end nearer
/// to the edge's lower end: 0 for that end itself, 1 + n for cut point n of the edge.
/// The stretches of edge k of a triangle begin at the sum over its edges before.
inline Index StretchesOf(const MeshEdges& edges, Index edge)
{
  return edges.cutBegin[edge + 1] - edges.cutBegin[edge] + 1;
}

class TriangleClipper
{
public:
  /// @param clipped  has room for the cut points of mesh edges; the first triangle at an edge fills
  ///                 those it makes
  TriangleClipper(const ClipInput& input, ClippedMesh& clipped) : input_(input), clipped_(clipped)
  {
  }

  /// Appends the pieces of one triangle.
  /// @param stretchPiece  gets the piece along each stretch of the triangle's three edges; -1 for a
  ///                      stretch without length
  void Clip(Id triangle, PieceStore& store, Index* stretchPiece);

private:
  using Point = std::array<double, 3>;

  /// A point of this triangle.
  struct Vertex
  {
    Point position; // snapped
    Point weight;   // barycentric
    Index id;
  };

  /// A corner of a polygon. The edge from it to the next lies on edge `tag` of the triangle, or,
  /// from PlaneTag on, on a plane across axis tag - PlaneTag.
  static constexpr std::int16_t PlaneTag = 3;
  struct Corner
  {
    std::int32_t vertex;
    std::int16_t tag;
  };

  struct Polygon
  {
    static constexpr int Capacity = 24;
    std::array<Corner, Capacity> corner;
    int size = 0;
    void Push(std::int32_t vertex, int tag);
  };

  /// An edge of the triangle, seen from its lower end.
  struct Edge
  {
    const Vec3* low;
    const Vec3* high;
    int lowCorner; // of the triangle
    int highCorner;
    std::array<PlaneRange, 3> planes;
    std::array<Index, 3> firstCut; // per axis
    Index cutBegin;
    bool isNamedHere;    // this is the first triangle at the edge
    Index* stretchPiece; // null for an edge whose ends are one point
  };

  /// A cell as one number that ascends with (i, j, k): fast to compare, and to step from.
  using CellCode = std::int64_t;
  static constexpr int BitsPerAxis = 20;
  static constexpr int ShiftOf(int axis) { return BitsPerAxis * (2 - axis); }

  struct LocalPiece
  {
    CellCode cell;
    Index piece;
    int firstCorner; // into corners_
    int size;
  };

  /// Interior points by the two planes that make them: entries of earlier triangles are told by
  /// their stamp, so nothing is cleared. Where the table would be large and nearly empty (a needle
  /// across a fine grid) a map takes its place.
  struct Slot
  {
    Id stamp = -1;
    std::int32_t vertex = 0;
  };

  bool IsInOneCell(CellIndex& cell);
  void EmitWhole(const CellIndex& cell, PieceStore& store, Index* stretchPiece) const;
  void Start(Index* stretchPiece);
  void ClipAxis(const Polygon& polygon, int axis, PieceStore& store);
  void Split(
    const Polygon& polygon, int axis, int plane, Polygon& below, Polygon& above, PieceStore& store);
  std::int32_t CutMeshEdge(const Edge& edge, int axis, int plane);
  std::int32_t CutPlaneEdge(
    const Corner& from, const Corner& to, int axis, int plane, PieceStore& store);
  Slot& InteriorSlot(int axisA, int planeA, int axisB, int planeB);
  void Emit(const Polygon& polygon, PieceStore& store);
  void NoteStretches(const Polygon& polygon, Index piece, PieceStore& store);
  void LinkPieces(PieceStore& store) const;
  const LocalPiece* FindPiece(CellCode cell) const;
  static bool HasEdge(const PieceStore& store, const LocalPiece& piece, Index a, Index b);
  void LinkAcross(const LocalPiece& piece, int corner, PieceStore& store) const;

  const ClipInput& input_;
  ClippedMesh& clipped_;
  Id triangle_ = 0;
  std::array<PlaneRange, 3> planes_{};
  std::array<Edge, 3> edge_{};
  Array<Vertex> vertices_;
  Array<LocalPiece> pieces_; // ascending by (i, j, k)
  Array<Corner> corners_;

  static constexpr Id LargestTable = Id{ 1 } << 20;
  std::array<std::vector<Slot>, 3> slots_; // planes xy, xz, yz
  std::array<std::unordered_map<Id, Slot>, 3> sparseSlots_;
};

} // namespace gridfem

#endif
