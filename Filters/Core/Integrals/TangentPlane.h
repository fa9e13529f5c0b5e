// Tangent planes of several triangles at once: bases, projections to the planes, and tensors in
// them.
#ifndef GridFEM_TangentPlane_h
#define GridFEM_TangentPlane_h

#include "Base/SimdLanes.h"

#include <cmath>

namespace gridfem
{

/// An orthonormal basis of the plane perpendicular to a unit normal. It depends only on the normal.
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

/// Returns the projection to the plane perpendicular to a unit normal n, plus normalWeight n nᵀ.
inline LaneTensor TangentialProjection(const LaneVector& normal, double normalWeight)
{
  LaneTensor tensor;
  for (int p = 0; p < 3; ++p)
  {
    const Lanes& a = normal.axis[p];
    const Lanes& b = normal.axis[(p + 1) % 3];
    const Lanes& c = normal.axis[(p + 2) % 3];
    // This form of entry (p, p) of the projection avoids the cancellation of 1 - n_p².
    tensor.same[p] = b * b + c * c + normalWeight * a * a;
    tensor.mixed[p] = (normalWeight - 1.0) * a * b;
  }
  return tensor;
}

/// Returns a first firstᵀ + b (first secondᵀ + second firstᵀ) + c second secondᵀ + n normal
/// normalᵀ.
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
