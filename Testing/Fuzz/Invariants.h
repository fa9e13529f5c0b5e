// Checks of invariance: results do not depend on the order and the sharing of a surface's points,
// nor on its place in space.
#ifndef GridFEM_Testing_Invariants_h
#define GridFEM_Testing_Invariants_h

#include "Outcome.h"
#include "RandomSurface.h"

namespace gridfem::testing
{

/// Whether squares of the grid's lengths are in the range of doubles.
bool HasOrdinarySize(const Grid& grid);

/// Returns how far clipping may move a side of a triangle, in cells: 1e-10, or the rounding of the
/// input. Far from the origin, this rounding can be many cells.
double Displacement(const TriangleMesh& mesh, const Grid& grid);

/// Whether the surface is, along an axis, nearly as narrow as the distance by which clipping moves
/// points. Rounding then decides whether it lies in one layer of cells or in two.
bool IsThin(const TriangleMesh& mesh, const Grid& grid);

///@{ For a built surface of ordinary size that is not thin.
/// @param allowed  change of the area that clipping may cause

/// Requires that functions do not depend on the order of points, triangles and corners. Their
/// products must not depend on it either if they are integrated exactly.
void RequireNoOrder(Choice& choice, const RandomSurface& surface, double allowed, Outcome& outcome);

/// Requires that the functions and solutions do not change if every triangle has its own points,
/// and coincident points count as one.
void RequireNoWelding(
  Choice& choice, const RandomSurface& surface, double allowed, Outcome& outcome);
///@}

/// Requires that results do not depend on the place of the surface. Hats move with any surface. A
/// grid moves with it if axes remain axes: under shifts, exchanges of axes and mirrors. Thin
/// surfaces count as well.
void RequireNoPlace(Choice& choice, const RandomSurface& surface, Outcome& outcome);

} // namespace gridfem::testing

#endif
