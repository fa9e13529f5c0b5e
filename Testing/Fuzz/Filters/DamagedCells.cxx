// Damages the offsets and corners of cell arrays.
#include "DamagedInput.h"

#include "AllFilters.h"

#include "vtkIdTypeArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

namespace gridfem::testing
{
namespace
{

/// Returns the ids in range, or a few of them damaged.
std::vector<Id> DamagedIds(Choice& choice, vtkDataArray* ids, DamagedCase& outcome)
{
  vtkNew<vtkDoubleArray> values;
  values->DeepCopy(ids);
  values->SetName("ids");
  DamageArray(choice, values, outcome);
  std::vector<Id> damaged;
  for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
  {
    const double value = values->GetValue(k);
    damaged.push_back(std::isfinite(value) ? static_cast<Id>(std::clamp(value, -2e9, 2e9)) : -1);
  }
  return damaged;
}

template<class Ids>
vtkSmartPointer<Ids> ArrayOf(const std::vector<Id>& values)
{
  auto array = vtkSmartPointer<Ids>::New();
  for (const Id value : values)
  {
    array->InsertNextValue(static_cast<typename Ids::ValueType>(value));
  }
  return array;
}

vtkSmartPointer<vtkCellArray> DamagedCells(
  Choice& choice, vtkCellArray* cells, DamagedCase& outcome)
{
  std::vector<Id> offsets;
  std::vector<Id> corners;
  for (const double value : Values(cells->GetOffsetsArray()))
  {
    offsets.push_back(static_cast<Id>(value));
  }
  for (const double value : Values(cells->GetConnectivityArray()))
  {
    corners.push_back(static_cast<Id>(value));
  }
  if (choice.OneIn(2))
  {
    outcome.description += "offsets: ";
    offsets = DamagedIds(choice, cells->GetOffsetsArray(), outcome);
  }
  else
  {
    outcome.description += "corners: ";
    corners = DamagedIds(choice, cells->GetConnectivityArray(), outcome);
  }
  if (offsets.empty())
  {
    offsets.push_back(0); // VTK itself needs one
  }
  auto damaged = vtkSmartPointer<vtkCellArray>::New();
  if (choice.OneIn(2))
  {
    damaged->SetData(ArrayOf<vtkTypeInt32Array>(offsets), ArrayOf<vtkTypeInt32Array>(corners));
  }
  else
  {
    damaged->SetData(ArrayOf<vtkTypeInt64Array>(offsets), ArrayOf<vtkTypeInt64Array>(corners));
  }
  return damaged;
}

vtkSmartPointer<vtkSurfaceFEMAlgorithm> AnyFilter(Choice& choice)
{
  using MakeFilter = vtkSmartPointer<vtkSurfaceFEMAlgorithm> (*)();
  const MakeFilter make =
    choice.Of<MakeFilter>({ &Make<vtkScreenedPoisson>, &MakeHats, &MakeGradient,
      &Make<vtkClipToOctree>, &Make<vtkGeodesicDistance>, &Make<vtkPrincipalCurvatures> });
  auto filter = make();
  filter->SetDepth(3);
  filter->SetNumberOfThreads(1);
  return filter;
}

vtkSmartPointer<vtkPolyData> Sphere()
{
  auto surface = ToPolyData(GeodesicSphere(3));
  AddArraysOfAllFilters(surface);
  return surface;
}

/// Puts damaged cells into a copy of the surface, as one of the four kinds of cells.
vtkSmartPointer<vtkDataSet> DamagedSurface(
  Choice& choice, vtkPolyData* sphere, vtkCellArray* damaged)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(sphere);
  switch (choice.Integer(0, 5))
  {
    case 0:
      surface->SetStrips(damaged);
      break;
    case 1:
      surface->SetLines(damaged);
      break;
    case 2:
      surface->SetVerts(damaged);
      break;
    default:
      surface->SetPolys(damaged);
  }
  return surface;
}

} // namespace

void RunOnDamagedCells(Choice& choice, DamagedCase& outcome)
{
  static const vtkSmartPointer<vtkPolyData> sphere = Sphere();
  const auto damaged = DamagedCells(choice, sphere->GetPolys(), outcome);
  vtkSmartPointer<vtkDataSet> input;
  if (choice.OneIn(4))
  {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(sphere->GetPoints());
    grid->SetCells(VTK_TRIANGLE, damaged);
    grid->GetPointData()->ShallowCopy(sphere->GetPointData());
    input = grid;
  }
  else
  {
    input = DamagedSurface(choice, sphere, damaged);
  }
  const auto filter = AnyFilter(choice);
  outcome.description +=
    std::string(" in ") + input->GetClassName() + " for " + filter->GetClassName();
  filter->SetInputDataObject(0, input);
  if (RunOnDamaged(filter, outcome) && !filter->IsA("vtkClipToOctree"))
  {
    auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
    for (int k = 0; k < output->GetPointData()->GetNumberOfArrays(); ++k)
    {
      const auto values = Values(output->GetPointData()->GetArray(k));
      outcome.Require(
        std::none_of(values.begin(), values.end(), [](double value) { return std::isinf(value); }),
        std::string("an infinite ") + output->GetPointData()->GetArrayName(k));
    }
  }
}

} // namespace gridfem::testing
