// Numbers, directions and tensors for several triangles or samples at once, one per SIMD lane.
#ifndef GridFEM_Lanes_h
#define GridFEM_Lanes_h

#include "Types.h"

#include <array>
#include <cmath>

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

/// An orthonormal basis of the plane across a unit normal, which it depends on alone.
struct TangentBasis
{
  LaneVector first;
  LaneVector second;

  explicit TangentBasis(const LaneVector& normal)
  {
    const auto& [x, y, z] = normal.axis;
    Lanes sign;
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      sign[lane] = std::copysign(1.0, z[lane]);
    }
    const Lanes a = -1.0 / (sign + z);
    first.axis[0] = 1.0 + sign * x * x * a;
    first.axis[1] = sign * x * y * a;
    first.axis[2] = -sign * x;
    second.axis[0] = x * y * a;
    second.axis[1] = sign + y * y * a;
    second.axis[2] = -y;
  }
};

/// Weight of the normal derivative in the stiffness matrix. On a nearly flat piece of surface a
/// function can be almost zero although its coefficients are not; its energy is the square of the
/// surface's roughness, which for coordinates in single precision is as small as rounding. Such
/// functions stop any solver: they are neither zero nor known. The weight lifts their energy to
/// what double precision can resolve and changes solutions by no more than its root, in general by
/// no more than itself.
constexpr double NormalWeight = 1e-12;

/// The projection to the plane across a unit normal, plus NormalWeight n nᵀ.
inline LaneTensor TangentialProjection(const LaneVector& normal)
{
  LaneTensor tensor;
  for (int p = 0; p < 3; ++p)
  {
    const Lanes& a = normal.axis[p];
    const Lanes& b = normal.axis[(p + 1) % 3];
    const Lanes& c = normal.axis[(p + 2) % 3];
    // Entry (p, p) of the projection without the cancellation of 1 - n_p².
    tensor.same[p] = b * b + c * c + NormalWeight * a * a;
    tensor.mixed[p] = (NormalWeight - 1.0) * a * b;
  }
  return tensor;
}

/// a first firstᵀ + b (first secondᵀ + second firstᵀ) + c second secondᵀ + n normal normalᵀ.
inline LaneTensor TensorInBasis(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& n,
  const TangentBasis& basis, const LaneVector& normal)
{
  LaneTensor tensor;
  for (int p = 0; p < 3; ++p)
  {
    const int q = (p + 1) % 3;
    const Lanes u = a * basis.first.axis[p] + b * basis.second.axis[p];
    const Lanes v = b * basis.first.axis[p] + c * basis.second.axis[p];
    const Lanes w = n * normal.axis[p];
    tensor.same[p] = u * basis.first.axis[p] + v * basis.second.axis[p] + w * normal.axis[p];
    tensor.mixed[p] = u * basis.first.axis[q] + v * basis.second.axis[q] + w * normal.axis[q];
  }
  return tensor;
}

} // namespace gridfem

#endif
