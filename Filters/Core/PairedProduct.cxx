#include "PairedProduct.h"

#include "BlockVectors.h"
#include "Errors.h"
#include "Parallel.h"
#include "RowKernels.h"

#include <type_traits>

namespace gridfem
{
namespace
{

/// Rows are handed out in ranges of this size.
constexpr Id RangeSize = 256;

/// One row of both products, columns begin .. begin + Width, to store(a, b).
template<int Width, class Store>
inline void RowPair(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X, Id row,
  Id begin, Store&& store)
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
  store(a, b);
}

void CheckShapes(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X)
{
  if (A.columns != X.rows() || B.rows != A.rows || B.columns != A.columns ||
      B.NonZeros() != A.NonZeros())
  {
    throw InvalidInput("a paired product needs two matrices of one pattern that fit the block");
  }
}

/// Calls store(row, column, a, b) with the lanes of A X and B X that begin there.
template<class Store>
void ForEachRowPair(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X, Id first,
  Id last, Store&& store)
{
  for (Id row = first; row < last; ++row)
  {
    const auto put = [&](Id column)
    { return [&store, row, column](const auto& a, const auto& b) { store(row, column, a, b); }; };
    Id column = 0;
    for (; column + 16 <= X.cols(); column += 16)
    {
      RowPair<16>(A, B, X, row, column, put(column));
    }
    for (; column + 4 <= X.cols(); column += 4)
    {
      RowPair<4>(A, B, X, row, column, put(column));
    }
    for (; column < X.cols(); ++column)
    {
      RowPair<1>(A, B, X, row, column, put(column));
    }
  }
}

} // namespace

PairedProduct::PairedProduct(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X)
  : A_(A), B_(B), X_(X)
{
  CheckShapes(A, B, X);
}

void PairedProduct::Rows(Id begin, Id end, MultiVector& image) const
{
  const Id columns = X_.cols();
  ForEachRowPair(A_, B_, X_, begin, end,
    [&](Id row, Id column, const auto& a, const auto& b)
    {
      using Lanes = std::decay_t<decltype(a)>;
      double* to = image.data() + (row - begin) * 2 * columns + column;
      Eigen::Map<Lanes>{ to } = a;
      Eigen::Map<Lanes>{ to + columns } = b;
    });
}

void MultiplyRows(const SparseMatrix& A, const MultiVector& X, Id begin, Id end, MultiVector& image)
{
  if (A.columns != X.rows())
  {
    throw InvalidInput("a matrix does not fit the block it is multiplied with");
  }
  const RowView rows(A);
  ForEachChunk(X.cols(),
    [&](auto chunk)
    {
      for (Id row = begin; row < end; ++row)
      {
        chunk.Row(image.data(), static_cast<Index>(row - begin)) =
          RowProduct(rows, static_cast<Index>(row), X.data(), chunk);
      }
    });
}

void EigenResidual(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X,
  const Eigen::VectorXd& values, MultiVector& residual, int threads)
{
  CheckShapes(A, B, X);
  if (values.size() != X.cols())
  {
    throw InvalidInput("a residual needs a value for every column");
  }
  Reshape(residual, A.rows, X.cols());
  ParallelRanges(
    A.rows, threads,
    [&](Id begin, Id end)
    {
      ForEachRowPair(A, B, X, begin, end,
        [&](Id row, Id column, const auto& a, const auto& b)
        {
          using Lanes = std::decay_t<decltype(a)>;
          const Eigen::Map<const Lanes> theta(values.data() + column);
          Eigen::Map<Lanes>{ residual.data() + row * X.cols() + column } = a - theta * b;
        });
    },
    RangeSize);
}

} // namespace gridfem
