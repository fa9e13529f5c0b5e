// The integrals that the element matrices of a patch are linear in. Along each axis, products of
// the two linear functions 1 - t and t, or of one with a constant, are combinations of three
// quadratics; so 27 moments stand for all 36 entries of the mass matrix, and with a weight for each
// pair of directions for those of the stiffness matrix. They cost a quarter of summing the entries.
#ifndef GridFEM_PatchMoments_h
#define GridFEM_PatchMoments_h

#include "ElementMatrices.h"

namespace gridfem
{

/// ∫ q_a(x) q_b(y) q_c(z) with q_0 = (1 - t)², q_1 = t (1 - t), q_2 = t², cell-local coordinates.
class Moments
{
public:
  /// Steps in `Values` to the next quadratic along x, y, z. Quadratics of z fill a SIMD register,
  /// one lane of which stays 0.
  static constexpr std::array<int, 3> Stride = { 4, 12, 1 };
  static constexpr int Size = 36;

  void AddSample(const Vec3& local, double weight)
  {
    const double rx = 1.0 - local[0];
    const double ry = 1.0 - local[1];
    const double rz = 1.0 - local[2];
    const double x[3] = { rx * rx, local[0] * rx, local[0] * local[0] };
    const double y[3] = { weight * ry * ry, weight * local[1] * ry, weight * local[1] * local[1] };
    const double z[4] = { rz * rz, local[2] * rz, local[2] * local[2], 0.0 };
    for (int b = 0; b < 3; ++b)
    {
      for (int a = 0; a < 3; ++a)
      {
        const double xy = x[a] * y[b];
        for (int c = 0; c < 4; ++c)
        {
          value_[Stride[0] * a + Stride[1] * b + c] += xy * z[c];
        }
      }
    }
  }

  void AddScaled(double factor, const Moments& other)
  {
    for (int k = 0; k < Size; ++k)
    {
      value_[k] += factor * other.value_[k];
    }
  }

  const double* Values() const { return value_; }

private:
  alignas(32) double value_[Size] = {};
};

/// Weight of the normal derivative in the stiffness matrix. On a nearly flat piece of surface a
/// function can be almost zero although its coefficients are not; its energy is the square of the
/// surface's roughness, which for coordinates in single precision is as small as rounding. Such
/// functions stop any solver: they are neither zero nor known. The weight lifts their energy to
/// what double precision can resolve and changes solutions by no more than its root, in general by
/// no more than itself.
constexpr double NormalWeight = 1e-12;

/// Moments of a patch, summed piece by piece.
class PatchMoments
{
public:
  /// Adds a flat piece with this area vector (any length; zero: no area, nothing is added).
  void AddPiece(const Moments& piece, const Vec3& normal);

  ElementMatrix Mass() const;
  ElementMatrix Stiffness() const;

private:
  Moments mass_;
  std::array<Moments, 3> same_;  // times entry (p, p) of I - (1 - NormalWeight) n nᵀ
  std::array<Moments, 3> mixed_; // times entries (x, y), (y, z), (z, x)
};

} // namespace gridfem

#endif
