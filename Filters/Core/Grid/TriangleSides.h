// The sides of triangles, sorted so that the sides of an edge are consecutive.
#ifndef GridFEM_TriangleSides_h
#define GridFEM_TriangleSides_h

#include "Grid/SurfaceEdges.h"

namespace gridfem
{

/// A triangle's side of an edge. The edge is identified by its two ends.
struct TriangleSide
{
  Index low;
  Index high;
  TriangleEdge edge;
  bool isUpwards; // whether the triangle runs from the low to the high end

  bool IsOfSameEdge(const TriangleSide& other) const
  {
    return low == other.low && high == other.high;
  }
};

/// Both throw InvalidInput if an edge or a segment refers to a triangle that the mesh does not
/// have.
void RequireEdges(const std::vector<TriangleEdge>& edges, const TriangleMesh& mesh);
void RequireSegments(const std::vector<TriangleSegment>& segments, const TriangleMesh& mesh);

/// Returns the sides of all triangles with three different points, sorted by edge.
/// @param pointClass  welded id of each point; empty: every point is its own class
std::vector<TriangleSide> SortedSides(const TriangleMesh& mesh, const Array<Index>& pointClass);

/// Calls body(first side, number of sides) for each edge.
template<class Body>
void ForEachEdge(const std::vector<TriangleSide>& sortedSides, Body&& body)
{
  for (std::size_t first = 0, next = 0; first < sortedSides.size(); first = next)
  {
    for (next = first + 1;
         next < sortedSides.size() && sortedSides[next].IsOfSameEdge(sortedSides[first]); ++next)
    {
    }
    body(&sortedSides[first], static_cast<Id>(next - first));
  }
}

} // namespace gridfem

#endif
