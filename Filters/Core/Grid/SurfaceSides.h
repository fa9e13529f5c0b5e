// Which way the triangles of a surface face, and their neighbors across edges.
#ifndef GridFEM_SurfaceSides_h
#define GridFEM_SurfaceSides_h

#include "Grid/TriangleSides.h"

#include <array>
#include <vector>

namespace gridfem
{

/// The neighbor across an edge of two triangles. Across other edges, `triangle` is None.
struct Neighbor
{
  static constexpr Id None = -1;

  Id triangle = None;
  int corner = 0;         // where the edge begins in the neighbor
  bool facesAlike = true; // the two triangles run along the edge in opposite directions
};

using Neighbors = std::vector<std::array<Neighbor, 3>>; // of the sides of each triangle

/// @param sides  sorted, of SortedSides
Neighbors FindNeighbors(const std::vector<TriangleSide>& sides, std::size_t triangles);

/// Triangles that are connected across edges of two triangles.
struct SurfaceComponent
{
  std::vector<Id> triangles; // the first is the lowest
  bool hasTwoSides = true;
};

/// Returns the components in the order of their first triangles. A triangle with two equal corners
/// is a component of its own.
/// @param side  receives 1 or -1 for each triangle: -1 if it faces against its component. A
///   component faces as most of its area does. A closed component whose triangles face different
///   ways faces outward. Neighbors of a one-sided component cannot all face alike.
std::vector<SurfaceComponent> FindComponents(
  const TriangleMesh& mesh, const Neighbors& neighbors, std::vector<signed char>& side);

} // namespace gridfem

#endif
