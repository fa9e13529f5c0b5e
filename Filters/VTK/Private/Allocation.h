// Memory for VTK's arrays. Where VTK finds none it ends the process, unless it was compiled with
// NDEBUG, which Debian's is not; so it is tried before, and what is missing is std::bad_alloc as
// elsewhere.
#ifndef GridFEM_Allocation_h
#define GridFEM_Allocation_h

#include "vtkType.h"

#include <cstddef>

class vtkAbstractArray;
class vtkCellArray;

namespace gridfem
{

/// Throws std::bad_alloc where so many bytes cannot be had at a stretch.
void RequireRoom(std::size_t bytes);

/// Gives an array without values, whose components are set, room for so many tuples.
void SetTuples(vtkAbstractArray* array, vtkIdType tuples);

/// Gives room for so many cells and for the corners of all of them.
void ReserveCells(vtkCellArray* cells, vtkIdType count, vtkIdType corners);

} // namespace gridfem

#endif
