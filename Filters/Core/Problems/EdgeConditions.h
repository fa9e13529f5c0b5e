// Conditions on edges, such as the boundary of a surface: values that are held, and flux.
#ifndef GridFEM_EdgeConditions_h
#define GridFEM_EdgeConditions_h

#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

/// What ConstrainedHierarchy and SolveConstrained take.
struct HeldEdges
{
  SparseMatrix rows;
  MultiVector values; // a row for each
};

/// The values at the ends of the edges; and on edges longer than a unit of length in the middle of
/// every stretch as well, linear in between, because functions are not linear there.
/// @param values  rows = points of the mesh
HeldEdges HoldEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

/// ∫ f b_i over edges in world units of length: rows = functions, columns as `values`.
/// @param values  rows = points of the mesh; linear along the edges
MultiVector LoadOnEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values);

} // namespace gridfem

#endif
