#include "Input/InputValidation.h"

#include "Base/Errors.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <string>

namespace gridfem
{
namespace
{

void RequireSound(vtkCellArray* cells, const char* kind)
{
  if (cells && !cells->IsValid())
  {
    throw InvalidInput(std::string("The ") + kind +
                       " of the input are damaged: their offsets must begin at 0, never "
                       "decrease, and end at the number of corners.");
  }
}

void RequireExistingPoints(vtkCellArray* cells, vtkIdType points)
{
  if (!cells || cells->GetNumberOfConnectivityIds() == 0)
  {
    return;
  }
  vtkDataArray* const corners = cells->GetConnectivityArray();
  double range[2];
  corners->GetRange(range, 0);
  if (!(range[0] >= 0.0 && range[1] < static_cast<double>(points)))
  {
    throw InvalidInput("A cell of the input uses point " +
                       std::to_string(static_cast<Id>(range[0] < 0.0 ? range[0] : range[1])) +
                       ", but the input has " + std::to_string(points) +
                       " points. Clean the mesh first.");
  }
}

} // namespace

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

void RequireSoundCells(vtkDataSet* input)
{
  if (auto* surface = vtkPolyData::SafeDownCast(input))
  {
    RequireSound(surface->GetVerts(), "vertices");
    RequireSound(surface->GetLines(), "lines");
    RequireSound(surface->GetPolys(), "polygons");
    RequireSound(surface->GetStrips(), "triangle strips");
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(input))
  {
    RequireSound(grid->GetCells(), "cells");
    RequireExistingPoints(grid->GetCells(), grid->GetNumberOfPoints());
  }
}

void RequireFurtherInputs(vtkInformationVector** inputs, int ports)
{
  for (int port = 1; port < ports; ++port)
  {
    vtkDataSet* const data = vtkDataSet::GetData(inputs[port]);
    RequireSoundCells(data);
    if (auto* surface = vtkPolyData::SafeDownCast(data))
    {
      for (vtkCellArray* cells :
        { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
      {
        RequireExistingPoints(cells, surface->GetNumberOfPoints());
      }
    }
  }
}

void RequireCorners(
  Id cell, vtkIdType size, const vtkIdType* ids, vtkIdType points, const char* whole)
{
  for (vtkIdType k = 0; k < size; ++k)
  {
    if (ids[k] < 0 || ids[k] >= points)
    {
      throw InvalidInput("Cell " + std::to_string(cell) + " uses point " + std::to_string(ids[k]) +
                         ", but the " + whole + " has " + std::to_string(points) +
                         " points. Clean the mesh first.");
    }
  }
}

} // namespace gridfem
