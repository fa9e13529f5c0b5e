#include "Output/InterpolatedArrays.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Input/InputArray.h"
#include "Output/ClippedArrays.h"
#include "Pipeline/Allocation.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

void CopyNames(vtkAbstractArray* from, vtkAbstractArray* to)
{
  to->SetName(from->GetName());
  to->SetNumberOfComponents(from->GetNumberOfComponents());
  to->CopyComponentNames(from);
}

vtkSmartPointer<vtkDataArray> Interpolate(
  vtkDataArray* input, const TriangleMesh& mesh, const ClippedMesh& clipped, int threads)
{
  auto output = vtkSmartPointer<vtkDoubleArray>::New();
  CopyNames(input, output);
  SetTuples(output, static_cast<vtkIdType>(clipped.position.size()));
  const int components = input->GetNumberOfComponents();
  double* values = output->GetPointer(0);
  // Several threads may not read an array that computes its values.
  const int readers = input->HasStandardMemoryLayout() ? threads : 1;
  ParallelRanges(clipped.numberOfInputPoints, readers,
    [&](Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        input->GetTuple(point, values + point * components);
      }
    });
  double* cutValues = values + clipped.numberOfInputPoints * components;
  ParallelRanges(static_cast<Id>(clipped.cutPoints.size()), readers,
    [&](Id begin, Id end)
    {
      for (Id cut = begin; cut < end; ++cut)
      {
        const CutPoint& at = clipped.cutPoints[cut];
        const auto& corner = mesh.triangles[at.triangle];
        const std::array<double, 3> weight = at.Weights();
        for (int c = 0; c < components; ++c)
        {
          double value = 0.0;
          for (int k = 0; k < 3; ++k)
          {
            // A corner that does not count must not spoil the value with its NaN.
            value += weight[k] == 0.0 ? 0.0 : weight[k] * input->GetComponent(corner[k], c);
          }
          cutValues[cut * components + c] = value;
        }
      }
    });
  return output;
}

/// Rounds means of bytes to bytes. They are already in range.
vtkSmartPointer<vtkDataArray> ToColor(vtkDataArray* values)
{
  auto color = vtkSmartPointer<vtkUnsignedCharArray>::New();
  CopyNames(values, color);
  SetTuples(color, values->GetNumberOfTuples());
  for (vtkIdType tuple = 0; tuple < values->GetNumberOfTuples(); ++tuple)
  {
    for (int c = 0; c < values->GetNumberOfComponents(); ++c)
    {
      const long rounded = std::lround(values->GetComponent(tuple, c));
      color->SetTypedComponent(tuple, c, static_cast<unsigned char>(rounded));
    }
  }
  return color;
}

/// Takes the nearest values of an array that cannot be averaged.
vtkSmartPointer<vtkAbstractArray> TakeNearest(
  vtkAbstractArray* input, const TriangleMesh& mesh, const ClippedMesh& clipped)
{
  vtkNew<vtkIdList> from;
  for (Id point = 0; point < clipped.numberOfInputPoints; ++point)
  {
    from->InsertNextId(point);
  }
  for (const CutPoint& at : clipped.cutPoints)
  {
    const std::array<double, 3> weight = at.Weights();
    const auto nearest = std::max_element(weight.begin(), weight.end()) - weight.begin();
    from->InsertNextId(mesh.triangles[at.triangle][nearest]);
  }
  return PickTuples(input, from);
}

/// Sets a tuple to no value.
void SetNothing(vtkAbstractArray* array, vtkIdType tuple)
{
  if (auto* numbers = vtkDataArray::SafeDownCast(array))
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      numbers->SetComponent(tuple, c, NumberOfNone(array));
    }
  }
}

} // namespace

void RequireLength(vtkAbstractArray* array, Id expected, const std::string& kind)
{
  const char* name = array->GetName();
  RequireLength(array, expected, "Array '" + std::string(name ? name : "(no name)") + "'", kind);
}

bool BelongsToItsPlaces(vtkAbstractArray* array, vtkDataSetAttributes* attributes)
{
  return array == attributes->GetArray(vtkDataSetAttributes::GhostArrayName()) ||
         array == attributes->GetGlobalIds() || array == attributes->GetPedigreeIds();
}

vtkSmartPointer<vtkAbstractArray> MakeLike(vtkAbstractArray* array, vtkIdType tuples)
{
  auto made = vtk::TakeSmartPointer(array->NewInstance());
  CopyNames(array, made);
  SetTuples(made, tuples);
  return made;
}

