// Finds how the triangles of a mesh meet at their edges: where the surface ends, and which way it
// faces.
#ifndef GridFEM_SurfaceEdges_h
#define GridFEM_SurfaceEdges_h

#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// The edge of a triangle from one corner to the next.
struct TriangleEdge
{
  Id triangle;
  int corner; // 0 .. 2

  std::array<Id, 2> Ends(const TriangleMesh& mesh) const
  {
    return { mesh.triangles[triangle][corner], mesh.triangles[triangle][(corner + 1) % 3] };
  }
};

/// A straight piece of a curve within a triangle. Each end is given by the weights of the three
/// corners, which are at least 0 and sum to 1.
struct TriangleSegment
{
  Id triangle;
  Vec3 from;
  Vec3 to;
};

/// The edges and orientation of a surface. Triangles with two equal corners do not count.
struct SurfaceEdges
{
  std::vector<TriangleEdge> boundary; // edges of one triangle, ascending
  /// Edges of more than two triangles, each listed with one of them, ascending.
  std::vector<TriangleEdge> branching;
  /// One number per triangle: -1 if it faces against its component, otherwise 1. A component faces
  /// as most of its area does. A closed component whose triangles face different ways faces
  /// outward. The number is 0 on one-sided components such as a Möbius strip. Components end at
  /// branching edges.
  std::vector<signed char> side;
  Index numberOfComponents = 0;
  Index numberOfOneSided = 0; // number of one-sided components

  bool IsOriented() const; // all sides are 1
};

/// Finds the edges and orientation of a surface. Cost O(n log n).
/// @param weldCoincidentPoints  coincident points count as one
SurfaceEdges FindSurfaceEdges(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads = 0);

/// Converts edges to segments. Throws InvalidInput for a triangle that the mesh does not have.
std::vector<TriangleSegment> SegmentsOf(
  const std::vector<TriangleEdge>& edges, const TriangleMesh& mesh);

/// Returns the end points of edges: ids of points of the mesh, ascending, each once.
std::vector<Id> EndsOf(const std::vector<TriangleEdge>& edges, const TriangleMesh& mesh);

} // namespace gridfem

#endif
