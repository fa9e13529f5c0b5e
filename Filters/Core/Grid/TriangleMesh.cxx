#include "Grid/TriangleMesh.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Base/RadixSort.h"
#include "Grid/PlaceNumbers.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace gridfem
{

namespace
{

bool IsValid(const TriangleMesh& mesh, Id triangle)
{
  const auto& corners = mesh.triangles[triangle];
  return std::all_of(corners.begin(), corners.end(),
    [&](Id corner)
    {
      return corner >= 0 && corner < static_cast<Id>(mesh.points.size()) &&
             mesh.points[corner].allFinite();
    });
}

/// Returns the first invalid triangle, or the number of triangles if all are valid.
Id FirstInvalid(const TriangleMesh& mesh, int threads)
{
  const Id count = static_cast<Id>(mesh.triangles.size());
  std::vector<Id> first((count + DefaultBlockSize - 1) / DefaultBlockSize, count);
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      while (begin < end && IsValid(mesh, begin))
      {
        ++begin;
      }
      first[(end - 1) / DefaultBlockSize] = begin < end ? begin : count;
    });
  return first.empty() ? 0 : *std::min_element(first.begin(), first.end());
}

} // namespace

void Validate(const TriangleMesh& mesh, int threads)
{
  const Id numberOfPoints = static_cast<Id>(mesh.points.size());
  for (std::size_t t = FirstInvalid(mesh, threads); t < mesh.triangles.size(); ++t)
  {
    for (const Id corner : mesh.triangles[t])
    {
      if (corner < 0 || corner >= numberOfPoints)
      {
        throw InvalidInput("Triangle " + std::to_string(t) + " uses point " +
                           std::to_string(corner) + ", but there are " +
                           std::to_string(numberOfPoints) + " points.");
      }
      if (!mesh.points[corner].allFinite())
      {
        throw InvalidInput(
          "Point " + std::to_string(corner) +
          " has a coordinate that is not a finite number. Remove it or clean the mesh first.");
      }
    }
  }
}

Array<Index> WeldCoincidentPoints(
  const std::vector<Vec3>& points, const std::vector<char>& used, int threads)
{
  RequireIndices(static_cast<double>(points.size()), "points");
  Array<Index> representative(points.size());
  std::iota(representative.begin(), representative.end(), Index{ 0 });
  // Equal points have equal hashes, so sorting by any part of the hash makes them neighbors.
  // Comparing coordinates separates the few other points among them.
  constexpr int HashBits = 34;
  const Array<SortEntry> entries = SortByKey(static_cast<Id>(points.size()), HashBits, threads,
    [&](Id begin, Id end, const auto& add)
    {
      for (Id i = begin; i < end; ++i)
      {
        if (used.empty() || used[i])
        {
          add(HashPlace(PlaceOf(points[i])) >> (64 - HashBits), i);
        }
      }
    });
  const auto isFirst = [&](Id k) { return k == 0 || entries[k].key != entries[k - 1].key; };
  const auto count = static_cast<Id>(entries.size());
  const auto weldToEarlier = [&](Id first, Id k)
  {
    for (Id other = first; other < k; ++other)
    {
      if (points[entries[other].item] == points[entries[k].item])
      {
        representative[entries[k].item] = representative[entries[other].item];
        break;
      }
    }
  };
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      for (Id first = begin; first < end; ++first)
      {
        for (Id k = first + 1; isFirst(first) && k < count && !isFirst(k); ++k)
        {
          weldToEarlier(first, k);
        }
      }
    });
  return representative;
}

std::vector<char> UsedPoints(const TriangleMesh& mesh, int threads)
{
  std::vector<char> used(mesh.points.size(), 0);
  ParallelRanges(static_cast<Id>(mesh.triangles.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        for (const Id corner : mesh.triangles[t])
        {
#pragma omp atomic write
          used[corner] = 1;
        }
      }
    });
  return used;
}

Bounds BoundsOf(const std::vector<Vec3>& points, const std::vector<char>& used, int threads)
{
  struct Box : Bounds
  {
    Box()
      : Bounds{ Vec3::Constant(std::numeric_limits<double>::infinity()),
          Vec3::Constant(-std::numeric_limits<double>::infinity()) }
    {
    }
    void operator+=(const Bounds& other)
    {
      low = low.cwiseMin(other.low);
      high = high.cwiseMax(other.high);
    }
  };
  return ParallelSum(static_cast<Id>(points.size()), threads, Box(),
    [&](Id begin, Id end)
    {
      Box part;
      for (Id i = begin; i < end; ++i)
      {
        if (used.empty() || used[i])
        {
          part += { points[i], points[i] };
        }
      }
      return part;
    });
}

double SurfaceArea(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& t : mesh.triangles)
  {
    const Vec3& a = mesh.points[t[0]];
    area += 0.5 * (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).norm();
  }
  return area;
}

} // namespace gridfem
