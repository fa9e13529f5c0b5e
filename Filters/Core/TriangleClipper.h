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

/// What a number of consecutive triangles fall into. Pieces are numbered from 0 in each block.
/// Corner ids: input points and cuts of mesh edges have their global id; -1 - k is interior point
/// k.
struct ClipBlock
{
  std::vector<MortonKey> key;
  std::vector<Id> triangle;
  std::vector<int> size; // corners per piece
  std::vector<Id> corner;
  std::vector<std::uint8_t> tag;  // of the edge from each corner to the next, see PlaneTag
  std::vector<CutPoint> interior; // points where two planes cut a triangle
  std::vector<PieceLink> links;   // pieces of one triangle in neighbouring cells
};

/// What an edge of a piece lies on: 0, 1, 2 a mesh edge of its triangle, PlaneTag + axis a cut.
constexpr int PlaneTag = 3;

class TriangleClipper
{
public:
  /// @param position  of the input points, grid units, snapped to the planes
  TriangleClipper(const std::vector<std::array<Id, 3>>& triangles,
    const std::vector<Id>& pointClass, const std::vector<Vec3>& position, const MeshEdges& edges,
    int cellsPerSide, double tolerance);

  /// Appends the pieces of one triangle.
  void Clip(Id triangle, ClipBlock& block);

private:
  struct Vertex
  {
    std::array<double, 3> position; // snapped
    std::array<double, 3> weight;   // barycentric
    Id id;
    int tag; // of the edge to the next vertex
  };

  struct Polygon
  {
    static constexpr int Capacity = 24;
    std::array<Vertex, Capacity> vertex;
    int size = 0;
    void Push(const Vertex& v, int tag);
  };

  struct LocalPiece
  {
    CellIndex cell;
    Id piece;
    int firstCorner; // into corners_
    int size;
  };

  struct LocalCorner
  {
    Id id;
    int tag;
    std::array<double, 3> position;
  };

  /// Interior points by the two planes that make them: entries of earlier triangles are told by
  /// their stamp, so nothing is cleared. Where the table would be large and nearly empty (a needle
  /// across a fine grid) a map takes its place.
  struct Slot
  {
    Id stamp = -1;
    Id id = 0;
  };

  void Start(Id triangle);
  void ClipAxis(const Polygon& polygon, int axis, ClipBlock& block);
  void Split(
    const Polygon& polygon, int axis, int plane, Polygon& below, Polygon& above, ClipBlock& block);
  Vertex Cut(const Vertex& from, const Vertex& to, int axis, int plane, ClipBlock& block);
  Vertex CutMeshEdge(int edge, int axis, int plane) const;
  Vertex CutPlaneEdge(const Vertex& from, const Vertex& to, int axis, int plane, ClipBlock& block);
  Slot& InteriorSlot(int axisA, int planeA, int axisB, int planeB);
  double Snap(double value) const;
  CellIndex CellOf(const Polygon& polygon) const;
  void Emit(const Polygon& polygon, ClipBlock& block);
  void LinkPieces(ClipBlock& block) const;
  const LocalPiece* FindPiece(const CellIndex& cell) const;
  bool HasEdge(const LocalPiece& piece, Id a, Id b) const;
  void LinkAcross(const LocalPiece& piece, int corner, ClipBlock& block) const;

  const std::vector<std::array<Id, 3>>& triangles_;
  const std::vector<Id>& pointClass_;
  const std::vector<Vec3>& position_;
  const MeshEdges& edges_;
  int cellsPerSide_;
  double tolerance_;

  Id triangle_ = 0;
  Polygon start_;
  std::array<PlaneRange, 3> planes_{};
  std::vector<LocalPiece> pieces_; // ascending by (i, j, k)
  std::vector<LocalCorner> corners_;
  std::vector<std::array<double, 3>> interiorPosition_;
  Id interiorBegin_ = 0;

  static constexpr Id LargestTable = Id{ 1 } << 20;
  std::array<std::vector<Slot>, 3> slots_; // planes xy, xz, yz
  std::array<std::unordered_map<Id, Slot>, 3> sparseSlots_;
};

} // namespace gridfem

#endif
