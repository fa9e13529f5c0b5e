// The regular grid that contains a mesh, and the Morton keys of its cells. [T §4.2]
// In grid units, cell (i,j,k) is [i,i+1] x [j,j+1] x [k,k+1].
#ifndef GridFEM_Grid_h
#define GridFEM_Grid_h

#include "Base/Types.h"

#include <algorithm>
#include <vector>

namespace gridfem
{

/// The interleaved bits of i, j and k, with i lowest. The three lowest bits are the octant
/// x + 2y + 4z in the parent cell, and key >> 3 is the parent's key.
using MortonKey = std::uint64_t;

using CellIndex = std::array<int, 3>;

constexpr int MinimumDepth = 2;
constexpr int MaximumDepth = 14;

MortonKey MortonEncode(const CellIndex& cell);
CellIndex MortonDecode(MortonKey key);

/// A cube of 2^depth cells per side.
struct Grid
{
  Vec3 origin = Vec3::Zero(); // lowest corner, world units
  double spacing = 1.0;       // side of a cell, world units
  int depth = 0;

  int CellsPerSide() const { return 1 << depth; }
  Vec3 ToGrid(const Vec3& world) const { return (world - origin) / spacing; }
  Vec3 ToWorld(const Vec3& grid) const { return origin + spacing * grid; }

  /// Returns the cell that contains a point, given in world units. For a point outside, it is the
  /// nearest cell along each axis.
  CellIndex CellAt(const Vec3& world) const
  {
    const Vec3 place = this->ToGrid(world);
    CellIndex cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = std::clamp(static_cast<int>(place[axis]), 0, this->CellsPerSide() - 1);
    }
    return cell;
  }
};

/// Returns the cube with the center and the longest side of the bounding box of the points, cut
/// into 2^depth cells per side. Only points marked by `used` count, or all if it is empty. A box
/// without extent gets side 1. Throws InvalidInput for a depth outside
/// [MinimumDepth, MaximumDepth].
Grid EmbedInGrid(
  const std::vector<Vec3>& points, const std::vector<char>& used, int depth, int threads = 0);

} // namespace gridfem

#endif
