// Finds the cells of a coarse grid that a triangle meets.
#ifndef GridFEM_TriangleBlocks_h
#define GridFEM_TriangleBlocks_h

#include "Grid/Grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gridfem
{

/// Whether a triangle meets a box around the origin; touching counts. It tests separating axes: the
/// box's three, the triangle's normal, and the nine products of edges. [Akenine-Möller 2001]
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

/// Blocks first .. last along each axis.
struct BlockBox
{
  CellIndex first{ 0, 0, 0 };
  CellIndex last{ -1, -1, -1 };

  bool operator==(const BlockBox& other) const
  {
    return first == other.first && last == other.last;
  }
};

/// The blocks within `margin`, along the axes, of the box around a triangle.
/// @param side           of a block
/// @param blocksPerSide  of the grid
inline BlockBox BoxNear(
  const std::array<Vec3, 3>& corner, double side, int blocksPerSide, double margin)
{
  const Vec3 low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
  const Vec3 high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
  BlockBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto blockOf = [&](double x)
    { return std::clamp(static_cast<int>(std::floor(x / side)), 0, blocksPerSide - 1); };
    box.first[axis] = blockOf(low[axis] - margin);
    box.last[axis] = blockOf(high[axis] + margin);
  }
  return box;
}

/// Calls body(index) for every block of a box.
template<class Body>
void ForBlocksOf(const BlockBox& box, Body&& body)
{
  for (int k = box.first[2]; k <= box.last[2]; ++k)
  {
    for (int j = box.first[1]; j <= box.last[1]; ++j)
    {
      for (int i = box.first[0]; i <= box.last[0]; ++i)
      {
        body(CellIndex{ i, j, k });
      }
    }
  }
}

/// Calls body(key) for every block of BoxNear within `margin` of the triangle itself.
template<class Body>
void ForBlocksNear(
  const std::array<Vec3, 3>& corner, const BlockBox& box, double side, double margin, Body&& body)
{
  if (box.first == box.last)
  {
    body(MortonEncode(box.first));
    return;
  }
  ForBlocksOf(box,
    [&](const CellIndex& block)
    {
      const Vec3 center = side * (Vec3(block[0], block[1], block[2]) + Vec3::Constant(0.5));
      if (MeetsBox(
            { corner[0] - center, corner[1] - center, corner[2] - center }, 0.5 * side + margin))
      {
        body(MortonEncode(block));
      }
    });
}

} // namespace gridfem

#endif
