#include "Input/InputArray.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkPointData.h"

#include <cmath>

namespace gridfem
{
namespace
{

std::string ChosenName(vtkInformation* choice)
{
  const char* name =
    choice->Has(vtkDataObject::FIELD_NAME()) ? choice->Get(vtkDataObject::FIELD_NAME()) : nullptr;
  return name ? name : "";
}

std::string ArrayNames(vtkDataSetAttributes* attributes)
{
  std::string names;
  for (int k = 0; k < attributes->GetNumberOfArrays(); ++k)
  {
    const char* name = attributes->GetAbstractArray(k)->GetName();
    names += (names.empty() ? "" : ", ") + std::string(name ? name : "(no name)");
  }
  return names.empty() ? "none" : names;
}

/// Returns the chosen array among one kind of data, or null.
vtkAbstractArray* FindAmong(vtkDataSetAttributes* attributes, vtkInformation* choice)
{
  if (choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    return attributes->GetAbstractAttribute(choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
  }
  return attributes->GetAbstractArray(ChosenName(choice).c_str());
}

/// Returns the chosen array, or null. Tells whether it is point data.
vtkAbstractArray* FindArray(
  vtkInformation* choice, vtkDataSet* input, const std::string& property, bool& onPoints)
{
  const int association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  const bool both = association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
  const bool points = both || association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  const bool cells = both || association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  if (!points && !cells)
  {
    throw InvalidInput(
      property + " '" + ChosenName(choice) + "' must be a point array or a cell array.");
  }
  vtkAbstractArray* found = points ? FindAmong(input->GetPointData(), choice) : nullptr;
  onPoints = found != nullptr;
  return found || !cells ? found : FindAmong(input->GetCellData(), choice);
}

/// Returns the number of values of an array of points or cells.
vtkIdType TuplesOf(vtkDataSet* input, bool onPoints)
{
  return onPoints ? input->GetNumberOfPoints() : input->GetNumberOfCells();
}

/// @param association  where the array was looked for
void RequireFound(vtkAbstractArray* found, const InputArray& result, const std::string& property,
  vtkDataSet* input, int association)
{
  const std::string subject = property + " '" + result.name + "'";
  if (!found)
  {
    throw MissingArray(subject +
                         " does not exist. Point arrays: " + ArrayNames(input->GetPointData()) +
                         ". Cell arrays: " + ArrayNames(input->GetCellData()) + ".",
      result.name, association);
  }
  if (!result.array)
  {
    throw InvalidInput(subject + " is not numeric.");
  }
  const bool onPoints = result.association == FieldAssociation::Points;
  RequireLength(found, TuplesOf(input, onPoints), subject, onPoints ? "points" : "cells");
}

std::string NameOfTuple(const InputArray& input, vtkIdType tuple)
{
  const bool onPoints = input.association == FieldAssociation::Points;
  return (onPoints ? "point " : "cell ") + std::to_string(tuple);
}

bool HasNaN(vtkDataArray* array, vtkIdType tuple, int first, int components)
{
  for (int c = first; c < first + components; ++c)
  {
    if (std::isnan(array->GetComponent(tuple, c)))
    {
      return true;
    }
  }
  return false;
}

/// Copies a tuple into a row. Throws if a value is not finite.
void CopyTuple(const InputArray& input, vtkIdType tuple, NaNs nans, MultiVector& values, Id row)
{
  double* const to = values.data() + row * values.cols();
  input.array->GetTuple(tuple, to);
  const bool mayBeNaN = nans == NaNs::Kept && IsUnknown(input, tuple);
  for (const double* value = to; value != to + values.cols(); ++value)
  {
    if (!std::isfinite(*value) && !(mayBeNaN && std::isnan(*value)))
    {
      throw InvalidInput("Array '" + input.name + "' has a NaN or infinite value at " +
                         NameOfTuple(input, tuple) +
                         ". Replace such values first, for example with the Calculator.");
    }
  }
}

} // namespace

void RequireLength(
  vtkAbstractArray* array, vtkIdType expected, const std::string& subject, const std::string& kind)
{
  if (array->GetNumberOfTuples() != expected)
  {
    throw InvalidInput(subject + " has " + std::to_string(array->GetNumberOfTuples()) +
                       " values, but the mesh has " + std::to_string(expected) + " " + kind + ".");
  }
}

bool MeansNoArray(const std::string& name)
{
  return name.empty() || name == "None" || name.compare(0, 5, "(None") == 0;
}

bool HasArray(vtkDataSet* data, const std::string& name)
{
  return data->GetPointData()->HasArray(name.c_str()) ||
         data->GetCellData()->HasArray(name.c_str());
}

bool MissingArray::IsOn(vtkDataSet* data) const
{
  const bool mayBeOnPoints = association != vtkDataObject::FIELD_ASSOCIATION_CELLS;
  const bool mayBeOnCells = association != vtkDataObject::FIELD_ASSOCIATION_POINTS;
  return (mayBeOnPoints && data->GetPointData()->HasArray(array.c_str())) ||
         (mayBeOnCells && data->GetCellData()->HasArray(array.c_str()));
}

bool IsChosen(vtkInformation* choice, vtkDataSet* input)
{
  if (choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    return true;
  }
  const std::string name = ChosenName(choice);
  return !MeansNoArray(name) || (!name.empty() && input && HasArray(input, name));
}

InputArray FindInputArray(
  vtkAlgorithm* algorithm, int index, vtkDataSet* input, const std::string& property)
{
  InputArray result;
  vtkInformation* choice = algorithm->GetInputArrayInformation(index);
  if (!IsChosen(choice, input))
  {
    return result;
  }
  bool onPoints = false;
  vtkAbstractArray* found = FindArray(choice, input, property, onPoints);
  result.array = vtkDataArray::SafeDownCast(found);
  result.name = found && found->GetName() ? found->GetName() : ChosenName(choice);
  result.association = onPoints ? FieldAssociation::Points : FieldAssociation::Triangles;
  RequireFound(found, result, property, input, choice->Get(vtkDataObject::FIELD_ASSOCIATION()));
  return result;
}

InputArray OnlyArray(
  vtkDataSet* input, const std::function<bool(vtkDataArray*, vtkDataSetAttributes*)>& fits)
{
  InputArray only;
  for (const auto association : { FieldAssociation::Points, FieldAssociation::Triangles })
  {
    const bool onPoints = association == FieldAssociation::Points;
    vtkDataSetAttributes* attributes =
      onPoints ? static_cast<vtkDataSetAttributes*>(input->GetPointData()) : input->GetCellData();
    for (int k = 0; k < attributes->GetNumberOfArrays(); ++k)
    {
      vtkDataArray* array = attributes->GetArray(k); // null: no numbers
      if (!array || array->GetNumberOfTuples() != TuplesOf(input, onPoints) ||
          !fits(array, attributes))
      {
        continue;
      }
      if (only.array)
      {
        return {};
      }
      only = { array, association, array->GetName() ? array->GetName() : "" };
    }
  }
  return only;
}

bool IsUnknown(const InputArray& input, vtkIdType tuple)
{
  if (!HasNaN(input.array, tuple, 0, input.array->GetNumberOfComponents()))
  {
    return false;
  }
  int first = 0;
  for (const int components : input.parts)
  {
    if (!HasNaN(input.array, tuple, first, components))
    {
      throw InvalidInput("Some of the arrays '" + input.name + "' are NaN at " +
                         NameOfTuple(input, tuple) +
                         " and some are not. Choose arrays that are known at the same places.");
    }
    first += components;
  }
  return true;
}

Field ReadField(const InputArray& input, const InputMesh& mesh, NaNs nans)
{
  const TriangleMesh& triangles = *mesh.triangles;
  Field field;
  field.association = input.association;
  const bool onPoints = input.association == FieldAssociation::Points;
  const Id rows = onPoints ? static_cast<Id>(triangles.points.size())
                           : static_cast<Id>(triangles.triangles.size());
  field.values = MultiVector::Zero(rows, input.array->GetNumberOfComponents());
  const std::vector<char> used = onPoints ? UsedPoints(triangles) : std::vector<char>{};
  for (Id row = 0; row < rows; ++row)
  {
    if (!onPoints || used[row])
    {
      CopyTuple(input, onPoints ? row : mesh.sourceCell[row], nans, field.values, row);
    }
  }
  return field;
}

} // namespace gridfem