vtkSmartPointer<vtkAbstractArray> PickTuples(vtkAbstractArray* array, vtkIdList* places)
{
  auto picked = MakeLike(array, places->GetNumberOfIds());
  array->GetTuples(places, picked);
  return picked;
}

bool IsColor(vtkAbstractArray* array)
{
  const int components = array->GetNumberOfComponents();
  return array->GetDataType() == VTK_UNSIGNED_CHAR && (components == 3 || components == 4);
}

bool IsReal(vtkAbstractArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

double NumberOfNone(vtkAbstractArray* array)
{
  const double id = array->GetDataType() == VTK_ID_TYPE ? -1.0 : 0.0;
  return IsReal(array) ? std::numeric_limits<double>::quiet_NaN() : id;
}

vtkSmartPointer<vtkAbstractArray> ValuesAtPlaces(
  vtkAbstractArray* array, const std::vector<TrianglePlace>& places)
{
  auto output = MakeLike(array, static_cast<vtkIdType>(places.size()));
  const bool isLinear = IsReal(array) || IsColor(array);
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < static_cast<vtkIdType>(places.size()); ++k)
  {
    const TrianglePlace& place = places[k];
    std::array<double, 3> weights{};
    corners->Reset();
    for (int c = 0; c < 3; ++c)
    {
      if (place.weights[c] > 0.0) // a NaN at another corner must not count
      {
        weights[corners->InsertNextId(place.corners[c])] = place.weights[c];
      }
    }
    const auto nearest = std::max_element(weights.begin(), weights.end()) - weights.begin();
    if (corners->GetNumberOfIds() == 0)
    {
      SetNothing(output, k);
    }
    else if (isLinear)
    {
      output->InterpolateTuple(k, corners, array, weights.data());
    }
    else
    {
      output->SetTuple(k, corners->GetId(nearest), array);
    }
  }
  return output;
}

void PassActiveAttributes(vtkDataSetAttributes* input, vtkDataSetAttributes* output)
{
  for (const int attribute :
    { vtkDataSetAttributes::SCALARS, vtkDataSetAttributes::VECTORS, vtkDataSetAttributes::NORMALS,
      vtkDataSetAttributes::TCOORDS, vtkDataSetAttributes::TENSORS })
  {
    vtkAbstractArray* active = input->GetAbstractAttribute(attribute);
    if (active && active->GetName())
    {
      output->SetActiveAttribute(active->GetName(), attribute);
    }
  }
}

void InterpolatePointArrays(vtkPointData* input, const TriangleMesh& mesh,
  const ClippedMesh& clipped, bool areCut, int threads, vtkPointData* output)
{
  for (int k = 0; k < input->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = input->GetAbstractArray(k);
    RequireLength(array, clipped.numberOfInputPoints, "points");
    if (!areCut)
    {
      output->AddArray(array);
    }
    else if (array == input->GetGlobalIds() || array == input->GetPedigreeIds())
    {
      continue; // cut points have no such number
    }
    else if (IsReal(array) || IsColor(array))
    {
      auto values = Interpolate(vtkDataArray::SafeDownCast(array), mesh, clipped, threads);
      output->AddArray(IsColor(array) ? ToColor(values) : values);
    }
    else
    {
      output->AddArray(TakeNearest(array, mesh, clipped));
    }
  }
  PassActiveAttributes(input, output);
}

void CopyCellArrays(vtkCellData* input, Id numberOfCells, bool isClipped, vtkCellData* output,
  vtkDataArray* sourceCellId)
{
  if (input->GetNumberOfArrays() == 0)
  {
    return;
  }
  const vtkIdType count = sourceCellId->GetNumberOfTuples();
  vtkNew<vtkIdList> from;
  from->SetNumberOfIds(count);
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    from->SetId(cell, static_cast<vtkIdType>(sourceCellId->GetComponent(cell, 0)));
  }
  for (int k = 0; k < input->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = input->GetAbstractArray(k);
    const char* name = array->GetName();
    if ((name && output->HasArray(name)) || (isClipped && IsClipCellArray(name)))
    {
      continue;
    }
    RequireLength(array, numberOfCells, "cells");
    output->AddArray(PickTuples(array, from));
  }
  PassActiveAttributes(input, output);
}

} // namespace gridfem
