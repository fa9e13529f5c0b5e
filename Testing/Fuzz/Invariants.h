// What a surface may be told by without another result: the order and the sharing of its points,
// and its place in space.
#ifndef GridFEM_Testing_Invariants_h
#define GridFEM_Testing_Invariants_h

#include "Outcome.h"
#include "RandomSurface.h"

namespace gridfem::testing
{

/// Sizes whose squares are in the range of numbers.
bool HasOrdinarySize(const Grid& grid);

/// What clipping may move a side of a triangle by, in cells: 1e-10, or the rounding of the input,
/// which far away from the origin can be many cells.
double Displacement(const TriangleMesh& mesh, const Grid& grid);

/// Whether it is nearly as narrow along an axis as what clipping moves points by: then rounding
/// decides whether it lies in one layer of cells or in two.
bool IsThin(const TriangleMesh& mesh, const Grid& grid);

///@{ Of a surface that has been built, is no thinner than that, and is of ordinary size.
/// @param allowed  what clipping may change of the area

/// Functions do not depend on the order of what the mesh is made of, nor do their products where
/// they are integrated exactly.
void RequireNoOrder(Choice& choice, const RandomSurface& surface, double allowed, Outcome& outcome);

/// Where coincident points count as one, triangles with points of their own have the same functions
/// and the same solutions.
void RequireNoWelding(
  Choice& choice, const RandomSurface& surface, double allowed, Outcome& outcome);
///@}

/// Hats move with the surface wherever it goes. A grid moves with it where its axes stay axes:
/// shifts, exchanged axes and mirrors. Thin surfaces count as well.
void RequireNoPlace(Choice& choice, const RandomSurface& surface, Outcome& outcome);

} // namespace gridfem::testing

#endif
