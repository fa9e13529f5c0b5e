// Inner loops shared by matrix products and smoothers: one row of a sparse matrix times a few
// columns of a row-major block. The number of columns is a compile-time constant, so that they fill
// SIMD lanes. Only ForEachChunk chooses it at run time.
#ifndef GridFEM_RowKernels_h
#define GridFEM_RowKernels_h

#include "Algebra/SparseMatrix.h"
#include "Base/Parallel.h"
#include "Base/PrecisionTraits.h"
#include "Base/Prefetch.h"

#include <type_traits>

namespace gridfem
{

/// `Columns` adjacent columns of a row-major block, beginning with column `first`. `Stride` is the
/// distance between two rows, or 0 if it is known only at run time.
template<int Columns, int Stride, class Real = double>
struct ColumnChunk
{
  static constexpr int Width = Columns;
  using ColumnLanes = Eigen::Array<Real, Columns, 1>;

  Id first = 0;
  Id stride = Stride;

  Id Offset(Index row) const { return Id(row) * (Stride > 0 ? Stride : stride) + first; }

  Eigen::Map<ColumnLanes> Row(Real* x, Index row) const
  {
    return Eigen::Map<ColumnLanes>(x + this->Offset(row));
  }
  Eigen::Map<const ColumnLanes> Row(const Real* x, Index row) const
  {
    return Eigen::Map<const ColumnLanes>(x + this->Offset(row));
  }
};

/// Calls body(chunk) for chunks of 8, 4, 3, 2 or 1 columns that cover a block of `columns` columns.
/// A block in single precision with WidestPanel columns is a single chunk.
template<class Real = double, class Body>
void ForEachChunk(Id columns, Body&& body)
{
  switch (columns)
  {
    case 1:
      return body(ColumnChunk<1, 1, Real>());
    case 2:
      return body(ColumnChunk<2, 2, Real>());
    case 3:
      return body(ColumnChunk<3, 3, Real>());
    case 4:
      return body(ColumnChunk<4, 4, Real>());
    case 8:
      return body(ColumnChunk<8, 8, Real>());
    case WidestPanel:
      if constexpr (PrecisionTraits<Real>::IsSingle)
      {
        return body(ColumnChunk<WidestPanel, WidestPanel, Real>());
      }
      break;
    default:
      break;
  }
  Id first = 0;
  for (; columns - first >= 8; first += 8)
  {
    body(ColumnChunk<8, 0, Real>{ first, columns });
  }
  if (columns - first >= 4)
  {
    body(ColumnChunk<4, 0, Real>{ first, columns });
    first += 4;
  }
  switch (columns - first)
  {
    case 1:
      return body(ColumnChunk<1, 0, Real>{ first, columns });
    case 2:
      return body(ColumnChunk<2, 0, Real>{ first, columns });
    case 3:
      return body(ColumnChunk<3, 0, Real>{ first, columns });
    default:
      break;
  }
}

/// Pointers to the arrays of a matrix, for loops that should not look them up again.
template<class Real>
struct RowView
{
  const Id* begin;
  const Index* column;
  const Real* value;

  explicit RowView(const BasicSparseMatrix<Real>& A)
    : begin(A.rowBegin.data()), column(A.column.data()), value(A.value.data())
  {
  }
};

/// Prefetches the entries of a row, or the first entries of a long row.
template<class Real>
EIGEN_ALWAYS_INLINE void FetchRow(const RowView<Real>& A, Index row)
{
  Fetch(A.column + A.begin[row]);
  Fetch<3>(A.value + A.begin[row]);
}

/// Returns one row of A times a chunk of x. A single column is summed in four parts, so that
/// additions need not wait for each other.
template<class Real, class Chunk>
EIGEN_ALWAYS_INLINE typename Chunk::ColumnLanes RowProduct(
  const RowView<Real>& A, Index row, const Real* x, Chunk chunk)
{
  using ColumnLanes = typename Chunk::ColumnLanes;
  const Id end = A.begin[row + 1];
  Id k = A.begin[row];
  if constexpr (Chunk::Width == 1)
  {
    Real part[4] = {};
    for (; k + 4 <= end; k += 4)
    {
      for (int i = 0; i < 4; ++i)
      {
        part[i] += A.value[k + i] * x[chunk.Offset(A.column[k + i])];
      }
    }
    for (; k < end; ++k)
    {
      part[0] += A.value[k] * x[chunk.Offset(A.column[k])];
    }
    return ColumnLanes((part[0] + part[1]) + (part[2] + part[3]));
  }
  else
  {
    // Three numbers are read as four. The fourth is the first number of the next row and is not
    // used, because another thread may be writing it. The columns of A's row ascend, so only the
    // last entry may lack a next row.
    constexpr bool isThree = std::is_same_v<Chunk, ColumnChunk<3, 3, Real>>;
    using Read = Eigen::Array<Real, isThree ? 4 : Chunk::Width, 1>;
    const auto lanes = [&](Id entry)
    { return Eigen::Map<const Read>(x + chunk.Offset(A.column[entry])); };
    const Id last = isThree ? end - 1 : end;
    Read even = Read::Zero();
    Read odd = Read::Zero();
    for (; k + 2 <= last; k += 2)
    {
      even += A.value[k] * lanes(k);
      odd += A.value[k + 1] * lanes(k + 1);
    }
    if (k < last)
    {
      even += A.value[k] * lanes(k);
      ++k;
    }
    if constexpr (isThree)
    {
      if (k < end)
      {
        const Real* const three = x + chunk.Offset(A.column[k]);
        odd += A.value[k] * Read(three[0], three[1], three[2], Real(0));
      }
      const Read sum = even + odd;
      return ColumnLanes(sum[0], sum[1], sum[2]);
    }
    else
    {
      return even + odd;
    }
  }
}

/// Returns `threads` if the work (in multiplications) is worth waking threads, otherwise 1. A
/// sleeping thread takes about 20 µs to wake; 100,000 multiplications take about 100 µs.
inline int ThreadsFor(Id work, int threads)
{
  constexpr Id Worthwhile = 100000;
  return work < Worthwhile ? 1 : threads;
}

} // namespace gridfem

#endif
