// Numbers, directions and tensors for several triangles or samples at once, one per SIMD lane.
#ifndef GridFEM_SimdLanes_h
#define GridFEM_SimdLanes_h

#include "Base/Types.h"

#include <array>

namespace gridfem
{

constexpr int LaneCount = 8;
using Lanes = Eigen::Array<double, LaneCount, 1>;

/// A square block: LaneCount numbers of LaneCount items. Transposing it gathers each number over
/// all items.
using LaneBlock = Eigen::Array<double, LaneCount, LaneCount>;

/// Sets lanes[k][lane] = item[lane][begin + k] for 0 <= k < LaneCount.
inline void LoadLanes(const std::array<const double*, LaneCount>& item, int begin, Lanes* lanes)
{
  LaneBlock block;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    block.col(lane) = Eigen::Map<const Lanes>(item[lane] + begin);
  }
  block.transposeInPlace();
  for (int k = 0; k < LaneCount; ++k)
  {
    lanes[k] = block.col(k);
  }
}

/// The reverse for the first `count` items: item[lane][begin + k] = lanes(lane, k). Overwrites
/// `lanes`.
inline void StoreLanes(
  LaneBlock& lanes, const std::array<double*, LaneCount>& item, int count, int begin)
{
  lanes.transposeInPlace();
  for (int lane = 0; lane < count; ++lane)
  {
    Eigen::Map<Lanes>(item[lane] + begin) = lanes.col(lane);
  }
}

/// Sum over the lanes of numbers in memory. The quarters are loaded one by one, which takes fewer
/// shuffles than splitting a register.
inline double SumOverLanes(const Lanes& lanes)
{
  return ((lanes.segment<2>(0) + lanes.segment<2>(2)) + (lanes.segment<2>(4) + lanes.segment<2>(6)))
    .sum();
}

struct LaneVector
{
  Lanes axis[3];

  Lanes Dot(const LaneVector& other) const
  {
    return axis[0] * other.axis[0] + axis[1] * other.axis[1] + axis[2] * other.axis[2];
  }
};

/// A symmetric 3 x 3 tensor.
struct LaneTensor
{
  Lanes same[3];  // xx, yy, zz
  Lanes mixed[3]; // xy, yz, zx

  // No move operations: Eigen copies whole registers, but moves byte by byte. The next load then
  // has to wait for the pieces.
  LaneTensor() = default;
  LaneTensor(const LaneTensor&) = default;
  LaneTensor& operator=(const LaneTensor&) = default;

  LaneTensor Times(const Lanes& factor) const
  {
    LaneTensor result;
    for (int p = 0; p < 3; ++p)
    {
      result.same[p] = factor * same[p];
      result.mixed[p] = factor * mixed[p];
    }
    return result;
  }
};

} // namespace gridfem

#endif
