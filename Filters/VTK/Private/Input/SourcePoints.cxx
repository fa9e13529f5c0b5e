#include "Input/SourcePoints.h"

#include "Input/NearestPoints.h"

#include "Base/SortEachOnce.h"
#include "Distance/NearestSource.h"

#include "vtkDataSet.h"

namespace gridfem
{

std::vector<Id> SourcePoints(const TriangleMesh& mesh, const std::vector<Id>& ids,
  vtkDataSet* places, std::vector<std::string>& warnings)
{
  RequireUsed("Source Point Ids", ids, mesh);
  std::vector<Id> sources = ids;
  if (places && places->GetNumberOfPoints() > 0)
  {
    const std::vector<Id> nearest = NearestPointsAlongLines(mesh, places, "Sources", warnings);
    sources.insert(sources.end(), nearest.begin(), nearest.end());
  }
  SortEachOnce(sources);
  return sources;
}

} // namespace gridfem
