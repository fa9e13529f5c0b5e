// Values that are known at some points of a mesh: from an array with a mask or with NaN, or from
// another data set.
#ifndef GridFEM_GivenValues_h
#define GridFEM_GivenValues_h

#include "InputArray.h"

#include <string>
#include <vector>

class vtkDataSet;

namespace gridfem
{

class SelectedPoints;

/// Throws InvalidInput when no array is chosen, saying what it should hold, or it is cell data.
void RequirePointArray(
  const InputArray& array, const std::string& property, const std::string& wanted);

/// Tuples without a NaN, at points that a triangle uses and where the mask is neither 0 nor NaN, or
/// that are selected; at all points without mask and selection. Throws InvalidInput for an infinite
/// value, a mask that does not fit, and when nothing is known (RequireKnown).
PointValues KnownValues(const InputArray& array, const InputArray& mask,
  const SelectedPoints& selection, const TriangleMesh& mesh);

/// The same where nothing may be known, as on one of several ranks.
PointValues FindKnownValues(const InputArray& array, const InputArray& mask,
  const SelectedPoints& selection, const TriangleMesh& mesh);

/// Throws InvalidInput when nothing is known.
void RequireKnown(bool isAnyKnown, const InputArray& array);

/// The values of all points of a data set, each at the nearest point of the mesh that a triangle
/// uses. Throws InvalidInput when there are none or one is not finite.
PointValues ValuesOfPlaces(const InputArray& array, const TriangleMesh& mesh, vtkDataSet* places);

} // namespace gridfem

#endif
