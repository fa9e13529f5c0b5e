// One patch of a sweep: its residual, and the inverse of its block.
#ifndef GridFEM_RelaxPatch_h
#define GridFEM_RelaxPatch_h

#include "Algebra/RowKernels.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace gridfem
{

/// r = Vᵀ V r for one column: vectors run along the patch.
/// @param V  lower triangle, mirrored to the upper one, so that both products run along columns
template<class Real>
inline void ApplyInverse(const Real* V, double (&r)[FunctionsPerPatch])
{
  double y[FunctionsPerPatch] = {};
  for (int j = 0; j < FunctionsPerPatch; ++j)
  {
    for (int i = 0; i < FunctionsPerPatch; ++i)
    {
      y[i] += V[FunctionsPerPatch * j + i] * (i >= j ? r[j] : 0.0);
    }
  }
  std::fill(r, r + FunctionsPerPatch, 0.0);
  for (int j = 0; j < FunctionsPerPatch; ++j)
  {
    for (int i = 0; i < FunctionsPerPatch; ++i)
    {
      r[i] += V[FunctionsPerPatch * j + i] * (i <= j ? y[j] : 0.0);
    }
  }
}

/// The same for several columns: vectors run along them.
template<class Real, class Lanes>
inline void ApplyInverse(const Real* V, Lanes (&r)[FunctionsPerPatch])
{
  for (int i = FunctionsPerPatch - 1; i >= 0; --i)
  {
    r[i] *= double(V[FunctionsPerPatch * i + i]);
    for (int j = 0; j < i; ++j)
    {
      r[i] += double(V[FunctionsPerPatch * i + j]) * r[j];
    }
  }
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    r[i] *= double(V[FunctionsPerPatch * i + i]);
    for (int j = i + 1; j < FunctionsPerPatch; ++j)
    {
      r[i] += double(V[FunctionsPerPatch * i + j]) * r[j];
    }
  }
}

/// x += Vᵀ V (b - A x) on the patch.
template<class Chunk, class Real>
inline void RelaxPatch(const RowView& A, const std::array<Index, FunctionsPerPatch>& dof,
  const Real* V, const double* b, double* x, Chunk chunk)
{
  using ColumnLanes = typename Chunk::ColumnLanes;
  std::conditional_t<Chunk::Width == 1, double, ColumnLanes> r[FunctionsPerPatch];
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    const ColumnLanes residual = chunk.Row(b, dof[i]) - RowProduct(A, dof[i], x, chunk);
    if constexpr (Chunk::Width == 1)
    {
      r[i] = residual[0];
    }
    else
    {
      r[i] = residual;
    }
  }
  ApplyInverse(V, r);
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    chunk.Row(x, dof[i]) += r[i];
  }
}

} // namespace gridfem

#endif
