#include "Input/NearestPoints.h"

#include "Base/Errors.h"
#include "Pipeline/Allocation.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <cmath>

namespace gridfem
{
namespace
{

/// Refuses points that are not finite, because a locator finds nothing near them.
void RequireFinitePoints(vtkDataSet* places, const std::string& input)
{
  for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k)
  {
    const double* point = places->GetPoint(k);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      throw InvalidInput(
        input + ": point " + std::to_string(k) +
        " has a NaN or infinite coordinate, so no point of the mesh is nearest to it.");
    }
  }
}

} // namespace

std::vector<Id> NearestPoints(
  const TriangleMesh& mesh, vtkDataSet* places, const std::string& input)
{
  RequireFinitePoints(places, input);
  const std::vector<char> used = UsedPoints(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<Id> idOf;
  for (Id point = 0; point < static_cast<Id>(used.size()); ++point)
  {
    if (used[point])
    {
      idOf.push_back(point);
    }
  }
  SetTuples(points->GetData(), static_cast<vtkIdType>(idOf.size()));
  for (std::size_t k = 0; k < idOf.size(); ++k)
  {
    points->SetPoint(static_cast<vtkIdType>(k), mesh.points[idOf[k]].data());
  }
  vtkNew<vtkPolyData> candidates;
  candidates->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(candidates);
  locator->BuildLocator();
  std::vector<Id> nearest;
  for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k)
  {
    nearest.push_back(idOf[locator->FindClosestPoint(places->GetPoint(k))]);
  }
  return nearest;
}

} // namespace gridfem
