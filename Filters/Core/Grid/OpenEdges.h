// Finds the edges where a surface ends. A closed surface has none, and costs one pass over its
// triangles.
#ifndef GridFEM_OpenEdges_h
#define GridFEM_OpenEdges_h

#include "Grid/PlaceNumbers.h"
#include "Grid/TriangleMesh.h"

namespace gridfem
{

/// The ends of an edge, ascending.
using OpenEdge = std::array<Place, 2>;

/// Returns the edges that an odd number of triangles share, ascending. Coincident points count as
/// one. Throws InvalidInput (see Validate).
///
/// An even number of equal terms cancels in an exclusive or. Edges therefore need no search, and
/// two different edges are mistaken for one with a probability of about 1e-19.
std::vector<OpenEdge> FindOpenEdges(const TriangleMesh& mesh, int threads = 0);

/// Numbers the ends of edges.
PlaceNumbers NumberEnds(const std::vector<OpenEdge>& edges);

/// Returns, for each place, the length of the shortest side of a triangle that ends there; infinite
/// if there is none. Sides that are as short as the rounding of their ends do not count.
std::vector<double> ShortestSides(
  const TriangleMesh& mesh, const PlaceNumbers& places, int threads = 0);

} // namespace gridfem

#endif
