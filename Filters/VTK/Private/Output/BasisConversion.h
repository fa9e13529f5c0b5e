// Shows one function space on the mesh before and on the mesh after clipping.
// On the clipped mesh, every clipped triangle is its own source and every point is an input point.
// On the source mesh, pieces refer to the triangles they were cut from. Patches and functions are
// the same.
#ifndef GridFEM_BasisConversion_h
#define GridFEM_BasisConversion_h

#include "Input/InputMesh.h"
#include "Solvers/SurfaceBasis.h"

namespace gridfem
{

/// Returns the same space on its clipped triangles, in the order of the fans of its pieces. Shares
/// the operators.
SurfaceBasis OnClippedMesh(const SurfaceBasis& basis);

/// Returns the same space on the mesh that was clipped.
/// @param basis       lies on the clipped mesh, whose points may be in any order
/// @param sourceCell  names, for each clipped triangle, the cell of `source` it comes from
/// Throws InvalidInput if the basis was made from another mesh. The message names the misfit.
SurfaceBasis OnSourceMesh(
  const SurfaceBasis& basis, const std::vector<Id>& sourceCell, const InputMesh& source);

} // namespace gridfem

#endif
