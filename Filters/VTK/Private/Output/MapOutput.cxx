#include "Output/MapOutput.h"

#include "Input/ModeReader.h"
#include "Output/InterpolatedArrays.h"
#include "Output/SolverOutput.h"
#include "Pipeline/Allocation.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

constexpr const char* ColorsName = "MatchingColors";

/// Returns a color for each place in a box. A place with NaN is gray.
template<class PlaceOf>
vtkSmartPointer<vtkUnsignedCharArray> ColorsAt(
  const double* bounds, vtkIdType count, PlaceOf&& placeOf)
{
  auto colors = NewArray<vtkUnsignedCharArray>(ColorsName, count, 3);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const std::array<double, 3> place = placeOf(k);
    for (int axis = 0; axis < 3; ++axis)
    {
      constexpr double Dark = 80.0;
      constexpr double Bright = 255.0;
      const double side = bounds[2 * axis + 1] - bounds[2 * axis];
      const double share = side > 0.0 ? (place[axis] - bounds[2 * axis]) / side : 0.5;
      const double known = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.5;
      colors->SetTypedComponent(
        k, axis, static_cast<unsigned char>(std::lround(Dark + (Bright - Dark) * known)));
    }
  }
  return colors;
}

std::vector<TrianglePlace> PlacesOf(const FunctionalMap& map)
{
  std::vector<TrianglePlace> places(map.corners.size());
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    places[k].corners = map.corners[k];
    for (int c = 0; c < 3 && map.corners[k][0] >= 0; ++c)
    {
      places[k].weights[c] = map.weights(static_cast<Id>(k), c);
    }
  }
  return places;
}

/// Adds the point arrays of the reference, but neither its modes nor arrays that name its points.
void TransferArrays(const FunctionalMap& map, vtkPolyData* reference, vtkPointData* output)
{
  const std::vector<TrianglePlace> places = PlacesOf(map);
  vtkNew<vtkPolyData> copy;
  copy->ShallowCopy(reference);
  if (CarriesModes(copy))
  {
    RemoveModes(copy);
  }
  vtkPointData* arrays = copy->GetPointData();
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = arrays->GetAbstractArray(k);
    if (array->GetName() && !BelongsToItsPlaces(array, arrays) && array != arrays->GetNormals())
    {
      output->AddArray(ValuesAtPlaces(array, places));
    }
  }
}

} // namespace

void RequireArrays(vtkPolyData* reference)
{
  vtkPointData* arrays = reference->GetPointData();
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    RequireLength(arrays->GetAbstractArray(k), reference->GetNumberOfPoints(), "points");
  }
}

void WriteMap(const FunctionalMap& map, vtkPolyData* reference, vtkPolyData* output)
{
  vtkPointData* points = output->GetPointData();
  TransferArrays(map, reference, points);
  points->AddArray(MakeIdArray("ReferenceCorners", map.corners));
  points->AddArray(MakePointArray("ReferenceWeights", map.weights, VTK_DOUBLE));
  points->AddArray(MakePointArray("ReferencePlace", map.places, VTK_DOUBLE));
  points->AddArray(MakePointArray("Mismatch", map.mismatch, VTK_DOUBLE));
  points->AddArray(ColorsAt(reference->GetBounds(), output->GetNumberOfPoints(),
    [&](vtkIdType k) -> std::array<double, 3> {
      return { map.places(k, 0), map.places(k, 1), map.places(k, 2) };
    }));
  points->SetActiveScalars(ColorsName);
  AddFieldNumber(output, "MeanMismatch", map.meanMismatch);
  output->GetFieldData()->AddArray(MakePointArray("FunctionalMap", map.matrix, VTK_DOUBLE));
}

void AddMatchingColors(vtkPolyData* reference, vtkPolyData* output)
{
  output->GetPointData()->AddArray(ColorsAt(reference->GetBounds(), output->GetNumberOfPoints(),
    [&](vtkIdType k)
    {
      std::array<double, 3> place{};
      reference->GetPoint(k, place.data());
      return place;
    }));
  output->GetPointData()->SetActiveScalars(ColorsName);
}

} // namespace gridfem
