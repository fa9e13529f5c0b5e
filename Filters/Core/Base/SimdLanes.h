// Numbers, directions and tensors for several triangles or samples at once, one per SIMD lane.
#ifndef GridFEM_SimdLanes_h
#define GridFEM_SimdLanes_h

#include "Base/Types.h"

#include <array>

namespace gridfem
{

constexpr int LaneCount = 8;
using Lanes = Eigen::Array<double, LaneCount, 1>;

/// As many numbers of as many items as there are lanes; transposed, every number has its lanes.
using LaneBlock = Eigen::Array<double, LaneCount, LaneCount>;

/// lanes[k][lane] = item[lane][begin + k] for as many k as there are lanes.
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

/// The reverse, for the first `count` items: item[lane][begin + k] = lanes(lane, k). The block is
/// used up.
inline void StoreLanes(
  LaneBlock& lanes, const std::array<double*, LaneCount>& item, int count, int begin)
{
  lanes.transposeInPlace();
  for (int lane = 0; lane < count; ++lane)
  {
    Eigen::Map<Lanes>(item[lane] + begin) = lanes.col(lane);
  }
}

/// The sum over the lanes of what lies in memory: its quarters are loaded one by one, which takes
/// fewer shuffles than to split a register.
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

/// A symmetric tensor.
struct LaneTensor
{
  Lanes same[3];  // xx, yy, zz
  Lanes mixed[3]; // xy, yz, zx

  // Not moved: Eigen copies registers, but moves bytes, in pieces that the next load has to wait
  // for.
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
