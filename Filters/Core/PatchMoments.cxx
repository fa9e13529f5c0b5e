#include "PatchMoments.h"

namespace gridfem
{

namespace
{

/// Bit of a corner along an axis.
int Bit(int corner, int axis)
{
  return (corner >> axis) & 1;
}

/// Derivative of the function of a corner along an axis, up to the other two factors.
double Slope(int corner, int axis)
{
  return Bit(corner, axis) ? 1.0 : -1.0;
}

/// Adds ∫ T_pp ∂_p b_i ∂_p b_j to all entries.
void AddSameAxis(const double* moments, int p, ElementMatrix& stiffness)
{
  const auto& stride = Moments::Stride;
  const int q = (p + 1) % 3;
  const int r = (p + 2) % 3;
  // The derivatives are constant along p, where the quadratics sum to 1 = q_0 + 2 q_1 + q_2.
  double sum[3][3];
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      const double* m = moments + a * stride[q] + b * stride[r];
      sum[a][b] = m[0] + 2.0 * m[stride[p]] + m[2 * stride[p]];
    }
  }
  int entry = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      stiffness[entry++] +=
        Slope(i, p) * Slope(j, p) * sum[Bit(i, q) + Bit(j, q)][Bit(i, r) + Bit(j, r)];
    }
  }
}

/// Adds ∫ T_pq (∂_p b_i ∂_q b_j + ∂_q b_i ∂_p b_j) to all entries, q the axis after p.
void AddMixedAxes(const double* moments, int p, ElementMatrix& stiffness)
{
  const auto& stride = Moments::Stride;
  const int q = (p + 1) % 3;
  const int r = (p + 2) % 3;
  // One function has its slope along p, the other along q: t = q_1 + q_2, 1 - t = q_0 + q_1.
  double sum[2][2][3];
  for (int a = 0; a < 2; ++a)
  {
    for (int b = 0; b < 2; ++b)
    {
      for (int c = 0; c < 3; ++c)
      {
        const double* m = moments + a * stride[p] + b * stride[q] + c * stride[r];
        sum[a][b][c] = m[0] + m[stride[p]] + m[stride[q]] + m[stride[p] + stride[q]];
      }
    }
  }
  int entry = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      const int c = Bit(i, r) + Bit(j, r);
      stiffness[entry++] += Slope(i, p) * Slope(j, q) * sum[Bit(j, p)][Bit(i, q)][c] +
                            Slope(i, q) * Slope(j, p) * sum[Bit(i, p)][Bit(j, q)][c];
    }
  }
}

} // namespace

void PatchMoments::AddPiece(const Moments& piece, const Vec3& normal)
{
  const double square = normal.squaredNorm();
  if (!(square > 0.0))
  {
    return;
  }
  mass_.AddScaled(1.0, piece);
  for (int p = 0; p < 3; ++p)
  {
    const int q = (p + 1) % 3;
    const int r = (p + 2) % 3;
    // Entry (p, p) of the projection without the cancellation of 1 - n_p².
    const double tangential = normal[q] * normal[q] + normal[r] * normal[r];
    same_[p].AddScaled((tangential + NormalWeight * normal[p] * normal[p]) / square, piece);
    mixed_[p].AddScaled((NormalWeight - 1.0) * normal[p] * normal[q] / square, piece);
  }
}

ElementMatrix PatchMoments::Mass() const
{
  const auto& stride = Moments::Stride;
  ElementMatrix mass;
  int entry = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      mass[entry++] =
        mass_.Values()[stride[0] * (Bit(i, 0) + Bit(j, 0)) + stride[1] * (Bit(i, 1) + Bit(j, 1)) +
                       stride[2] * (Bit(i, 2) + Bit(j, 2))];
    }
  }
  return mass;
}

ElementMatrix PatchMoments::Stiffness() const
{
  ElementMatrix stiffness{};
  for (int p = 0; p < 3; ++p)
  {
    AddSameAxis(same_[p].Values(), p, stiffness);
    AddMixedAxes(mixed_[p].Values(), p, stiffness);
  }
  return stiffness;
}

} // namespace gridfem
