#include "Distance/StraightDistance.h"

#include "Base/Parallel.h"
#include "Base/RadixSort.h"

#include <algorithm>

namespace gridfem
{
namespace
{

bool AreAllSources(const std::array<Id, 3>& corner, const std::vector<char>& isSource)
{
  return isSource[corner[0]] && isSource[corner[1]] && isSource[corner[2]];
}

/// Adds the sources that are corners of a triangle outside of all regions.
void AppendPoints(
  const TriangleMesh& mesh, const std::vector<char>& isSource, std::vector<Segment>& rim)
{
  std::vector<char> isOnRim(isSource.size(), 0);
  for (const auto& corner : mesh.triangles)
  {
    const bool isInside = AreAllSources(corner, isSource);
    for (const Id point : corner)
    {
      isOnRim[point] = isOnRim[point] || (isSource[point] && !isInside);
    }
  }
  for (std::size_t point = 0; point < isOnRim.size(); ++point)
  {
    if (isOnRim[point])
    {
      rim.push_back({ mesh.points[point], mesh.points[point] });
    }
  }
}

/// Adds the edges of regions that belong to one triangle, or to a triangle outside as well.
void AppendEdges(const TriangleMesh& mesh, const std::vector<char>& isSource, int threads,
  std::vector<Segment>& rim)
{
  int bits = 1;
  while ((std::size_t(1) << bits) < mesh.points.size())
  {
    ++bits;
  }
  const auto visit = [&](Id begin, Id end, auto&& add)
  {
    for (Id t = begin; t < end; ++t)
    {
      const auto& corner = mesh.triangles[t];
      for (int k = 0; k < 3; ++k)
      {
        const auto [low, high] = std::minmax({ corner[k], corner[(k + 1) % 3] });
        if (isSource[low] && isSource[high])
        {
          add((std::uint64_t(low) << bits) | std::uint64_t(high),
            AreAllSources(corner, isSource) ? 1 : 0);
        }
      }
    }
  };
  const Array<SortEntry> sides =
    SortByKey(static_cast<Id>(mesh.triangles.size()), 2 * bits, threads, visit);
  for (std::size_t first = 0; first < sides.size();)
  {
    std::size_t inside = 0;
    std::size_t last = first;
    for (; last < sides.size() && sides[last].key == sides[first].key; ++last)
    {
      inside += sides[last].item;
    }
    const std::uint64_t key = sides[first].key;
    if (inside > 0 && (last - first == 1 || inside < last - first))
    {
      rim.push_back(
        { mesh.points[key >> bits], mesh.points[key & ((std::uint64_t(1) << bits) - 1)] });
    }
    first = last;
  }
}

} // namespace

std::vector<double> DistancesThroughSpace(
  const TriangleMesh& mesh, std::vector<Segment> segments, int threads)
{
  std::vector<double> distance(mesh.points.size(), 0.0);
  if (segments.empty())
  {
    return distance;
  }
  const SegmentTree tree(std::move(segments));
  ParallelRanges(static_cast<Id>(distance.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        distance[point] = tree.DistanceFrom(mesh.points[point]);
      }
    });
  return distance;
}

std::vector<Segment> RimOfSources(
  const TriangleMesh& mesh, const std::vector<char>& isSource, int threads)
{
  std::vector<Segment> rim;
  AppendPoints(mesh, isSource, rim);
  AppendEdges(mesh, isSource, threads, rim);
  return rim;
}

} // namespace gridfem
