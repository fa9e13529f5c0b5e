#include "Input/GivenValues.h"

#include "Input/NearestPoints.h"
#include "Input/SelectedPoints.h"

#include "Base/Errors.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <cmath>
#include <sstream>

namespace gridfem
{
namespace
{

/// Returns the values at some points, a row for each. Throws InvalidInput if one is not finite.
MultiVector FiniteValues(const InputArray& input, const std::vector<Id>& points)
{
  MultiVector values(static_cast<Id>(points.size()), input.array->GetNumberOfComponents());
  for (Id row = 0; row < values.rows(); ++row)
  {
    for (int c = 0; c < values.cols(); ++c)
    {
      values(row, c) = input.array->GetComponent(points[row], c);
      if (!std::isfinite(values(row, c)))
      {
        throw InvalidInput("Array '" + input.name + "' has a value that is not finite at point " +
                           std::to_string(points[row]) + ".");
      }
    }
  }
  return values;
}

bool IsChosen(Id point, const InputArray& mask, const SelectedPoints& selection)
{
  if (selection.IsGiven() && selection.Points()[point])
  {
    return true;
  }
  if (!mask.array)
  {
    return !selection.IsGiven();
  }
  const double value = mask.array->GetComponent(point, 0);
  return value != 0.0 && !std::isnan(value);
}

} // namespace

void RequirePointArray(
  const InputArray& array, const std::string& property, const std::string& advice)
{
  if (!array.array)
  {
    throw MissingChoice("Choose a " + property + ". " + advice);
  }
  if (array.association != FieldAssociation::Points)
  {
    throw InvalidInput(property + " '" + array.name +
                       "' must be a point array. Convert it with Cell Data to Point Data.");
  }
}

PointValues FindKnownValues(const InputArray& array, const InputArray& mask,
  const SelectedPoints& selection, const TriangleMesh& mesh)
{
  if (mask.array &&
      (mask.association != FieldAssociation::Points || mask.array->GetNumberOfComponents() != 1))
  {
    throw InvalidInput("Mask Array '" + mask.name + "' must be a point array with one component.");
  }
  const std::vector<char> used = UsedPoints(mesh);
  PointValues given;
  for (Id point = 0; point < static_cast<Id>(used.size()); ++point)
  {
    if (used[point] && IsChosen(point, mask, selection) && !IsUnknown(array, point))
    {
      given.points.push_back(point);
    }
  }
  given.values = FiniteValues(array, given.points);
  return given;
}

PointValues TypedValues(
  const std::vector<std::array<double, 2>>& rows, const TriangleMesh& mesh, std::string& outside)
{
  const std::vector<char> used = UsedPoints(mesh);
  PointValues given;
  std::vector<double> values;
  for (const auto& [id, value] : rows)
  {
    if (!std::isfinite(value))
    {
      throw InvalidInput("Known Values has a value that is not finite.");
    }
    const bool isId = id >= 0.0 && id < static_cast<double>(used.size()) && std::floor(id) == id;
    if (isId && used[static_cast<std::size_t>(id)])
    {
      given.points.push_back(static_cast<Id>(id));
      values.push_back(value);
    }
    else
    {
      std::ostringstream text;
      text << (outside.empty() ? "" : ", ") << id;
      outside += text.str();
    }
  }
  given.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Id>(values.size()));
  return given;
}

void RequireKnown(bool isAnyKnown, const InputArray& array)
{
  if (!isAnyKnown)
  {
    throw InvalidInput("No value of '" + array.name +
                       "' is known at a point of a polygon: all are NaN, masked, or not selected.");
  }
}

PointValues KnownValues(const InputArray& array, const InputArray& mask,
  const SelectedPoints& selection, const TriangleMesh& mesh)
{
  PointValues given = FindKnownValues(array, mask, selection, mesh);
  RequireKnown(!given.points.empty(), array);
  return given;
}

InputArray FindArrayAmongPlaces(
  vtkAlgorithm* algorithm, int index, vtkDataSet* places, const std::string& property)
{
  try
  {
    InputArray array = FindInputArray(algorithm, index, places, property);
    array.isOfSurface = false;
    return array;
  }
  catch (const MissingArray& error)
  {
    throw InvalidInput(error.what());
  }
}

InputArray FindArrayOfPlaces(vtkAlgorithm* algorithm, vtkDataSet* places, const std::string& input,
  const std::string& property)
{
  InputArray array = FindArrayAmongPlaces(algorithm, 2, places, "SourceArray");
  if (!array.array)
  {
    array =
      FindArrayAmongPlaces(algorithm, 0, places, "In the input " + input + ", the " + property);
  }
  vtkDataArray* scalars = places->GetPointData()->GetScalars();
  if (!array.array && scalars)
  {
    array.array = scalars;
    array.name = scalars->GetName() ? scalars->GetName() : "";
    RequireLength(scalars, places->GetNumberOfPoints(),
      "In the input " + input + ", the " + property + " '" + array.name + "'", "points");
  }
  RequirePointArray(
    array, property, "The input " + input + " has no active scalars to use instead.");
  return array;
}

PointValues ValuesOfPlaces(const InputArray& array, const TriangleMesh& mesh, vtkDataSet* places,
  const std::string& input, std::vector<std::string>& warnings)
{
  if (places->GetNumberOfPoints() == 0)
  {
    throw InvalidInput("The input " + input + " has no points.");
  }
  const std::vector<Id> nearest = NearestPoints(mesh, places, input, warnings);
  std::vector<Id> known;
  PointValues given;
  for (Id place = 0; place < static_cast<Id>(nearest.size()); ++place)
  {
    if (!IsUnknown(array, place))
    {
      known.push_back(place);
      given.points.push_back(nearest[place]);
    }
  }
  if (known.empty())
  {
    throw InvalidInput(
      "No value of '" + array.name + "' of the input " + input + " is known: all are NaN.");
  }
  given.values = FiniteValues(array, known);
  return given;
}

} // namespace gridfem
