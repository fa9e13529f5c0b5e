#include "Grid/CopiedTriangles.h"

#include "Base/Errors.h"
#include "Base/Grouping.h"
#include "Grid/CornerClasses.h"

#include <algorithm>
#include <utility>

namespace gridfem
{

std::vector<char> CopiedTriangles(
  const TriangleMesh& mesh, const Array<Index>& pointClass, int threads)
{
  const CornerClasses classes(mesh, pointClass);
  const auto sorted = [&](Id triangle)
  {
    std::array<Index, 3> corners = classes(triangle);
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  RequireIndices(static_cast<double>(mesh.triangles.size()), "triangles");
  Array<Index> lowest(mesh.triangles.size());
  ParallelRanges(static_cast<Id>(lowest.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        lowest[t] = sorted(t)[0];
      }
    });
  const Groups ofLowest = GroupItems(lowest, static_cast<Id>(mesh.points.size()), threads);
  std::vector<char> copies(mesh.triangles.size(), 0);
  const Id found = ParallelSum(static_cast<Id>(mesh.points.size()), threads, Id{ 0 },
    [&](Id begin, Id end)
    {
      Id count = 0;
      std::vector<std::pair<std::array<Index, 3>, Index>> around; // corners, triangle
      for (Id point = begin; point < end; ++point)
      {
        around.clear();
        for (Index k = ofLowest.begin[point]; k < ofLowest.begin[point + 1]; ++k)
        {
          const std::array<Index, 3> corners = sorted(ofLowest.item[k]);
          if (!IsDegenerate(corners))
          {
            around.emplace_back(corners, ofLowest.item[k]);
          }
        }
        std::sort(around.begin(), around.end()); // the first of equals is the first triangle
        for (std::size_t k = 1; k < around.size(); ++k)
        {
          if (around[k].first == around[k - 1].first)
          {
            copies[around[k].second] = 1;
            ++count;
          }
        }
      }
      return count;
    });
  return found > 0 ? copies : std::vector<char>();
}

Id DropCopies(TriangleMesh& mesh, std::vector<Id>& sourceCell, int threads)
{
  const std::vector<char> isCopy = CopiedTriangles(mesh, {}, threads);
  const auto given = static_cast<Id>(mesh.triangles.size());
  if (!isCopy.empty())
  {
    KeepTriangles(mesh, sourceCell, [&](std::size_t triangle) { return !isCopy[triangle]; });
  }
  return given - static_cast<Id>(mesh.triangles.size());
}

} // namespace gridfem
