#include "Pipeline/InputSurface.h"

#include "Input/GivenValues.h"
#include "Input/SelectedPoints.h"
#include "Output/ClippedArrays.h"
#include "Output/ClippedSurface.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <utility>

namespace gridfem
{

void AddMesh(StageKey& key, vtkPolyData* data)
{
  key.Add(data->GetPoints()).Add(data->GetPoints() ? data->GetPoints()->GetData() : nullptr);
  for (vtkCellArray* cells : { data->GetPolys(), data->GetStrips() })
  {
    key.Add(cells);
    key.Add(cells ? cells->GetOffsetsArray() : nullptr);
    key.Add(cells ? cells->GetConnectivityArray() : nullptr);
  }
  key.Add(data->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  // Cells of these kinds come first and shift the ids of the polygons.
  key.Add(std::int64_t{ data->GetNumberOfVerts() }).Add(std::int64_t{ data->GetNumberOfLines() });
}

void AddClipArrays(StageKey& key, vtkPolyData* data)
{
  for (const char* name : { SourceCellIdName, OctreeCellIdName })
  {
    key.Add(data->GetCellData()->GetAbstractArray(name));
  }
  for (const char* name : { OctreeCellsName, GridOriginName, GridSpacingName, GridDepthName })
  {
    key.Add(data->GetFieldData()->GetAbstractArray(name));
  }
}

void AddBasisArrays(StageKey& key, vtkPolyData* data)
{
  AddClipArrays(key, data);
  key.Add(data->GetCellData()->GetAbstractArray(PatchIdName));
  for (const char* name : { PatchCellIdName, PatchBasisIdsName, NumberOfBasisFunctionsName,
         ConnectivityAwareName, WeldCoincidentPointsName })
  {
    key.Add(data->GetFieldData()->GetAbstractArray(name));
  }
}

InputSurface::InputSurface(vtkAlgorithm* filter, const FilterOptions& options)
  : filter_(filter), options_(options)
{
}

InputSurface::~InputSurface() = default;

bool InputSurface::AreFunctionsGiven() const
{
  return basisData_ || (input_ && CarriesBasis(input_));
}

void InputSurface::Select(
  SelectedPoints& points, vtkSelection* selection, const JoinedBlocks* joined) const
{
  points.Update(*this, selection, input_, joined);
}

GivenField InputSurface::Given(const InputArray& array) const
{
  GivenField field;
  if (array.array)
  {
    field.name = array.name;
    field.association = array.association;
    field.components = array.array->GetNumberOfComponents();
    field.version.Add(array.array);
    field.read = [this, array](NaNs nans) { return ReadField(array, triangles_, nans); };
  }
  return field;
}

GivenConstraints InputSurface::ConstraintsOf(
  const InputArray& values, const InputArray& mask, const SelectedPoints& selection) const
{
  GivenConstraints constraints;
  if (!mask.array && !selection.IsGiven())
  {
    return constraints;
  }
  InputArray held = values;
  if (!held.array)
  {
    held.array = input_ && input_->GetPoints() ? input_->GetPoints()->GetData() : nullptr;
    held.name = "coordinates";
  }
  constraints.property = mask.array ? "Constraint Array" : "The Selection";
  constraints.version.Add(mask.array).Add(selection.Version());
  constraints.find = [this, held, mask, &selection]
  {
    PointValues known;
    known.values.resize(0, held.array ? held.array->GetNumberOfComponents() : 3);
    if (!this->Mesh().triangles.empty())
    {
      PointValues given = FindKnownValues(held, mask, selection, this->Mesh());
      known = { std::move(given.points), std::move(given.values) };
    }
    return known;
  };
  return constraints;
}

} // namespace gridfem
