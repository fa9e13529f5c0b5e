// Arrays chosen by the user as fields that Core integrates.
#ifndef GridFEM_InputArray_h
#define GridFEM_InputArray_h

#include "Base/Errors.h"
#include "InputMesh.h"
#include "Solvers/GivenField.h"

#include <functional>
#include <string>
#include <utility>

class vtkAlgorithm;
class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;

namespace gridfem
{

/// An array of the input; without one, `array` is null.
struct InputArray
{
  vtkDataArray* array = nullptr;
  FieldAssociation association = FieldAssociation::Points; // Triangles: cell data
  std::string name;
};

/// The input lacks the chosen array.
struct MissingArray : InvalidInput
{
  MissingArray(const std::string& message, std::string name)
    : InvalidInput(message), array(std::move(name))
  {
  }
  std::string array;
};

/// The array that SetInputArrayToProcess(index, ...) names, null array when none is chosen (an
/// empty name or "None", unless an array has that name). Throws MissingArray when the chosen array
/// does not exist, InvalidInput when it is not numeric, is neither point nor cell data, or has the
/// wrong length; `property` is the name the message gives.
InputArray FindInputArray(
  vtkAlgorithm* algorithm, int index, vtkDataSet* input, const std::string& property);

/// What can be chosen without being asked: the only point or cell array of numbers that has a value
/// for each and for which `fits`, called with the attributes that it is of, is true; null array
/// when there is none or a second one.
InputArray OnlyArray(
  vtkDataSet* input, const std::function<bool(vtkDataArray*, vtkDataSetAttributes*)>& fits);

/// The array's values: rows are points, or triangles for cell data. Throws InvalidInput naming the
/// first point or cell of the surface with a NaN or infinite value; values that no polygon uses
/// are taken as 0.
Field ReadField(const InputArray& input, const InputMesh& mesh, NaNs nans = NaNs::Refused);

} // namespace gridfem

#endif
