#include "Grid/SurfaceEdges.h"

#include "Base/Errors.h"
#include "Base/SortEachOnce.h"
#include "Grid/CornerClasses.h"
#include "Grid/SurfaceSides.h"
#include "Grid/TriangleSides.h"

#include <algorithm>
#include <string>

namespace gridfem
{
namespace
{

void SortByTriangle(std::vector<TriangleEdge>& edges)
{
  std::sort(edges.begin(), edges.end(),
    [](const TriangleEdge& a, const TriangleEdge& b)
    { return a.triangle != b.triangle ? a.triangle < b.triangle : a.corner < b.corner; });
}

void FindBorders(const std::vector<TriangleSide>& sides, SurfaceEdges& edges)
{
  ForEachEdge(sides,
    [&](const TriangleSide* side, Id count)
    {
      if (count != 2)
      {
        (count == 1 ? edges.boundary : edges.branching).push_back(side->edge);
      }
    });
  SortByTriangle(edges.boundary);
  SortByTriangle(edges.branching);
}

void RequireTriangle(Id triangle, const TriangleMesh& mesh)
{
  if (triangle < 0 || triangle >= static_cast<Id>(mesh.triangles.size()))
  {
    throw InvalidInput("There is no triangle " + std::to_string(triangle) + ".");
  }
}

} // namespace

void RequireEdges(const std::vector<TriangleEdge>& edges, const TriangleMesh& mesh)
{
  for (const TriangleEdge& edge : edges)
  {
    RequireTriangle(edge.triangle, mesh);
  }
}

void RequireSegments(const std::vector<TriangleSegment>& segments, const TriangleMesh& mesh)
{
  for (const TriangleSegment& segment : segments)
  {
    RequireTriangle(segment.triangle, mesh);
  }
}

std::vector<TriangleSegment> SegmentsOf(
  const std::vector<TriangleEdge>& edges, const TriangleMesh& mesh)
{
  RequireEdges(edges, mesh);
  std::vector<TriangleSegment> segments;
  segments.reserve(edges.size());
  for (const TriangleEdge& edge : edges)
  {
    segments.push_back(
      { edge.triangle, Vec3::Unit(edge.corner), Vec3::Unit((edge.corner + 1) % 3) });
  }
  return segments;
}

std::vector<TriangleSide> SortedSides(const TriangleMesh& mesh, const Array<Index>& pointClass)
{
  const CornerClasses classes(mesh, pointClass);
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const std::array<Index, 3> point = classes(static_cast<Id>(t));
    if (IsDegenerate(point))
    {
      continue;
    }
    for (int k = 0; k < 3; ++k)
    {
      const Index a = point[k];
      const Index b = point[(k + 1) % 3];
      sides.push_back({ std::min(a, b), std::max(a, b), { static_cast<Id>(t), k }, a < b });
    }
  }
  std::sort(sides.begin(), sides.end(),
    [](const TriangleSide& a, const TriangleSide& b)
    {
      return a.low != b.low                       ? a.low < b.low
             : a.high != b.high                   ? a.high < b.high
             : a.edge.triangle != b.edge.triangle ? a.edge.triangle < b.edge.triangle
                                                  : a.edge.corner < b.edge.corner;
    });
  return sides;
}

bool SurfaceEdges::IsOriented() const
{
  return std::all_of(side.begin(), side.end(), [](signed char own) { return own == 1; });
}

SurfaceEdges FindSurfaceEdges(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads)
{
  const Array<Index> pointClass =
    weldCoincidentPoints ? WeldCoincidentPoints(mesh.points, {}, threads) : Array<Index>();
  SurfaceEdges edges;
  const std::vector<TriangleSide> sides = SortedSides(mesh, pointClass);
  FindBorders(sides, edges);
  const Neighbors neighbors = FindNeighbors(sides, mesh.triangles.size());
  for (const SurfaceComponent& component : FindComponents(mesh, neighbors, edges.side))
  {
    ++edges.numberOfComponents;
    if (component.hasTwoSides)
    {
      continue;
    }
    ++edges.numberOfOneSided;
    for (const Id t : component.triangles)
    {
      edges.side[t] = 0;
    }
  }
  return edges;
}

std::vector<Id> EndsOf(const std::vector<TriangleEdge>& edges, const TriangleMesh& mesh)
{
  std::vector<Id> ends;
  for (const TriangleEdge& edge : edges)
  {
    const auto own = edge.Ends(mesh);
    ends.insert(ends.end(), own.begin(), own.end());
  }
  SortEachOnce(ends);
  return ends;
}

} // namespace gridfem
