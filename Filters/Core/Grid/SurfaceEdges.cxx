#include "Grid/SurfaceEdges.h"

#include "Base/Errors.h"
#include "Grid/CornerClasses.h"
#include "Grid/TriangleArea.h"
#include "Grid/TriangleSides.h"

#include <algorithm>
#include <string>

namespace gridfem
{
namespace
{

constexpr Id None = -1;

/// The neighbor across an edge of two triangles. Across other edges, `triangle` is None.
struct Neighbor
{
  Id triangle = None;
  bool facesAlike = true; // the two triangles run along the edge in opposite directions
};

using Neighbors = std::vector<std::array<Neighbor, 3>>;

void SortByTriangle(std::vector<TriangleEdge>& edges)
{
  std::sort(edges.begin(), edges.end(),
    [](const TriangleEdge& a, const TriangleEdge& b)
    { return a.triangle != b.triangle ? a.triangle < b.triangle : a.corner < b.corner; });
}

Neighbors Classify(
  const std::vector<TriangleSide>& sides, std::size_t triangles, SurfaceEdges& edges)
{
  Neighbors neighbors(triangles);
  ForEachEdge(sides,
    [&](const TriangleSide* side, Id count)
    {
      if (count == 2)
      {
        const TriangleEdge& a = side[0].edge;
        const TriangleEdge& b = side[1].edge;
        const bool facesAlike = side[0].isUpwards != side[1].isUpwards;
        neighbors[a.triangle][a.corner] = { b.triangle, facesAlike };
        neighbors[b.triangle][b.corner] = { a.triangle, facesAlike };
      }
      else
      {
        (count == 1 ? edges.boundary : edges.branching).push_back(side->edge);
      }
    });
  SortByTriangle(edges.boundary);
  SortByTriangle(edges.branching);
  return neighbors;
}

/// Spreads the side of the first triangle over its component.
/// @param members  the first triangle; receives all triangles of the component
/// @return whether the component has two sides
bool SpreadSide(
  const Neighbors& neighbors, std::vector<signed char>& side, std::vector<Id>& members)
{
  bool hasTwoSides = true;
  for (std::size_t k = 0; k < members.size(); ++k)
  {
    const Id triangle = members[k];
    for (const Neighbor& neighbor : neighbors[triangle])
    {
      if (neighbor.triangle == None)
      {
        continue;
      }
      const auto wanted =
        static_cast<signed char>(neighbor.facesAlike ? side[triangle] : -side[triangle]);
      if (side[neighbor.triangle] == 0)
      {
        side[neighbor.triangle] = wanted;
        members.push_back(neighbor.triangle);
      }
      hasTwoSides = hasTwoSides && side[neighbor.triangle] == wanted;
    }
  }
  return hasTwoSides;
}

/// Six times the volume of the cone from a point to a triangle.
double ConeOver(const TriangleMesh& mesh, Id triangle, const Vec3& tip)
{
  const std::array<Id, 3>& corner = mesh.triangles[triangle];
  const Vec3 a = mesh.points[corner[0]] - tip;
  const Vec3 b = mesh.points[corner[1]] - tip;
  return a.cross(b).dot(mesh.points[corner[2]] - tip);
}

/// Returns 1 if a component faces as the side of its first triangle, or -1 if it faces the other
/// way.
int SideOf(const TriangleMesh& mesh, const Neighbors& neighbors, const std::vector<Id>& members,
  const std::vector<signed char>& side)
{
  double area = 0.0;
  double volume = 0.0;
  bool isClosed = true;
  bool facesAlike = true;
  const Vec3& tip = mesh.points[mesh.triangles[members.front()][0]];
  for (const Id t : members)
  {
    area += side[t] * AreaOf(mesh, t);
    volume += side[t] * ConeOver(mesh, t, tip);
    facesAlike = facesAlike && side[t] == side[members.front()];
    for (const Neighbor& neighbor : neighbors[t])
    {
      isClosed = isClosed && neighbor.triangle != None;
    }
  }
  return (isClosed && !facesAlike ? volume : area) < 0.0 ? -1 : 1;
}

void FindSides(const TriangleMesh& mesh, const Neighbors& neighbors, SurfaceEdges& edges)
{
  edges.side.assign(mesh.triangles.size(), 0);
  std::vector<char> isSeen(mesh.triangles.size(), 0);
  std::vector<Id> members;
  for (Id first = 0; first < static_cast<Id>(mesh.triangles.size()); ++first)
  {
    if (isSeen[first])
    {
      continue;
    }
    members.assign(1, first);
    edges.side[first] = 1;
    const bool hasTwoSides = SpreadSide(neighbors, edges.side, members);
    const int factor = hasTwoSides ? SideOf(mesh, neighbors, members, edges.side) : 0;
    for (const Id t : members)
    {
      edges.side[t] = static_cast<signed char>(factor * edges.side[t]);
      isSeen[t] = 1;
    }
    ++edges.numberOfComponents;
    edges.numberOfOneSided += hasTwoSides ? 0 : 1;
  }
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
  const Neighbors neighbors = Classify(SortedSides(mesh, pointClass), mesh.triangles.size(), edges);
  FindSides(mesh, neighbors, edges);
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
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

} // namespace gridfem
