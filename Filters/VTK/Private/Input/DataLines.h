// Visits the lines of a data set, and passes over its other cells.
#ifndef GridFEM_DataLines_h
#define GridFEM_DataLines_h

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

namespace gridfem
{

/// Calls body with the points of each line, from one end to the other. The list belongs to this
/// function.
template<class Body>
void ForEachLine(vtkDataSet* data, Body&& body)
{
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    const int type = data->GetCellType(cell);
    if (type == VTK_LINE || type == VTK_POLY_LINE)
    {
      data->GetCellPoints(cell, points);
      body(points.GetPointer());
    }
  }
}

} // namespace gridfem

#endif
