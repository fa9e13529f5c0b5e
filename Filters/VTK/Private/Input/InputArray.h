// Reads arrays chosen by the user as fields that Core integrates.
#ifndef GridFEM_InputArray_h
#define GridFEM_InputArray_h

#include "Base/Errors.h"
#include "Input/InputMesh.h"
#include "Solvers/GivenField.h"

#include "vtkType.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

class vtkAlgorithm;
class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkInformation;

namespace gridfem
{

/// An array of the input. If there is none, `array` is null.
struct InputArray
{
  vtkDataArray* array = nullptr;
  FieldAssociation association = FieldAssociation::Points; // Triangles: cell data
  std::string name;
  /// Components of each array that it is joined from; empty: it is one array.
  std::vector<int> parts{};
  bool isOfSurface = true; // false: of places of their own, so ids of the surface name no tuples
};

/// Thrown if the surface lacks the chosen array.
struct MissingArray : InvalidInput
{
  MissingArray(const std::string& message, std::string name, int whose)
    : InvalidInput(message), array(std::move(name)), association(whose)
  {
  }

  /// Whether a data set has the array where it was looked for.
  bool IsOn(vtkDataSet* data) const;

  std::string array;
  int association; // vtkDataObject::FIELD_ASSOCIATION_POINTS, ...
};

/// Thrown if the user has not chosen something that the filter needs. The filter then passes its
/// input on, with the message as a warning.
struct MissingChoice : InvalidInput
{
  using InvalidInput::InvalidInput;
};

/// Whether a name stands for no array: it is empty, "None", or begins with "(None" as in the lists
/// of the panels, where it comes before the names of arrays.
bool MeansNoArray(const std::string& name);

/// Whether there is a point or cell array of this name.
bool HasArray(vtkDataSet* data, const std::string& name);

/// Whether SetInputArrayToProcess has chosen an array, by its name or as an active attribute.
/// @param input  may have an array whose name MeansNoArray; may be null
bool IsChosen(vtkInformation* choice, vtkDataSet* input);

/// Returns the array that SetInputArrayToProcess(index, ...) names, or a null array if none is
/// chosen. A name that MeansNoArray chooses none, unless an array has that name. Throws
/// MissingArray if the chosen array does not exist. Throws InvalidInput if it is not numeric, is
/// neither point nor cell data, or has the wrong length. `property` is its name in the message.
InputArray FindInputArray(
  vtkAlgorithm* algorithm, int index, vtkDataSet* input, const std::string& property);

/// Throws InvalidInput unless an array has a tuple for each point or cell of the mesh.
/// @param subject  the array, in the message
/// @param kind     "points" or "cells"
void RequireLength(
  vtkAbstractArray* array, vtkIdType expected, const std::string& subject, const std::string& kind);

/// Returns the only array that can be chosen without being named. It is a point or cell array with
/// a number for each point or cell, and `fits`, called with its attributes, is true. Null array if
/// there is none or a second one.
InputArray OnlyArray(
  vtkDataSet* input, const std::function<bool(vtkDataArray*, vtkDataSetAttributes*)>& fits);

/// Whether a component of a tuple is NaN. Throws InvalidInput if this holds for some of the arrays
/// that it is joined from, but not for all.
bool IsUnknown(const InputArray& input, vtkIdType tuple);

/// Returns the array's values: rows are points, or triangles for cell data. Values that no polygon
/// uses are taken as 0. Throws InvalidInput naming the first point or cell of the surface with a
/// NaN or infinite value.
Field ReadField(const InputArray& input, const InputMesh& mesh, NaNs nans = NaNs::Refused);

} // namespace gridfem

#endif
