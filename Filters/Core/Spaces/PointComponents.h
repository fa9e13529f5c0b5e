// Finds the connected component of the functions at a point.
#ifndef GridFEM_PointComponents_h
#define GridFEM_PointComponents_h

#include "Spaces/SurfaceSpace.h"

namespace gridfem
{

/// Returns, for each row of values at points (RowsAtPoints), the component of its first function;
/// -1 for an empty row.
std::vector<Index> ComponentsOfRows(const SparseMatrix& rows, const Components& components);

/// Returns the component at each point of the mesh; -1 where no function reaches.
std::vector<Index> ComponentsOfPoints(
  const SurfaceSpace& space, const Components& components, const Job& job = {});

/// Subtracts the constant of its component from each row. Rows without a component become 0.
void SubtractConstants(
  const MultiVector& constant, const std::vector<Index>& componentOfRow, MultiVector& values);

} // namespace gridfem

#endif
