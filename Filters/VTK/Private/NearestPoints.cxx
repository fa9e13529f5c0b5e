#include "NearestPoints.h"

#include "Base/Errors.h"

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

/// A locator finds nothing near a point that is nowhere.
void RequireFinitePoints(vtkDataSet* places, const std::string& input)
{
  for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k)
  {
    const double* point = places->GetPoint(k);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      throw InvalidInput(input + ": point " + std::to_string(k) +
                         " has a NaN or infinite coordinate, so that no point is nearest to it.");
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
      points->InsertNextPoint(mesh.points[point].data());
      idOf.push_back(point);
    }
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
