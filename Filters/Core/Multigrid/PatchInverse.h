// Computes the correction of a patch of PatchKernelWidth unknowns from its residuals, for the
// precisions and numbers of columns of all patch smoothers.
#ifndef GridFEM_PatchInverse_h
#define GridFEM_PatchInverse_h

#include "Multigrid/UnknownGroups.h"

#include <array>
#include <type_traits>

namespace gridfem
{

/// Columns of ones from the diagonal down (lower triangle) or up to the diagonal (upper triangle).
template<class Number, bool IsLower>
struct TriangleOfOnes
{
  static constexpr int N = PatchKernelWidth;
  Number value[N * N]{};

  constexpr TriangleOfOnes()
  {
    for (int j = 0; j < N; ++j)
    {
      for (int i = 0; i < N; ++i)
      {
        value[N * j + i] = (IsLower ? i >= j : i <= j) ? Number(1) : Number(0);
      }
    }
  }
};

template<class Number, bool IsLower>
inline constexpr TriangleOfOnes<Number, IsLower> OnesOf{};

/// y = T x, where T is the lower or the upper triangle of a mirrored factor. It has two sums that
/// do not wait for each other.
template<bool IsLower, class Real, class Number>
EIGEN_ALWAYS_INLINE Eigen::Array<Number, PatchKernelWidth, 1> MultiplyTriangle(
  const Real* mirrored, const Number* x)
{
  constexpr int Size = PatchKernelWidth;
  using Vector = Eigen::Array<Number, Size, 1>;
  const auto column = [&](int j)
  {
    return Eigen::Map<const Eigen::Array<Real, Size, 1>>(mirrored + Size * j)
             .template cast<Number>() *
           (Eigen::Map<const Vector>(OnesOf<Number, IsLower>.value + Size * j) * x[j]);
  };
  Vector even = column(0);
  Vector odd = column(1);
#pragma GCC unroll 3
  for (int j = 2; j < Size; j += 2)
  {
    even += column(j);
    odd += column(j + 1);
  }
  return even + odd;
}

/// Storage of V in patches. A mirrored factor repeats the lower triangle in the upper one, so that
/// products run along columns. A packed factor has the lower triangle alone.
template<class Real>
using MirroredFactor = std::array<Real, PatchKernelWidth * PatchKernelWidth>;
template<class Real>
using PackedFactor = std::array<Real, PatchKernelWidth*(PatchKernelWidth + 1) / 2>;

/// Entry (i, j) of V, for i >= j.
template<class Real>
EIGEN_ALWAYS_INLINE Real EntryOf(const MirroredFactor<Real>& V, int i, int j)
{
  return V[PatchKernelWidth * j + i];
}

template<class Real>
EIGEN_ALWAYS_INLINE Real EntryOf(const PackedFactor<Real>& V, int i, int j)
{
  return V[i * (i + 1) / 2 + j];
}

/// r = Vᵀ V r. Vector instructions run along the columns, of which there may be one or several.
template<class Factor, class Lanes>
EIGEN_ALWAYS_INLINE void ApplyAlongColumns(const Factor& V, Lanes (&r)[PatchKernelWidth])
{
  constexpr int Size = PatchKernelWidth;
  using Number = typename Eigen::NumTraits<Lanes>::Literal;
  const auto entry = [&](int i, int j) { return static_cast<Number>(EntryOf(V, i, j)); };
#pragma GCC unroll 8
  for (int i = Size - 1; i >= 0; --i)
  {
    r[i] *= entry(i, i);
#pragma GCC unroll 8
    for (int j = 0; j < i; ++j)
    {
      r[i] += entry(i, j) * r[j];
    }
  }
#pragma GCC unroll 8
  for (int i = 0; i < Size; ++i)
  {
    r[i] *= entry(i, i);
#pragma GCC unroll 8
    for (int j = i + 1; j < Size; ++j)
    {
      r[i] += entry(j, i) * r[j];
    }
  }
}

/// r = Vᵀ V r. For one column and a mirrored factor vector instructions run along the patch.
template<class Factor, class Lanes>
EIGEN_ALWAYS_INLINE void ApplyInverse(const Factor& V, Lanes (&r)[PatchKernelWidth])
{
  using Real = typename Factor::value_type;
  if constexpr (std::is_floating_point_v<Lanes> && std::is_same_v<Factor, MirroredFactor<Real>>)
  {
    using Vector = Eigen::Array<Lanes, PatchKernelWidth, 1>;
    const Vector y = MultiplyTriangle<true>(V.data(), &r[0]);
    Eigen::Map<Vector> result(r);
    result = MultiplyTriangle<false>(V.data(), y.data());
  }
  else
  {
    ApplyAlongColumns(V, r);
  }
}

} // namespace gridfem

#endif
