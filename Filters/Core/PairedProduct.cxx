#include "PairedProduct.h"

#include "Parallel.h"

namespace gridfem
{
namespace
{

/// Rows are handed out in ranges of this size.
constexpr Id RangeSize = 256;

/// One row of both products, columns begin .. begin + Width.
template<int Width>
inline void RowPair(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X, Id row,
  Id begin, MultiVector& pair)
{
  using Lanes = Eigen::Array<double, Width, 1>;
  Lanes a = Lanes::Zero();
  Lanes b = Lanes::Zero();
  for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
  {
    const Eigen::Map<const Lanes> x(X.data() + A.column[k] * X.cols() + begin);
    a += A.value[k] * x;
    b += B.value[k] * x;
  }
  double* to = pair.data() + row * pair.cols() + begin;
  Eigen::Map<Lanes>{ to } = a;
  Eigen::Map<Lanes>{ to + X.cols() } = b;
}

} // namespace

void MultiplyPair(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X,
  MultiVector& pair, int threads)
{
  if (A.columns != X.rows() || B.rows != A.rows || B.columns != A.columns ||
      B.NonZeros() != A.NonZeros())
  {
    throw InvalidInput("a paired product needs two matrices of one pattern that fit the block");
  }
  pair.resize(A.rows, 2 * X.cols());
  ParallelRanges(
    A.rows, threads,
    [&](Id first, Id last)
    {
      for (Id row = first; row < last; ++row)
      {
        Id column = 0;
        for (; column + 16 <= X.cols(); column += 16)
        {
          RowPair<16>(A, B, X, row, column, pair);
        }
        for (; column + 4 <= X.cols(); column += 4)
        {
          RowPair<4>(A, B, X, row, column, pair);
        }
        for (; column < X.cols(); ++column)
        {
          RowPair<1>(A, B, X, row, column, pair);
        }
      }
    },
    RangeSize);
}

} // namespace gridfem
