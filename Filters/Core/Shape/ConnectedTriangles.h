// Triangles with the neighbors across their edges. Cuts separate neighbors.
#ifndef GridFEM_ConnectedTriangles_h
#define GridFEM_ConnectedTriangles_h

#include "Base/Types.h"

#include <array>
#include <vector>

namespace gridfem
{

/// A half edge is 3 triangle + k. It runs from corner k of the triangle to the next corner.
using HalfEdge = Index;

/// Triangles that face the same way across all edges that connect them. Vertices are what remains
/// of the corners when the triangles are connected across these edges alone. Edges of three and
/// more triangles connect nothing, nor do points where surfaces touch.
struct ConnectedTriangles
{
  std::vector<std::array<Index, 3>> places; // at the corners of each triangle
  std::vector<HalfEdge> twin;               // of each half edge; -1: the surface ends there

  Index Count() const { return static_cast<Index>(places.size()); }
  static HalfEdge Next(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static HalfEdge Previous(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index From(HalfEdge h) const { return places[h / 3][h % 3]; }
  Index To(HalfEdge h) const { return this->From(Next(h)); }

  /// Adds a triangle without neighbors.
  void Add(const std::array<Index, 3>& corners);
  void Connect(HalfEdge a, HalfEdge b);
  /// Cuts the surface along an edge.
  void Cut(HalfEdge h);

  /// The half edge after h on its boundary loop.
  HalfEdge NextOnBoundary(HalfEdge h) const;
};

/// The number of the vertex at each corner, 3 triangle + corner.
struct VertexNumbers
{
  std::vector<Index> ofCorner;
  Index count = 0;
};

VertexNumbers NumberVertices(const ConnectedTriangles& triangles);

/// The loops of the boundary, each as its half edges in order.
std::vector<std::vector<HalfEdge>> BoundaryLoops(const ConnectedTriangles& triangles);

} // namespace gridfem

#endif
