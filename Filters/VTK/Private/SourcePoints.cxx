#include "SourcePoints.h"

#include "NearestPoints.h"

#include "Base/Errors.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <string>

namespace gridfem
{

std::vector<Id> SourcePoints(
  const TriangleMesh& mesh, const std::vector<Id>& ids, vtkDataSet* places)
{
  const std::vector<char> used = UsedPoints(mesh);
  for (const Id id : ids)
  {
    if (id < 0 || id >= static_cast<Id>(used.size()) || !used[id])
    {
      throw InvalidInput(
        "Source Point Ids: no polygon of the mesh has a point " + std::to_string(id) + ".");
    }
  }
  std::vector<Id> sources = ids;
  if (places && places->GetNumberOfPoints() > 0)
  {
    const std::vector<Id> nearest = NearestPoints(mesh, places, "Sources");
    sources.insert(sources.end(), nearest.begin(), nearest.end());
  }
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  return sources;
}

} // namespace gridfem
