// The eight trilinear functions of a cell in a layout that fills SIMD lanes.
#ifndef GridFEM_TrilinearBasis_h
#define GridFEM_TrilinearBasis_h

#include "Types.h"

namespace gridfem
{

/// One number per corner of a cell, x fastest.
using CornerValues = std::array<double, FunctionsPerPatch>;

/// Values at a point in the cell's own coordinates.
inline void TrilinearValues(const Vec3& local, CornerValues& value)
{
  const double x[2] = { 1.0 - local[0], local[0] };
  const double y[2] = { 1.0 - local[1], local[1] };
  const double z[2] = { 1.0 - local[2], local[2] };
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    value[c] = x[c & 1] * y[(c >> 1) & 1] * z[c >> 2];
  }
}

/// Gradients: derivative[axis][corner].
inline void TrilinearGradients(const Vec3& local, std::array<CornerValues, 3>& derivative)
{
  const double x[2] = { 1.0 - local[0], local[0] };
  const double y[2] = { 1.0 - local[1], local[1] };
  const double z[2] = { 1.0 - local[2], local[2] };
  const double sign[2] = { -1.0, 1.0 };
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    const int i = c & 1;
    const int j = (c >> 1) & 1;
    const int k = c >> 2;
    derivative[0][c] = sign[i] * y[j] * z[k];
    derivative[1][c] = x[i] * sign[j] * z[k];
    derivative[2][c] = x[i] * y[j] * sign[k];
  }
}

/// Derivatives along a direction: <direction, ∇b_c>.
inline void TrilinearDerivatives(const Vec3& local, const Vec3& direction, CornerValues& value)
{
  const double x[2] = { 1.0 - local[0], local[0] };
  const double y[2] = { 1.0 - local[1], local[1] };
  const double z[2] = { 1.0 - local[2], local[2] };
  const double dx[2] = { -direction[0], direction[0] };
  const double dy[2] = { -direction[1], direction[1] };
  const double dz[2] = { -direction[2], direction[2] };
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    const int i = c & 1;
    const int j = (c >> 1) & 1;
    const int k = c >> 2;
    value[c] = (dx[i] * y[j] + x[i] * dy[j]) * z[k] + x[i] * y[j] * dz[k];
  }
}

} // namespace gridfem

#endif
