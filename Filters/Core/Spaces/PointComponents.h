// Which connected component of the functions a point lies on.
#ifndef GridFEM_PointComponents_h
#define GridFEM_PointComponents_h

#include "Spaces/SurfaceSpace.h"

namespace gridfem
{

/// Per row of values at points (RowsAtPoints) the component of its first function; -1 without one.
std::vector<Index> ComponentsOfRows(const SparseMatrix& rows, const Components& components);

/// Per point of the mesh; -1 where no function reaches.
std::vector<Index> ComponentsOfPoints(
  const SurfaceSpace& space, const Components& components, const Job& job = {});

/// values -= the constant of each row's component; rows of nothing become 0.
void SubtractConstants(
  const MultiVector& constant, const std::vector<Index>& componentOfRow, MultiVector& values);

} // namespace gridfem

#endif
