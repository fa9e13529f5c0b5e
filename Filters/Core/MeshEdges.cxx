#include "MeshEdges.h"

#include "Parallel.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{

PlaneRange PlanesBetween(double a, double b)
{
  const int first = static_cast<int>(std::floor(std::min(a, b))) + 1;
  const int last = static_cast<int>(std::ceil(std::max(a, b))) - 1;
  return { first, std::max(0, last - first + 1) };
}

namespace
{

struct HalfEdge
{
  Id high; // higher end
  Id slot; // 3 * triangle + local edge
};

/// Half edges grouped by their lower end, sorted by the higher one: equal edges are neighbours.
struct HalfEdgeTable
{
  std::vector<Id> begin; // per point
  std::vector<HalfEdge> halfEdges;
};

HalfEdgeTable GroupHalfEdges(
  const std::vector<std::array<Id, 3>>& triangles, const std::vector<Id>& pointClass, int threads)
{
  HalfEdgeTable table;
  table.begin.assign(pointClass.size() + 1, 0);
  const auto ends = [&](std::size_t t, int edge)
  {
    const Id a = pointClass[triangles[t][edge]];
    const Id b = pointClass[triangles[t][(edge + 1) % 3]];
    return std::array<Id, 2>{ std::min(a, b), std::max(a, b) };
  };
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      ++table.begin[ends(t, edge)[0]];
    }
  }
  ExclusiveScan(table.begin);
  table.halfEdges.resize(3 * triangles.size());
  std::vector<Id> next(table.begin.begin(), table.begin.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const auto [low, high] = ends(t, edge);
      table.halfEdges[next[low]++] = { high, static_cast<Id>(3 * t + edge) };
    }
  }
  ParallelRanges(static_cast<Id>(pointClass.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        std::sort(table.halfEdges.begin() + table.begin[point],
          table.halfEdges.begin() + table.begin[point + 1],
          [](const HalfEdge& a, const HalfEdge& b)
          { return a.high != b.high ? a.high < b.high : a.slot < b.slot; });
      }
    });
  return table;
}

} // namespace

MeshEdges BuildMeshEdges(const std::vector<std::array<Id, 3>>& triangles,
  const std::vector<Id>& pointClass, const std::vector<Vec3>& position, int threads)
{
  const HalfEdgeTable table = GroupHalfEdges(triangles, pointClass, threads);
  MeshEdges edges;
  edges.ofTriangle.resize(triangles.size());
  edges.ends.reserve(3 * triangles.size() / 2 + 1);
  for (std::size_t point = 0; point < pointClass.size(); ++point)
  {
    for (Id k = table.begin[point]; k < table.begin[point + 1]; ++k)
    {
      const HalfEdge& half = table.halfEdges[k];
      if (k == table.begin[point] || table.halfEdges[k - 1].high != half.high)
      {
        edges.ends.push_back({ static_cast<Id>(point), half.high });
      }
      edges.ofTriangle[half.slot / 3][half.slot % 3] = static_cast<Id>(edges.ends.size()) - 1;
    }
  }
  edges.cutBegin.assign(edges.ends.size() + 1, 0);
  ParallelRanges(static_cast<Id>(edges.ends.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id e = begin; e < end; ++e)
      {
        const Vec3& a = position[edges.ends[e][0]];
        const Vec3& b = position[edges.ends[e][1]];
        for (int axis = 0; axis < 3; ++axis)
        {
          edges.cutBegin[e] += PlanesBetween(a[axis], b[axis]).count;
        }
      }
    });
  ExclusiveScan(edges.cutBegin);
  return edges;
}

} // namespace gridfem
