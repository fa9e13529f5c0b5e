#include "Input/InputValidation.h"

#include "Base/Errors.h"

#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

namespace gridfem
{

bool IsEmpty(vtkDataSet* input)
{
  return !input || input->GetNumberOfPoints() == 0;
}

void RequireNoVolume(vtkDataSet* piece)
{
  if (!piece || vtkPolyData::SafeDownCast(piece) || piece->GetNumberOfCells() == 0)
  {
    return;
  }
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType k = 0; k < piece->GetNumberOfCells(); ++k)
  {
    if (piece->GetCellType(k) == cell->GetCellType())
    {
      continue; // same type as the last cell, which is no volume
    }
    cell->SetCellType(piece->GetCellType(k));
    if (cell->GetCellDimension() == 3)
    {
      throw InvalidInput(
        "The input is a volume mesh in pieces, on several ranks or in blocks taken as one. The "
        "faces between pieces would count as surface. Apply Ghost Cells (Merge Blocks) and "
        "Extract Surface first.");
    }
  }
}

} // namespace gridfem
