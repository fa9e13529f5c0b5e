#include "Input/JoinedArrays.h"

#include "Input/Domain.h"
#include "Output/SolverOutput.h"
#include "Pipeline/Allocation.h"
#include "Pipeline/InputSurface.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace gridfem
{
namespace
{

constexpr int FirstFurther = DomainIndex + 1;

vtkInformationVector* ArrayChoices(vtkAlgorithm* filter)
{
  return filter->GetInformation()->Get(vtkAlgorithm::INPUT_ARRAYS_TO_PROCESS());
}

} // namespace

int NumberOfFurtherArrays(vtkAlgorithm* filter)
{
  vtkInformationVector* choices = ArrayChoices(filter);
  return choices ? std::max(0, choices->GetNumberOfInformationObjects() - FirstFurther) : 0;
}

void AddFurtherArray(vtkAlgorithm* filter, const char* name)
{
  if (name && !MeansNoArray(name))
  {
    filter->SetInputArrayToProcess(FirstFurther + NumberOfFurtherArrays(filter), 0, 0,
      vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, name);
  }
}

void ClearFurtherArrays(vtkAlgorithm* filter)
{
  if (NumberOfFurtherArrays(filter) > 0)
  {
    ArrayChoices(filter)->SetNumberOfInformationObjects(FirstFurther);
    filter->Modified();
  }
}

InputArray JoinedArrays::Join(vtkAlgorithm* filter, const InputSurface& surface,
  const InputArray& first, const std::string& property, const FindArray& find)
{
  parts_ = { { first, first.array ? surface.DataTypeOf(0, first) : 0 } };
  const int further = NumberOfFurtherArrays(filter);
  if (further == 0)
  {
    joined_ = nullptr;
    return first;
  }
  if (!first.array)
  {
    throw InvalidInput("Further Arrays need a first one. Choose the " + property + ", too.");
  }
  const bool onPoints = first.association == FieldAssociation::Points;
  for (int index = FirstFurther; index < FirstFurther + further; ++index)
  {
    vtkInformation* choice = filter->GetInputArrayInformation(index);
    choice->Set(vtkDataObject::FIELD_ASSOCIATION(),
      onPoints ? vtkDataObject::FIELD_ASSOCIATION_POINTS : vtkDataObject::FIELD_ASSOCIATION_CELLS);
    InputArray array = find(
      index, onPoints ? "As point data, the Further Array" : "As cell data, the Further Array");
    if (!array.array)
    {
      throw InvalidInput("The Further Array " + std::to_string(index - FirstFurther + 1) +
                         " is not chosen, though SetInputArrayToProcess has its index or a later "
                         "one.");
    }
    if (array.name.empty() && choice->Has(vtkDataObject::FIELD_NAME()))
    {
      // A rank without polygons has found no name.
      array.name = choice->Get(vtkDataObject::FIELD_NAME());
    }
    array.isOfSurface = first.isOfSurface;
    parts_.push_back({ array, surface.DataTypeOf(index, array) });
  }
  InputArray all = first;
  StageKey key;
  for (const Part& part : parts_)
  {
    key.Add(part.array.array);
    all.name += &part == &parts_.front() ? "" : "', '" + part.array.name;
    all.parts.push_back(part.array.array->GetNumberOfComponents());
  }
  surface.Together(
    [&]
    {
      if (!joined_ || key != key_)
      {
        joined_ = this->CopyTogether();
        key_ = key;
      }
    });
  all.array = joined_;
  return all;
}

InputArray JoinedArrays::Join(
  vtkAlgorithm* filter, InputSurface& surface, const InputArray& first, const std::string& property)
{
  return this->Join(filter, surface, first, property,
    [&surface](int index, const std::string& further) { return surface.Find(index, further); });
}

vtkSmartPointer<vtkDataArray> JoinedArrays::CopyTogether() const
{
  const int components = std::accumulate(parts_.begin(), parts_.end(), 0,
    [](int sum, const Part& part) { return sum + part.array.array->GetNumberOfComponents(); });
  auto joined =
    NewArray<vtkDoubleArray>(nullptr, parts_.front().array.array->GetNumberOfTuples(), components);
  int c = 0;
  for (const Part& part : parts_)
  {
    for (int own = 0; own < part.array.array->GetNumberOfComponents(); ++own, ++c)
    {
      joined->CopyComponent(c, part.array.array, own);
    }
  }
  return joined;
}

void JoinedArrays::AddSolutions(
  const char* name, const MultiVector& values, vtkPointData* points) const
{
  Id column = 0;
  for (const Part& part : parts_)
  {
    const InputArray& array = part.array;
    const bool isFirst = &part == &parts_.front();
    const std::string nameOfPart = isFirst ? name : array.name + "_" + name;
    const int components = array.array->GetNumberOfComponents();
    points->AddArray(MakeSolution(
      nameOfPart.c_str(), values.middleCols(column, components), array, part.dataType));
    column += components;
  }
  points->SetActiveScalars(name);
}

} // namespace gridfem
