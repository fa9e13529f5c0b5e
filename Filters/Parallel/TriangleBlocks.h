// Which cells of a coarse grid a triangle meets.
#ifndef GridFEM_TriangleBlocks_h
#define GridFEM_TriangleBlocks_h

#include "Grid/Grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gridfem
{

/// Whether a triangle meets a box around the origin; touching counts. Separating axes: the box's
/// three, the triangle's normal, and the nine products of edges. [Akenine-Möller 2001]
inline bool MeetsBox(const std::array<Vec3, 3>& corner, double halfSide)
{
  const auto isSeparated = [&](const Vec3& axis)
  {
    const double a = axis.dot(corner[0]);
    const double b = axis.dot(corner[1]);
    const double c = axis.dot(corner[2]);
    const double reach = halfSide * axis.cwiseAbs().sum();
    return std::min({ a, b, c }) > reach || std::max({ a, b, c }) < -reach;
  };
  const std::array<Vec3, 3> edge = { corner[1] - corner[0], corner[2] - corner[1],
    corner[0] - corner[2] };
  if (isSeparated(edge[0].cross(edge[1])))
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (isSeparated(Vec3::Unit(axis)) || isSeparated(Vec3::Unit(axis).cross(edge[0])) ||
        isSeparated(Vec3::Unit(axis).cross(edge[1])) ||
        isSeparated(Vec3::Unit(axis).cross(edge[2])))
    {
      return false;
    }
  }
  return true;
}

/// Calls body(key) for every block that comes as near to a triangle as `margin` along the axes.
/// @param side           of a block
/// @param blocksPerSide  of the grid
template<class Body>
void ForBlocksNear(
  const std::array<Vec3, 3>& corner, double side, int blocksPerSide, double margin, Body&& body)
{
  const Vec3 low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
  const Vec3 high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
  CellIndex first;
  CellIndex last;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto blockOf = [&](double x)
    { return std::clamp(static_cast<int>(std::floor(x / side)), 0, blocksPerSide - 1); };
    first[axis] = blockOf(low[axis] - margin);
    last[axis] = blockOf(high[axis] + margin);
  }
  if (first == last)
  {
    body(MortonEncode(first));
    return;
  }
  for (int k = first[2]; k <= last[2]; ++k)
  {
    for (int j = first[1]; j <= last[1]; ++j)
    {
      for (int i = first[0]; i <= last[0]; ++i)
      {
        const Vec3 centre = side * (Vec3(i, j, k) + Vec3::Constant(0.5));
        if (MeetsBox(
              { corner[0] - centre, corner[1] - centre, corner[2] - centre }, 0.5 * side + margin))
        {
          body(MortonEncode({ i, j, k }));
        }
      }
    }
  }
}

} // namespace gridfem

#endif
