// The 27 quadratic B-splines of a cell and their derivatives. See SmoothLevels.h for their order.
#ifndef GridFEM_QuadraticBasis_h
#define GridFEM_QuadraticBasis_h

#include "Base/SimdLanes.h"
#include "Grid/PatchLevel.h"

namespace gridfem
{

/// One number per function of a cell, x fastest.
using SmoothValues = std::array<double, SmoothFunctionsPerPatch>;

/// The three quadratic B-splines that do not vanish on [0, 1], with their derivatives. Number is
/// double, or Lanes for several points at once.
template<class Number>
struct QuadraticAxis
{
  Number value[3];
  Number slope[3];

  explicit QuadraticAxis(const Number& t)
  {
    const Number rest = 1.0 - t;
    value[0] = 0.5 * rest * rest;
    value[1] = 0.5 + t * rest;
    value[2] = 0.5 * t * t;
    slope[0] = -rest;
    slope[1] = rest - t;
    slope[2] = t;
  }
};

/// Second derivatives of the three functions, which are constant.
constexpr double QuadraticBend[3] = { 1.0, -2.0, 1.0 };

/// Computes the values at a point in the cell's own coordinates.
inline void QuadraticValues(const Vec3& local, SmoothValues& value)
{
  const QuadraticAxis<double> x(local[0]);
  const QuadraticAxis<double> y(local[1]);
  const QuadraticAxis<double> z(local[2]);
  for (int k = 0; k < 9; ++k)
  {
    const double yz = y.value[k % 3] * z.value[k / 3];
    for (int i = 0; i < 3; ++i)
    {
      value[3 * k + i] = x.value[i] * yz;
    }
  }
}

/// Computes the gradients: derivative[axis][function].
inline void QuadraticGradients(const Vec3& local, std::array<SmoothValues, 3>& derivative)
{
  const QuadraticAxis<double> x(local[0]);
  const QuadraticAxis<double> y(local[1]);
  const QuadraticAxis<double> z(local[2]);
  for (int k = 0; k < 9; ++k)
  {
    const double alongX = y.value[k % 3] * z.value[k / 3];
    const double alongY = y.slope[k % 3] * z.value[k / 3];
    const double alongZ = y.value[k % 3] * z.slope[k / 3];
    for (int i = 0; i < 3; ++i)
    {
      derivative[0][3 * k + i] = x.slope[i] * alongX;
      derivative[1][3 * k + i] = x.value[i] * alongY;
      derivative[2][3 * k + i] = x.value[i] * alongZ;
    }
  }
}

/// Calls visit(function, ∂nn b) for the second derivatives along a direction n, at several points
/// at once.
template<class Visit>
void ForEachSecondDerivative(const Lanes* position, const LaneVector& n, Visit&& visit)
{
  const QuadraticAxis<Lanes> x(position[0]);
  const QuadraticAxis<Lanes> y(position[1]);
  const QuadraticAxis<Lanes> z(position[2]);
  const auto& [nx, ny, nz] = n.axis;
  for (int c = 0; c < 3; ++c)
  {
    for (int b = 0; b < 3; ++b)
    {
      const Lanes yz = nx * nx * (y.value[b] * z.value[c]);
      const Lanes slope = 2.0 * nx * (ny * y.slope[b] * z.value[c] + nz * y.value[b] * z.slope[c]);
      const Lanes rest = ny * ny * (QuadraticBend[b] * z.value[c]) +
                         nz * nz * (QuadraticBend[c] * y.value[b]) +
                         2.0 * ny * nz * y.slope[b] * z.slope[c];
      for (int a = 0; a < 3; ++a)
      {
        visit(
          9 * c + 3 * b + a, Lanes(QuadraticBend[a] * yz + x.slope[a] * slope + x.value[a] * rest));
      }
    }
  }
}

} // namespace gridfem

#endif
