#include "Output/ResultNames.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace gridfem
{
namespace
{

vtkSmartPointer<vtkAbstractArray> WithName(vtkAbstractArray* array, const std::string& name)
{
  auto copy = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  if (auto* numbers = vtkDataArray::SafeDownCast(copy))
  {
    numbers->ShallowCopy(vtkDataArray::SafeDownCast(array));
  }
  else
  {
    copy->DeepCopy(array); // strings share nothing
  }
  copy->SetName(name.c_str());
  return copy;
}

/// Returns a name for an array of the input that has to make room.
std::string FreeName(const std::string& name, vtkDataSetAttributes* taken)
{
  const std::string first = name + "_input";
  std::string free = first;
  for (int k = 2; taken->HasArray(free.c_str()); ++k)
  {
    free = first + "_" + std::to_string(k);
  }
  return free;
}

/// An array that the filter has made.
struct ResultArray
{
  vtkSmartPointer<vtkAbstractArray> array;
  int attribute = -1; // the active attribute that it is
};

/// Returns the results. Empty if all names are free and stay.
std::vector<ResultArray> ResultsToName(
  vtkDataSetAttributes* input, const std::string& prefix, vtkDataSetAttributes* output)
{
  std::vector<ResultArray> results;
  bool isReplaced = false;
  for (int k = 0; k < output->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = output->GetAbstractArray(k);
    const char* name = array->GetName();
    const int attribute = output->IsArrayAnAttribute(k);
    vtkAbstractArray* given = name ? input->GetAbstractArray(name) : array;
    if (given != array && attribute != vtkDataSetAttributes::NORMALS)
    {
      results.push_back({ array, attribute });
      isReplaced = isReplaced || given != nullptr;
    }
  }
  return isReplaced || !prefix.empty() ? results : std::vector<ResultArray>();
}

void Name(vtkDataSetAttributes* input, const std::string& prefix, vtkDataSetAttributes* output)
{
  const std::vector<ResultArray> results = ResultsToName(input, prefix, output);
  for (const ResultArray& result : results)
  {
    const char* name = result.array->GetName();
    output->RemoveArray(name);
    if (vtkAbstractArray* given = input->GetAbstractArray(name))
    {
      output->AddArray(given);
    }
  }
  for (const ResultArray& result : results)
  {
    const std::string name = prefix + result.array->GetName();
    if (vtkAbstractArray* given = output->GetAbstractArray(name.c_str()))
    {
      output->AddArray(WithName(given, FreeName(name, output)));
    }
    output->AddArray(prefix.empty() ? result.array : WithName(result.array, name));
    if (result.attribute >= 0)
    {
      output->SetActiveAttribute(name.c_str(), result.attribute);
    }
  }
}

} // namespace

void NameResults(vtkPolyData* input, const std::string& prefix, vtkPolyData* output)
{
  if (!input || input->GetPolys() != output->GetPolys() ||
      input->GetStrips() != output->GetStrips())
  {
    return;
  }
  Name(input->GetPointData(), prefix, output->GetPointData());
  Name(input->GetCellData(), prefix, output->GetCellData());
}

} // namespace gridfem
