// One function space, seen from the mesh before and from the mesh after clipping.
// On the clipped mesh every clipped triangle is its own source and every point an input point; on
// the source mesh pieces refer to the triangles they were cut from. Patches and functions are the
// same.
#ifndef GridFEM_BasisConversion_h
#define GridFEM_BasisConversion_h

#include "InputMesh.h"
#include "Solvers/SurfaceBasis.h"

namespace gridfem
{

/// The same space on its clipped triangles (in the order of the fans of its pieces). Shares the
/// operators.
SurfaceBasis OnClippedMesh(const SurfaceBasis& basis);

/// The same space on the mesh that was clipped.
/// @param basis       on the clipped mesh, whose points may be in any order
/// @param sourceCell  per clipped triangle: the cell of `source` it comes from
/// Throws InvalidInput, saying what does not fit, when the basis was made from another mesh.
SurfaceBasis OnSourceMesh(
  const SurfaceBasis& basis, const std::vector<Id>& sourceCell, const InputMesh& source);

} // namespace gridfem

#endif
