// Sums and products of blocks of vectors, column by column, because every right-hand side has its
// own step length.
#ifndef GridFEM_ColumnAlgebra_h
#define GridFEM_ColumnAlgebra_h

#include "Algebra/RowKernels.h"
#include "Base/LargeMemory.h"

namespace gridfem
{

/// One number per column.
using Columns = Eigen::ArrayXd;

/// Returns x_cᵀ y_c of every column c over the rows begin .. end - 1, added up in double precision.
template<class Real>
Columns RowProducts(const Vectors<Real>& x, const Vectors<Real>& y, Id begin, Id end)
{
  Columns sums = Columns::Zero(x.cols());
  ForEachChunk<Real>(x.cols(),
    [&](auto chunk)
    {
      constexpr int width = decltype(chunk)::Width;
      using Sums = Eigen::Array<double, width, 1>;
      Sums part[4] = { Sums::Zero(), Sums::Zero(), Sums::Zero(), Sums::Zero() };
      for (Index row = static_cast<Index>(begin); row < end; ++row)
      {
        part[row & 3] += chunk.Row(x.data(), row).template cast<double>() *
                         chunk.Row(y.data(), row).template cast<double>();
      }
      sums.segment<width>(chunk.first) = (part[0] + part[1]) + (part[2] + part[3]);
    });
  return sums;
}

/// Returns the same products over all rows from `first` on. Same bits for any number of threads.
template<class Real>
Columns ColumnProducts(const Vectors<Real>& x, const Vectors<Real>& y, int threads, Id first = 0)
{
  return ParallelSum(x.rows() - first, ThreadsFor(x.size(), threads),
    Columns(Columns::Zero(x.cols())),
    [&](Id begin, Id end) { return RowProducts(x, y, first + begin, first + end); });
}

/// Resizes a block. New memory prefers large pages.
template<class Real>
void MakeRoom(Id rows, Id columns, Vectors<Real>& block)
{
  if (block.rows() != rows || block.cols() != columns)
  {
    block.resize(rows, columns);
    PreferLargePages(block.data(), block.size() * sizeof(Real));
  }
}

/// Resizes a block and fills it with zeros.
template<class Real>
void SetZero(Id rows, Id columns, Vectors<Real>& block, int threads)
{
  MakeRoom(rows, columns, block);
  ParallelRanges(rows, ThreadsFor(block.size(), threads),
    [&](Id begin, Id end) { block.middleRows(begin, end - begin).setZero(); });
}

/// Computes y_c += factor_c x_c for every column c.
inline void AddScaled(const MultiVector& x, const Columns& factor, MultiVector& y, int threads)
{
  ParallelRanges(x.rows(), ThreadsFor(x.size(), threads),
    [&](Id begin, Id end)
    {
      y.middleRows(begin, end - begin) +=
        x.middleRows(begin, end - begin) * factor.matrix().asDiagonal();
    });
}

/// Computes x_c = z_c + factor_c x_c for every column c.
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
