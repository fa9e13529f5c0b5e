// Finds the known values at some points of a mesh: from an array with a mask or with NaN, or from
// another data set.
#ifndef GridFEM_GivenValues_h
#define GridFEM_GivenValues_h

#include "Input/InputArray.h"

#include <array>
#include <string>
#include <vector>

class vtkDataSet;

namespace gridfem
{

class SelectedPoints;

/// Throws MissingChoice if no array is chosen, and InvalidInput if it is cell data. The advice ends
/// the message about a missing choice.
void RequirePointArray(
  const InputArray& array, const std::string& property, const std::string& advice);

/// Returns the tuples without a NaN, at points that a triangle uses. With a mask or a selection,
/// the mask must be neither 0 nor NaN at the point, or the point must be selected. Throws
/// InvalidInput for an infinite value, a mask that does not fit, and if no value is known
/// (RequireKnown).
PointValues KnownValues(const InputArray& array, const InputArray& mask,
  const SelectedPoints& selection, const TriangleMesh& mesh);

/// Does the same if no value need be known, as on one of several ranks.
PointValues FindKnownValues(const InputArray& array, const InputArray& mask,
  const SelectedPoints& selection, const TriangleMesh& mesh);

/// The values of a table with the id of a point and its value in each row.
/// @param outside  gets the ids without a point on the surface, which do not count
PointValues TypedValues(
  const std::vector<std::array<double, 2>>& rows, const TriangleMesh& mesh, std::string& outside);

/// Throws InvalidInput if no value is known.
void RequireKnown(bool isAnyKnown, const InputArray& array);

/// Returns the array that SetInputArrayToProcess(index, ...) names among the arrays of places. Null
/// array if none is chosen. Throws InvalidInput as FindInputArray does, also if there is no such
/// array. MissingArray would ask whether another block of the surface has it.
InputArray FindArrayAmongPlaces(
  vtkAlgorithm* algorithm, int index, vtkDataSet* places, const std::string& property);

/// Returns the point array that index 2 chooses for a data set of places with values, or else its
/// array with the name that index 0 chooses, or else its active scalars. Throws InvalidInput if
/// there is none.
/// @param input, property  names of the input and of the array of index 0, for messages
InputArray FindArrayOfPlaces(vtkAlgorithm* algorithm, vtkDataSet* places, const std::string& input,
  const std::string& property);

/// Returns the values of all points of a data set, each at the nearest mesh point that a triangle
/// uses. NaN is unknown. Throws InvalidInput if no value is known or one is infinite.
/// @param input     its name for messages
/// @param warnings  one sentence if places are far from the surface (NearestPoints)
PointValues ValuesOfPlaces(const InputArray& array, const TriangleMesh& mesh, vtkDataSet* places,
  const std::string& input, std::vector<std::string>& warnings);

} // namespace gridfem

#endif
