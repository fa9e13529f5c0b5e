// The tangent plane of several triangles at once: bases, the projection to it, and tensors in it.
#ifndef GridFEM_TangentPlane_h
#define GridFEM_TangentPlane_h

#include "Base/SimdLanes.h"

#include <cmath>

namespace gridfem
{

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
