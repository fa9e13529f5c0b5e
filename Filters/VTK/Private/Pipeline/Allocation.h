// Allocates memory for VTK's arrays. VTK ends the process if it finds no memory, unless it was
// compiled with NDEBUG, which Debian's is not. These functions therefore try first and throw
// std::bad_alloc.
#ifndef GridFEM_Allocation_h
#define GridFEM_Allocation_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>

class vtkAbstractArray;
class vtkCellArray;

namespace gridfem
{

/// Throws std::bad_alloc if so many contiguous bytes are not available.
void RequireRoom(std::size_t bytes);

/// Reserves so many tuples for an array without values, whose number of components is set.
void SetTuples(vtkAbstractArray* array, vtkIdType tuples);

/// Returns an array with so many tuples, without values.
/// @param name  null: none
template<class Array>
vtkSmartPointer<Array> NewArray(const char* name, vtkIdType tuples, int components = 1)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  SetTuples(array, tuples);
  return array;
}

/// Reserves room for so many cells and for the corners of all of them.
void ReserveCells(vtkCellArray* cells, vtkIdType count, vtkIdType corners);

} // namespace gridfem

#endif
