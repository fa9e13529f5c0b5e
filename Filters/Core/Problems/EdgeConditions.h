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

/// ∫ f b_i over edges in world units of length: rows = functions, columns as `values`.
/// @param values  rows = points of the mesh; linear along the edges
MultiVector LoadOnEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

} // namespace gridfem

#endif
