#include "Pipeline/Allocation.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"

#include <cstdlib>
#include <new>

namespace gridfem
{

void RequireRoom(std::size_t bytes)
{
  // Without volatile, compilers leave out memory that is freed at once.
  void* volatile const room = std::malloc(bytes);
  if (!room && bytes > 0)
  {
    throw std::bad_alloc();
  }
  std::free(room);
}

void SetTuples(vtkAbstractArray* array, vtkIdType tuples)
{
  RequireRoom(
    static_cast<std::size_t>(tuples) * array->GetNumberOfComponents() * array->GetDataTypeSize());
  array->SetNumberOfTuples(tuples);
}

void ReserveCells(vtkCellArray* cells, vtkIdType count, vtkIdType corners)
{
  RequireRoom(static_cast<std::size_t>(count + 1 + corners) * sizeof(vtkIdType));
  cells->AllocateExact(count, corners);
}

} // namespace gridfem
