#include "Grid/Grid.h"

#include "Base/Errors.h"
#include "Grid/TriangleMesh.h"

#include <limits>
#include <string>

namespace gridfem
{

namespace
{

/// Moves bit n of a 21-bit number to bit 3n.
std::uint64_t SpreadBits(std::uint64_t x)
{
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}

/// Inverse of SpreadBits.
int GatherBits(std::uint64_t x)
{
  x &= 0x1249249249249249;
  x = (x | x >> 2) & 0x10c30c30c30c30c3;
  x = (x | x >> 4) & 0x100f00f00f00f00f;
  x = (x | x >> 8) & 0x1f0000ff0000ff;
  x = (x | x >> 16) & 0x1f00000000ffff;
  x = (x | x >> 32) & 0x1fffff;
  return static_cast<int>(x);
}

} // namespace

MortonKey MortonEncode(const CellIndex& cell)
{
  return SpreadBits(cell[0]) | SpreadBits(cell[1]) << 1 | SpreadBits(cell[2]) << 2;
}

CellIndex MortonDecode(MortonKey key)
{
  return { GatherBits(key), GatherBits(key >> 1), GatherBits(key >> 2) };
}

Grid EmbedInGrid(
  const std::vector<Vec3>& points, const std::vector<char>& used, int depth, int threads)
{
  if (depth < MinimumDepth || depth > MaximumDepth)
  {
    throw InvalidInput("Depth is " + std::to_string(depth) + "; it must be between " +
                       std::to_string(MinimumDepth) + " and " + std::to_string(MaximumDepth) + ".");
  }
  auto [low, high] = BoundsOf(points, used, threads);
  Grid grid;
  grid.depth = depth;
  if (!(low.array() <= high.array()).all())
  {
    low = high = Vec3::Zero();
  }
  const double extent = (high - low).maxCoeff();
  const double side = extent > 0.0 ? extent : 1.0;
  grid.spacing = side / grid.CellsPerSide();
  grid.origin = low + 0.5 * (high - low) - Vec3::Constant(0.5 * side);
  return grid;
}

} // namespace gridfem
