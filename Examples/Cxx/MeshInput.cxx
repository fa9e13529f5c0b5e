#include "MeshInput.h"

#include <vtkDoubleArray.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int NumberOfStripes = 16;
constexpr double NoiseOfStripes = 0.6; // largest deviation, of stripes between 0 and 1

template<class Reader>
vtkSmartPointer<vtkAlgorithm> Open(const std::string& path)
{
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  return reader;
}

vtkSmartPointer<vtkDoubleArray> StripesAlongLongestSide(vtkPolyData* mesh)
{
  double bounds[6];
  mesh->GetBounds(bounds);
  int axis = 0;
  for (int i = 1; i < 3; ++i)
  {
    const bool longer = bounds[2 * i + 1] - bounds[2 * i] > bounds[2 * axis + 1] - bounds[2 * axis];
    axis = longer ? i : axis;
  }
  const double low = bounds[2 * axis];
  const double length = bounds[2 * axis + 1] - low;

  auto stripes = vtkSmartPointer<vtkDoubleArray>::New();
  stripes->SetName("Stripes");
  stripes->SetNumberOfValues(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double place = length > 0 ? (mesh->GetPoint(i)[axis] - low) / length : 0;
    stripes->SetValue(i, static_cast<int>(NumberOfStripes * place) % 2);
  }
  return stripes;
}

vtkSmartPointer<vtkDoubleArray> WithNoise(vtkDataArray* values)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(1);
  double range[2];
  values->GetRange(range);
  const double deviation = NoiseOfStripes * (range[1] - range[0]);
  auto noisy = vtkSmartPointer<vtkDoubleArray>::New();
  noisy->SetName(("Noisy" + std::string(values->GetName())).c_str());
  noisy->SetNumberOfValues(values->GetNumberOfTuples());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    random->Next();
    noisy->SetValue(i, values->GetTuple1(i) + random->GetRangeValue(-deviation, deviation));
  }
  return noisy;
}

} // namespace

vtkSmartPointer<vtkAlgorithm> FindReader(const std::string& path)
{
  const std::string ending =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(path));
  if (ending == ".ply")
  {
    return Open<vtkPLYReader>(path);
  }
  if (ending == ".obj")
  {
    return Open<vtkOBJReader>(path);
  }
  if (ending == ".stl")
  {
    return Open<vtkSTLReader>(path);
  }
  if (ending == ".vtp")
  {
    return Open<vtkXMLPolyDataReader>(path);
  }
  if (ending == ".vtk")
  {
    return Open<vtkPolyDataReader>(path);
  }
  return nullptr;
}

std::string AddArrayToSmooth(vtkPolyData* mesh)
{
  vtkPointData* pointData = mesh->GetPointData();
  if (!pointData->GetScalars())
  {
    pointData->SetScalars(StripesAlongLongestSide(mesh));
  }
  vtkSmartPointer<vtkDataArray> values = pointData->GetScalars();
  if (!values->GetName())
  {
    values->SetName("Scalars");
  }
  if (values->GetNumberOfComponents() == 1)
  {
    values = WithNoise(values);
    pointData->AddArray(values);
  }
  return values->GetName();
}
