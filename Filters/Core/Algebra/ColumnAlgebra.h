// Sums and products of blocks of vectors, column by column: every right-hand side has its own step.
#ifndef GridFEM_ColumnAlgebra_h
#define GridFEM_ColumnAlgebra_h

#include "Algebra/RowKernels.h"

namespace gridfem
{

/// One number per column.
using Columns = Eigen::ArrayXd;

/// x_cᵀ y_c of every column c, over the rows from `first` on. Same bits for any number of threads.
inline Columns ColumnProducts(const MultiVector& x, const MultiVector& y, int threads, Id first = 0)
{
  const auto sumRange = [&](Id begin, Id end)
  {
    Columns sums = Columns::Zero(x.cols());
    ForEachChunk(x.cols(),
      [&](auto chunk)
      {
        using ColumnLanes = typename decltype(chunk)::ColumnLanes;
        ColumnLanes part[4] = { ColumnLanes::Zero(), ColumnLanes::Zero(), ColumnLanes::Zero(),
          ColumnLanes::Zero() };
        for (Index row = static_cast<Index>(first + begin); row < first + end; ++row)
        {
          part[row & 3] += chunk.Row(x.data(), row) * chunk.Row(y.data(), row);
        }
        sums.segment<ColumnLanes::SizeAtCompileTime>(chunk.first) =
          (part[0] + part[1]) + (part[2] + part[3]);
      });
    return sums;
  };
  return ParallelSum(
    x.rows() - first, ThreadsFor(x.size(), threads), Columns(Columns::Zero(x.cols())), sumRange);
}

/// y_c += factor_c x_c.
inline void AddScaled(const MultiVector& x, const Columns& factor, MultiVector& y, int threads)
{
  ParallelRanges(x.rows(), ThreadsFor(x.size(), threads),
    [&](Id begin, Id end)
    {
      y.middleRows(begin, end - begin) +=
        x.middleRows(begin, end - begin) * factor.matrix().asDiagonal();
    });
}

/// x_c = z_c + factor_c x_c.
inline void ScaleAndAdd(const MultiVector& z, const Columns& factor, MultiVector& x, int threads)
{
  ParallelRanges(x.rows(), ThreadsFor(x.size(), threads),
    [&](Id begin, Id end)
    {
      auto rows = x.middleRows(begin, end - begin);
      rows = z.middleRows(begin, end - begin) + rows * factor.matrix().asDiagonal();
    });
}

} // namespace gridfem

#endif
