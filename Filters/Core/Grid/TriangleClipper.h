// Clips one triangle by the planes of a grid, axis by axis. A point is identified by its origin: a
// corner, an edge and a plane, or two planes. Equal points are therefore known without a search.
#ifndef GridFEM_TriangleClipper_h
#define GridFEM_TriangleClipper_h

#include "Grid/ClipBuffer.h"
#include "Grid/ClipPart.h"
#include "Grid/MeshEdges.h"

#include <unordered_map>
#include <vector>

namespace gridfem
{

/// The clipper's view of the mesh. Everything here must outlive the clipper.
struct ClipInput
{
  const std::vector<std::array<Id, 3>>& triangles;
  const Array<Index>& pointClass; // welded id of each point
  const Array<Vec3>& position;    // of the input points, grid units, snapped to the planes
  const MeshEdges& edges;
  int cellsPerSide;
  double tolerance;         // of snapping, in cells
  const CellRegion* region; // makes pieces only here; null: everywhere
};

/// Clips triangles on one thread. The alignment gives every clipper its own cache lines, because
/// threads write to their clippers all the time.
class alignas(CacheLine) TriangleClipper
{
public:
  /// @param clipped    has room for the cut points of mesh edges; the first triangle at an edge
  ///   fills in the points that it makes
  /// @param stretches  all -1 at first; receives the numbers of the pieces along the triangles'
  ///   sides
  /// @param nextChunk  the next free chunk of piece numbers
  TriangleClipper(const ClipInput& input, ClippedMesh& clipped, Array<Index>& stretches,
    std::atomic<Index>& nextChunk)
    : input_(input), clipped_(clipped), stretches_(stretches), nextChunk_(nextChunk)
  {
  }

  /// Appends the pieces of one triangle. Several clippers may clip different triangles of one mesh
  /// at the same time.
  void Clip(Id triangle, ClipBuffer& store);

private:
  using Point = std::array<double, 3>;

  /// A corner of the triangle or a point made by clipping it.
  struct Vertex
  {
    Point position; // snapped
    Point weight;   // barycentric
    Index id;
  };

  /// A corner of a polygon. The polygon's edge from this corner to the next lies on edge `tag` of
  /// the triangle if tag < PlaneTag. Otherwise it lies on a plane across axis tag - PlaneTag.
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
    int lowCorner; // corner of the triangle at the low end
    int highCorner;
    std::array<PlaneRange, 3> planes;
    std::array<Index, 4> firstCut; // point id of the first cut per axis, then the end of the ids
    bool isNamedHere;              // this is the first triangle at the edge
    Index* stretch;                // piece along stretch 0; null for an edge without length
    Index stride;                  // distance between the places of two stretches
  };

  /// A cell as one number, ascending with (i, j, k). It is fast to compare and to step from.
  using CellCode = std::int64_t;
  static constexpr int BitsPerAxis = 20;
  static constexpr int ShiftOf(int axis) { return BitsPerAxis * (2 - axis); }

  struct LocalPiece
  {
    CellCode cell;
    Index piece;     // index in the store
    int firstCorner; // index into corners_
    int size;
  };

  /// A table entry for the interior point made by two planes. A stamp tells entries of earlier
  /// triangles apart, so nothing needs to be cleared. If the table would be large and nearly empty
  /// (a needle across a fine grid), a map replaces it.
  struct Slot
  {
    Id stamp = -1;
    std::int32_t vertex = 0;
  };

  bool IsInOneCell(CellIndex& cell);
  bool IsNearRegion(int axis, int index) const
  {
    return !input_.region || input_.region->IsNear(axis, index);
  }
  void EmitWhole(const CellIndex& cell, ClipBuffer& store);
  void Start();
  void ClipAxis(const Polygon& polygon, int axis, ClipBuffer& store);
  int SideOf(const Corner& corner, int axis, int plane) const; // -1: below the plane, 0: on it, 1:
                                                               // above
  int SideAfter(const Polygon& polygon, int corner, int step, int axis, int plane) const;
  void ShareCorner(
    const Polygon& polygon, int i, int axis, int plane, Polygon& below, Polygon& above) const;
  void Split(
    const Polygon& polygon, int axis, int plane, Polygon& below, Polygon& above, ClipBuffer& store);
  std::int32_t CutMeshEdge(const Edge& edge, int axis, int plane);
  std::int32_t CutPlaneEdge(
    const Corner& from, const Corner& to, int axis, int plane, ClipBuffer& store);
  Slot& InteriorSlot(int axisA, int planeA, int axisB, int planeB);
  void Emit(const Polygon& polygon, ClipBuffer& store);
  void NoteStretches(const Polygon& polygon, Index piece, ClipBuffer& store);
  void LinkPieces(ClipBuffer& store) const;
  void LinkByEdges(ClipBuffer& store);
  const LocalPiece* FindPiece(CellCode cell) const;
  static bool HasEdge(const ClipBuffer& store, const LocalPiece& piece, Index a, Index b);
  void LinkAcross(const LocalPiece& piece, int corner, ClipBuffer& store) const;

  const ClipInput& input_;
  ClippedMesh& clipped_;
  Array<Index>& stretches_;
  std::atomic<Index>& nextChunk_;
  Id triangle_ = 0;
  std::array<PlaneRange, 3> planes_{};
  std::array<Edge, 3> edge_{};
  Array<Vertex> vertices_;
  Array<LocalPiece> pieces_; // ascending by (i, j, k), unless one has moved
  Array<Corner> corners_;
  CellIndex slab_{}; // the cell that polygons are being cut to
  /// A line of the clip was moved onto a plane, so that a piece belongs to the cell above its slab.
  bool hasMovedPiece_ = false;
  Array<std::array<Index, 3>> sides_; // of the pieces: two points, the piece

  static constexpr Id LargestTable = Id{ 1 } << 20;
  std::array<std::vector<Slot>, 3> slots_; // planes xy, xz, yz
  std::array<std::unordered_map<Id, Slot>, 3> sparseSlots_;
};

} // namespace gridfem

#endif
