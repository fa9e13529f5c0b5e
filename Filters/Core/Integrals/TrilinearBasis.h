// The eight trilinear functions of a cell, in a layout that fills SIMD lanes.
#ifndef GridFEM_TrilinearBasis_h
#define GridFEM_TrilinearBasis_h

#include "Grid/PatchLevel.h"

namespace gridfem
{

/// One number per corner of a cell, x fastest.
using CornerValues = std::array<double, FunctionsPerPatch>;

/// Computes the values at a point in the cell's own coordinates.
inline void TrilinearValues(const Vec3& local, CornerValues& value)
{
  const double x[2] = { 1.0 - local[0], local[0] };
  const double y[2] = { 1.0 - local[1], local[1] };
  const double z[2] = { 1.0 - local[2], local[2] };
  const double xy[4] = { x[0] * y[0], x[1] * y[0], x[0] * y[1], x[1] * y[1] };
  for (int c = 0; c < 4; ++c)
  {
    value[c] = xy[c] * z[0];
    value[c + 4] = xy[c] * z[1];
  }
}

/// Computes the gradients: derivative[axis][corner].
inline void TrilinearGradients(const Vec3& local, std::array<CornerValues, 3>& derivative)
{
  const double x[2] = { 1.0 - local[0], local[0] };
  const double y[2] = { 1.0 - local[1], local[1] };
  const double z[2] = { 1.0 - local[2], local[2] };
  const double dx[4] = { -y[0], y[0], -y[1], y[1] };
  const double dy[4] = { -x[0], -x[1], x[0], x[1] };
  const double xy[4] = { x[0] * y[0], x[1] * y[0], x[0] * y[1], x[1] * y[1] };
  for (int c = 0; c < 4; ++c)
  {
    derivative[0][c] = dx[c] * z[0];
    derivative[0][c + 4] = dx[c] * z[1];
    derivative[1][c] = dy[c] * z[0];
    derivative[1][c + 4] = dy[c] * z[1];
    derivative[2][c] = -xy[c];
    derivative[2][c + 4] = xy[c];
  }
}

} // namespace gridfem

#endif
