#include "Grid/SurfaceSides.h"

#include "Grid/TriangleArea.h"

#include <utility>

namespace gridfem
{
namespace
{

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
      if (neighbor.triangle == Neighbor::None)
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
      isClosed = isClosed && neighbor.triangle != Neighbor::None;
    }
  }
  return (isClosed && !facesAlike ? volume : area) < 0.0 ? -1 : 1;
}

} // namespace

Neighbors FindNeighbors(const std::vector<TriangleSide>& sides, std::size_t triangles)
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
        neighbors[a.triangle][a.corner] = { b.triangle, b.corner, facesAlike };
        neighbors[b.triangle][b.corner] = { a.triangle, a.corner, facesAlike };
      }
    });
  return neighbors;
}

std::vector<SurfaceComponent> FindComponents(
  const TriangleMesh& mesh, const Neighbors& neighbors, std::vector<signed char>& side)
{
  side.assign(mesh.triangles.size(), 0);
  std::vector<SurfaceComponent> components;
  for (Id first = 0; first < static_cast<Id>(mesh.triangles.size()); ++first)
  {
    if (side[first] != 0)
    {
      continue;
    }
    SurfaceComponent component;
    component.triangles = { first };
    side[first] = 1;
    component.hasTwoSides = SpreadSide(neighbors, side, component.triangles);
    const int factor = SideOf(mesh, neighbors, component.triangles, side);
    for (const Id t : component.triangles)
    {
      side[t] = static_cast<signed char>(factor * side[t]);
    }
    components.push_back(std::move(component));
  }
  return components;
}

} // namespace gridfem
