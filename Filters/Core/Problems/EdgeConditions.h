// Conditions on edges, such as the boundary of a surface: values that are held, and flux.
#ifndef GridFEM_EdgeConditions_h
#define GridFEM_EdgeConditions_h

#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

/// What ConstrainedHierarchy and SolveConstrained take.
struct HeldValues
{
  SparseMatrix rows;
  MultiVector values; // a row for each
};

/// @param values  a row for each of the points
HeldValues HoldPoints(
  const FiniteElementSpace& space, const std::vector<Id>& points, MultiVector values);

/// Both, those of `first` first.
HeldValues Join(const HeldValues& first, const HeldValues& second);

/// The values at the ends of the edges; and on edges longer than a unit of length in the middle of
/// every stretch as well, linear in between, because functions are not linear there.
/// @param values  rows = points of the mesh; an edge with an unknown value (NaN) is left free
HeldValues HoldEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

/// Of HoldEdges: the edges both of whose ends have a known value, and what is held between the ends
/// of such edges.
std::vector<TriangleEdge> KnownEdges(
  const TriangleMesh& mesh, const std::vector<TriangleEdge>& edges, const MultiVector& values);
HeldValues HoldWithinEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

/// ∫ f b_i over edges in world units of length: rows = functions, columns as `values`.
/// @param values  rows = points of the mesh; linear along the edges
MultiVector LoadOnEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

/// What the boundary of a surface adds to an equation.
struct BoundaryTerms
{
  bool isThere = false; // a boundary; else the rest is empty
  MultiVector load;     // LoadOnEdges of a flux; no rows without one
  HeldValues held;      // HoldEdges of values; no rows without them
};

/// @param flux, values  rows = points of the mesh; null: there are none
BoundaryTerms TermsOnBoundary(const FiniteElementSpace& space, const TriangleMesh& mesh,
  bool weldCoincidentPoints, const MultiVector* flux, const MultiVector* values);

} // namespace gridfem

#endif
