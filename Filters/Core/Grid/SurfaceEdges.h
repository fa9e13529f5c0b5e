// How the triangles of a mesh meet at their edges: where the surface ends, and which way it faces.
#ifndef GridFEM_SurfaceEdges_h
#define GridFEM_SurfaceEdges_h

#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// The edge of a triangle from one of its corners to the next.
struct TriangleEdge
{
  Id triangle;
  int corner; // 0 .. 2

  std::array<Id, 2> Ends(const TriangleMesh& mesh) const
  {
    return { mesh.triangles[triangle][corner], mesh.triangles[triangle][(corner + 1) % 3] };
  }
};

/// A straight piece of a curve within a triangle. Its ends are weights of the three corners, at
/// least 0 and with the sum 1.
struct TriangleSegment
{
  Id triangle;
  Vec3 from;
  Vec3 to;
};

/// Triangles two of whose corners are one point count as none.
struct SurfaceEdges
{
  std::vector<TriangleEdge> boundary; // edges of one triangle, ascending
  /// Edges of more than two triangles, each from one of them, ascending.
  std::vector<TriangleEdge> branching;
  /// Per triangle: 1, -1 where it faces the other way than most of the area of its component does,
  /// or 0 on components without two sides, as a Möbius strip. Components end at branching edges.
  std::vector<signed char> side;
  Index numberOfComponents = 0;
  Index numberOfOneSided = 0; // components

  bool IsOriented() const; // all sides are 1
};

/// @param weldCoincidentPoints  coincident points count as one
/// Cost O(n log n).
SurfaceEdges FindSurfaceEdges(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads = 0);

/// Edges as segments. Throws InvalidInput for a triangle that the mesh does not have.
std::vector<TriangleSegment> SegmentsOf(
  const std::vector<TriangleEdge>& edges, const TriangleMesh& mesh);

/// The ends of edges: points of the mesh, ascending, each once.
std::vector<Id> EndsOf(const std::vector<TriangleEdge>& edges, const TriangleMesh& mesh);

} // namespace gridfem

#endif
