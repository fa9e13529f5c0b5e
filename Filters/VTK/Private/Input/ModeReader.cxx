#include "Input/ModeReader.h"

#include "Input/NearestPoints.h"
#include "Output/SolverOutput.h"

#include "Base/Errors.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

constexpr const char* EigenvaluesName = "Eigenvalues";

vtkDataArray* Eigenvalues(vtkPolyData* input)
{
  return input->GetFieldData()->GetArray(EigenvaluesName);
}

void ReadMode(vtkPolyData* input, int mode, const std::vector<char>& used, MultiVector& values)
{
  const std::string name = ModeName(mode);
  vtkDataArray* array = input->GetPointData()->GetArray(name.c_str());
  if (!array || array->GetNumberOfComponents() != 1 ||
      array->GetNumberOfTuples() != input->GetNumberOfPoints())
  {
    throw InvalidInput("The field array 'Eigenvalues' lists " + std::to_string(values.cols()) +
                       " modes, but the point array '" + name + "' is missing or does not fit.");
  }
  for (Id point = 0; point < values.rows(); ++point)
  {
    const double value = array->GetComponent(point, 0);
    if (used[point] && !std::isfinite(value))
    {
      throw InvalidInput(
        "Array '" + name + "' has a NaN or infinite value at point " + std::to_string(point) + ".");
    }
    values(point, mode) = used[point] ? value : 0.0;
  }
}

/// Whether a name is Mode, Mode000, Mode001, ...
bool IsModeName(const std::string& name)
{
  const std::string prefix = "Mode";
  const std::size_t digits = name.size() - std::min(name.size(), prefix.size());
  return name.compare(0, prefix.size(), prefix) == 0 && (digits == 0 || digits >= 3) &&
         std::all_of(name.end() - digits, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

std::string ModeName(int mode)
{
  return NumberedName("Mode", mode);
}

bool CarriesModes(vtkPolyData* input)
{
  return Eigenvalues(input) && input->GetPointData()->HasArray(ModeName(0).c_str());
}

void RemoveModes(vtkPolyData* data)
{
  if (!Eigenvalues(data))
  {
    return;
  }
  vtkPointData* arrays = data->GetPointData();
  for (int k = arrays->GetNumberOfArrays() - 1; k >= 0; --k)
  {
    const char* name = arrays->GetAbstractArray(k)->GetName();
    if (name && IsModeName(name))
    {
      arrays->RemoveArray(k);
    }
  }
  data->GetFieldData()->RemoveArray(EigenvaluesName);
}

void AddModeArrays(StageKey& key, vtkPolyData* input)
{
  key.Add(Eigenvalues(input));
  for (int mode = 0; mode < Eigenvalues(input)->GetNumberOfTuples(); ++mode)
  {
    key.Add(input->GetPointData()->GetAbstractArray(ModeName(mode).c_str()));
  }
}

PointModes ReadModes(vtkPolyData* input, const InputMesh& mesh)
{
  vtkDataArray* eigenvalues = Eigenvalues(input);
  PointModes modes;
  modes.area = SurfaceArea(*mesh.triangles);
  const int count = static_cast<int>(eigenvalues->GetNumberOfTuples());
  modes.values.resize(static_cast<Id>(mesh.triangles->points.size()), count);
  const std::vector<char> used = UsedPoints(*mesh.triangles);
  for (int mode = 0; mode < count; ++mode)
  {
    modes.eigenvalues.push_back(eigenvalues->GetComponent(mode, 0));
    ReadMode(input, mode, used, modes.values);
  }
  return modes;
}

} // namespace gridfem
