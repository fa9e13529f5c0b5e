// Returns the corners of one cell. Several threads may call it at a time.
#ifndef GridFEM_CellCorners_h
#define GridFEM_CellCorners_h

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkVersionMacros.h"

namespace gridfem
{

/// @param storage  one for each thread; `corners` is valid until its next use
inline void GetCorners(vtkCellArray* cells, vtkIdType cell, vtkIdType& count,
  const vtkIdType*& corners, vtkIdList* storage)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  cells->GetCellAtId(cell, count, corners, storage); // copies only where ids have another size
#else
  cells->GetCellAtId(cell, storage);
  count = storage->GetNumberOfIds();
  corners = storage->GetPointer(0);
#endif
}

} // namespace gridfem

#endif
