// Conditions on edges, such as the boundary of a surface: held values and flux.
#ifndef GridFEM_EdgeConditions_h
#define GridFEM_EdgeConditions_h

#include "Equations/RowPenalty.h"
#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

/// Held values, the input of ConstrainedHierarchy and SolveConstrained.
struct HeldValues
{
  HeldRows rows;
  MultiVector values; // one row for each row of `rows`
};

/// Holds the values of points.
/// @param values  a row for each of the points
HeldValues HoldPoints(
  const FiniteElementSpace& space, const std::vector<Id>& points, MultiVector values);

/// Holds the values of points, and along every edge between two of them. Without the edges, a
/// function peaks at each point as soon as its cells are smaller than the edges.
/// @param points  a point may be listed several times
HeldValues HoldPointsAndEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  bool weldCoincidentPoints, const std::vector<Id>& points, const MultiVector& values);

/// Both sets of held values, beginning with `first`.
HeldValues Join(const HeldValues& first, const HeldValues& second);

/// Returns each edge between two marked points once, ascending. If triangles share an edge, the
/// triangle with the least coordinates opposite to the edge counts, so that all processes choose
/// the same triangle. Triangles without area have no edges.
std::vector<TriangleEdge> EdgesBetween(
  const TriangleMesh& mesh, const std::vector<char>& isMarked, bool weldCoincidentPoints);

/// Holds the values at the ends of the edges. Between the ends of edges longer than a quarter of a
/// unit of length it pulls the functions towards the linearly interpolated values, because
/// functions are not linear there. The pull is an integral along the edge. It leaves the functions
/// free to follow the slope of the solution across the edge, unlike more held places.
/// @param values  rows = points of the mesh; an edge with an unknown value (NaN) is left free
HeldValues HoldEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

/// The two parts of HoldEdges: the edges with known values at both ends, and the pulled values
/// between the ends of such edges.
std::vector<TriangleEdge> KnownEdges(
  const TriangleMesh& mesh, const std::vector<TriangleEdge>& edges, const MultiVector& values);
HeldValues HoldWithinEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

/// ∫ f b_i over edges, in world units of length: rows = functions, columns as in `values`.
/// @param values  rows = points of the mesh; linear along the edges
MultiVector LoadOnEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

/// Terms that the boundary of a surface adds to an equation.
struct BoundaryTerms
{
  bool isThere = false; // whether there is a boundary; if not, the rest is empty
  MultiVector load;     // LoadOnEdges of a flux; no rows without a flux
  HeldValues held;      // HoldEdges of values; no rows without values
};

/// @param flux, values  rows = points of the mesh; may be null
BoundaryTerms TermsOnBoundary(const FiniteElementSpace& space, const TriangleMesh& mesh,
  bool weldCoincidentPoints, const MultiVector* flux, const MultiVector* values);

/// Samples along the boundary of a surface. No rows without a boundary.
EdgeSamples SampleBoundary(
  const FiniteElementSpace& space, const TriangleMesh& mesh, bool weldCoincidentPoints);

} // namespace gridfem

#endif
