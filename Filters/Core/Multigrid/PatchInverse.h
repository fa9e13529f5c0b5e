// The correction of a patch from its residuals, for the precisions and numbers of columns of all
// patch smoothers.
#ifndef GridFEM_PatchInverse_h
#define GridFEM_PatchInverse_h

#include "Base/Types.h"

#include <type_traits>

namespace gridfem
{

/// Columns with ones from the diagonal on (lower) or up to it.
template<class Number, bool IsLower>
struct TriangleOfOnes
{
  static constexpr int N = FunctionsPerPatch;
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

/// y = T x with the lower or the upper triangle of what is stored mirrored. Two sums need not wait
/// for each other.
template<bool IsLower, class Real, class Number>
EIGEN_ALWAYS_INLINE Eigen::Array<Number, FunctionsPerPatch, 1> MultiplyTriangle(
  const Real* mirrored, const Number* x)
{
  constexpr int N = FunctionsPerPatch;
  using Vector = Eigen::Array<Number, N, 1>;
  const auto column = [&](int j)
  {
    return Eigen::Map<const Eigen::Array<Real, N, 1>>(mirrored + N * j).template cast<Number>() *
           (Eigen::Map<const Vector>(OnesOf<Number, IsLower>.value + N * j) * x[j]);
  };
  Vector even = column(0);
  Vector odd = column(1);
#pragma GCC unroll 3
  for (int j = 2; j < N; j += 2)
  {
    even += column(j);
    odd += column(j + 1);
  }
  return even + odd;
}

/// r = Vᵀ V r for one column: vectors run along the patch.
/// @param V  lower triangle, mirrored to the upper one, so that both products run along columns
template<class Real, class Number, std::enable_if_t<std::is_floating_point_v<Number>, int> = 0>
EIGEN_ALWAYS_INLINE void ApplyInverse(const Real* V, Number (&r)[FunctionsPerPatch])
{
  using Vector = Eigen::Array<Number, FunctionsPerPatch, 1>;
  const Vector y = MultiplyTriangle<true>(V, &r[0]);
  Eigen::Map<Vector> result(r);
  result = MultiplyTriangle<false>(V, y.data());
}

/// The same for several columns: vectors run along them.
template<class Real, class Lanes, std::enable_if_t<!std::is_floating_point_v<Lanes>, int> = 0>
inline void ApplyInverse(const Real* V, Lanes (&r)[FunctionsPerPatch])
{
  constexpr int N = FunctionsPerPatch;
  using Number = typename Lanes::Scalar;
#pragma GCC unroll 8
  for (int i = N - 1; i >= 0; --i)
  {
    r[i] *= Number(V[N * i + i]);
#pragma GCC unroll 8
    for (int j = 0; j < i; ++j)
    {
      r[i] += Number(V[N * i + j]) * r[j];
    }
  }
#pragma GCC unroll 8
  for (int i = 0; i < N; ++i)
  {
    r[i] *= Number(V[N * i + i]);
#pragma GCC unroll 8
    for (int j = i + 1; j < N; ++j)
    {
      r[i] += Number(V[N * i + j]) * r[j];
    }
  }
}

} // namespace gridfem

#endif
