#include "Input/Domain.h"

#include "Pieces/PieceArrays.h"
#include "Pipeline/InputSurface.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Whether a point or a cell is in the domain by its own value.
bool IsInside(vtkDataArray* domain, vtkIdType thing)
{
  const double value = domain->GetComponent(thing, 0);
  return value != 0.0 && !std::isnan(value);
}

} // namespace

Domain::Domain() = default;
Domain::~Domain() = default;

vtkInformationVector** Domain::Apply(
  vtkAlgorithm* filter, vtkInformationVector** inputs, int numberOfPorts)
{
  vtkPolyData* surface = vtkPolyData::GetData(inputs[0]);
  const InputArray array = surface && surface->GetNumberOfCells() > 0
                             ? FindInputArray(filter, DomainIndex, surface, "Domain Array")
                             : InputArray();
  if (!array.array)
  {
    this->Free();
    return inputs;
  }
  if (array.array->GetNumberOfComponents() != 1)
  {
    throw InvalidInput("Domain Array '" + array.name + "' must have one component.");
  }
  StageKey key;
  AddMesh(key, surface);
  key.Add(array.array).Add(static_cast<int>(array.association));
  if (!marks_ || key != marked_)
  {
    this->Mark(surface, array);
    marked_ = key;
  }
  surface_->ShallowCopy(surface);
  surface_->GetCellData()->AddArray(marks_);
  return inputs_.Of(inputs, numberOfPorts, surface_);
}

void Domain::Mark(vtkPolyData* surface, const InputArray& array)
{
  given_ = GhostsOf(surface->GetCellData(), surface->GetNumberOfCells());
  marks_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
  marks_->SetName(vtkDataSetAttributes::GhostArrayName());
  marks_->SetNumberOfTuples(surface->GetNumberOfCells());
  const bool isOnPoints = array.association == FieldAssociation::Points;
  ForEachCell(surface,
    [&](vtkIdType cell, const vtkIdType* points, vtkIdType size)
    {
      const bool isInside =
        isOnPoints ? std::all_of(points, points + size,
                       [&](vtkIdType point)
                       {
                         return point < 0 || point >= surface->GetNumberOfPoints() ||
                                IsInside(array.array, point); // an invalid id fails elsewhere
                       })
                   : IsInside(array.array, cell);
      const unsigned char mark = given_ ? given_->GetValue(cell) : 0;
      marks_->SetValue(cell,
        isInside ? mark : mark | static_cast<unsigned char>(vtkDataSetAttributes::HIDDENCELL));
    });
}

void Domain::PutBack(vtkPolyData* output) const
{
  const char* name = vtkDataSetAttributes::GhostArrayName();
  vtkCellData* cells = output->GetCellData();
  if (marks_ && !given_)
  {
    cells->RemoveArray(name); // also copies of the marks, on cells of the output's own
  }
  else if (marks_ && cells->GetAbstractArray(name) == marks_)
  {
    cells->AddArray(given_);
  }
}

void Domain::Free()
{
  marks_ = nullptr;
  given_ = nullptr;
  surface_->Initialize();
  inputs_.Free();
}

} // namespace gridfem
