#include "Input/SourcePoints.h"

#include "Input/NearestPoints.h"

#include "Distance/NearestSource.h"

#include "vtkDataSet.h"

#include <algorithm>

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
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  return sources;
}

} // namespace gridfem
