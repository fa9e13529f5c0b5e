#include "SourcePoints.h"

#include "Base/Errors.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gridfem
{
namespace
{

/// A locator finds nothing near a point that is nowhere.
void RequireFinitePoints(vtkDataSet* places)
{
  for (vtkIdType k = 0; places && k < places->GetNumberOfPoints(); ++k)
  {
    const double* point = places->GetPoint(k);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      throw InvalidInput("Sources: point " + std::to_string(k) +
                         " has a NaN or infinite coordinate, so that no point is nearest to it.");
    }
  }
}

} // namespace

std::vector<Id> SourcePoints(
  const TriangleMesh& mesh, const std::vector<Id>& ids, vtkDataSet* places)
{
  const std::vector<char> used = UsedPoints(mesh);
  for (const Id id : ids)
  {
    if (id < 0 || id >= static_cast<Id>(used.size()) || !used[id])
    {
      throw InvalidInput(
        "SourcePointIds: " + std::to_string(id) + " is not a point of a polygon of the mesh.");
    }
  }
  std::vector<Id> sources = ids;
  RequireFinitePoints(places);
  if (places && places->GetNumberOfPoints() > 0)
  {
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
    for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k)
    {
      sources.push_back(idOf[locator->FindClosestPoint(places->GetPoint(k))]);
    }
  }
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  return sources;
}

} // namespace gridfem
