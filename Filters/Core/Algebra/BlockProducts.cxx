#include "Algebra/BlockProducts.h"

#include "Algebra/RowKernels.h"
#include "Base/Errors.h"

#include <type_traits>

namespace gridfem
{
namespace
{

/// Calls body(column, lanes) for groups of 32, 16, 4 and 1 columns. `lanes` only conveys its type.
template<class Sum, class Body>
inline void ForEachLanes(Id columns, Body&& body)
{
  Id column = 0;
  for (; column + 32 <= columns; column += 32)
  {
    body(column, Eigen::Array<Sum, 32, 1>());
  }
  for (; column + 16 <= columns; column += 16)
  {
    body(column, Eigen::Array<Sum, 16, 1>());
  }
  for (; column + 4 <= columns; column += 4)
  {
    body(column, Eigen::Array<Sum, 4, 1>());
  }
  for (; column < columns; ++column)
  {
    body(column, Eigen::Array<Sum, 1, 1>());
  }
}

/// Eight adjacent numbers at any address.
typedef float Floats __attribute__((vector_size(32), aligned(4), may_alias));
typedef double Doubles __attribute__((vector_size(64), aligned(8), may_alias));

/// Computes a += p x and b += q x for entries x of the same or lower precision.
template<class Real, class Lanes>
inline void AddProducts(double p, double q, const Real* x, Lanes& a, Lanes& b)
{
  if constexpr (std::is_same_v<Real, typename Lanes::Scalar>)
  {
    const Eigen::Map<const Lanes> entries(x);
    a += static_cast<Real>(p) * entries;
    b += static_cast<Real>(q) * entries;
  }
  else if constexpr (Lanes::RowsAtCompileTime % 8 == 0) // Eigen does not convert whole registers
  {
    for (int k = 0; k < Lanes::RowsAtCompileTime; k += 8)
    {
      const Doubles wide =
        __builtin_convertvector(*reinterpret_cast<const Floats*>(x + k), Doubles);
      *reinterpret_cast<Doubles*>(a.data() + k) += p * wide;
      *reinterpret_cast<Doubles*>(b.data() + k) += q * wide;
    }
  }
  else
  {
    for (int k = 0; k < Lanes::RowsAtCompileTime; ++k)
    {
      a.data()[k] += p * x[k];
      b.data()[k] += q * x[k];
    }
  }
}

/// Pointer to the entry of a block at (row, column).
template<class Real>
inline const Real* RowAt(const ConstBlock<Real>& X, Id row, Id column)
{
  return X.data() + row * X.outerStride() + column;
}

template<class Lanes, class Real>
inline void StoreLanes(const Lanes& lanes, Real* to)
{
#pragma omp simd
  for (int k = 0; k < Lanes::RowsAtCompileTime; ++k)
  {
    to[k] = static_cast<Real>(lanes.data()[k]);
  }
}

template<class Real>
void CheckShapes(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock<Real>& X)
{
  if (A.columns != X.rows() || B.rows != A.rows || B.columns != A.columns ||
      B.NonZeros() != A.NonZeros())
  {
    throw InvalidInput(
      "A paired product needs two matrices with the same pattern that fit the block.");
  }
}

/// Returns all columns of X from the first to the last of `columns`.
template<class Real>
ConstBlock<Real> Span(const ConstBlock<Real>& X, const std::vector<Index>& columns)
{
  return columns.empty() ? X.leftCols(0)
                         : X.middleCols(columns.front(), columns.back() + 1 - columns.front());
}

template<class Real>
std::vector<Index> CheckColumns(
  const ConstBlock<Real>& X, const Eigen::VectorXd& values, std::vector<Index> columns)
{
  if (values.size() != X.cols() || (!columns.empty() && columns.back() >= X.cols()))
  {
    throw InvalidInput("A residual needs a value for every column, and wanted columns among them.");
  }
  return columns;
}

/// Calls store(row, column, a, b) with the lanes of A X and B X that begin at (row, column), in the
/// precision of Sum.
template<class Sum, class Real, class Store>
void ForEachRowPair(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock<Real>& X,
  Id first, Id last, Store&& store)
{
  const RowView rows(A);
  const double* valueB = B.value.data();
  for (Id row = first; row < last; ++row)
  {
    ForEachLanes<Sum>(X.cols(),
      [&](Id column, auto lanes)
      {
        using Lanes = decltype(lanes);
        Lanes a = Lanes::Zero();
        Lanes b = Lanes::Zero();
        for (Id k = rows.begin[row]; k < rows.begin[row + 1]; ++k)
        {
          AddProducts(rows.value[k], valueB[k], RowAt(X, rows.column[k], column), a, b);
        }
        store(row, column, a, b);
      });
  }
}

} // namespace

template<class Real>
BlockProducts<Real>::BlockProducts(
  const SparseMatrix& A, const SparseMatrix& B, const ConstBlock<Real>& X)
  : A_(A), B_(B), X_(X)
{
  CheckShapes(A, B, X);
}

template<class Real>
void BlockProducts<Real>::Rows(Id begin, Id end, Vectors<Real>& image) const
{
  const Id columns = X_.cols();
  ForEachRowPair<double>(A_, B_, X_, begin, end,
    [&](Id row, Id column, const auto& a, const auto& b)
    {
      Real* const to = image.data() + (row - begin) * 2 * columns + column;
      StoreLanes(a, to);
      StoreLanes(b, to + columns);
    });
}

template class BlockProducts<float>;
template class BlockProducts<double>;

template<class Real>
void MultiplyRows(
  const SparseMatrix& A, const ConstBlock<Real>& X, Id begin, Id end, Block<Real> image)
{
  if (A.columns != X.rows())
  {
    throw InvalidInput("A matrix does not fit the block that it is multiplied with.");
  }
  const RowView rows(A);
  for (Id row = begin; row < end; ++row)
  {
    ForEachLanes<double>(X.cols(),
      [&](Id column, auto lanes)
      {
        using Lanes = decltype(lanes);
        Lanes sum = Lanes::Zero();
        for (Id k = rows.begin[row]; k < rows.begin[row + 1]; ++k)
        {
          const Real* const x = RowAt(X, rows.column[k], column);
          const Eigen::Map<const Eigen::Array<Real, Lanes::RowsAtCompileTime, 1>> entries(x);
          sum += rows.value[k] * entries.template cast<double>();
        }
        StoreLanes(sum, image.data() + (row - begin) * image.outerStride() + column);
      });
  }
}

template void MultiplyRows<float>(
  const SparseMatrix&, const ConstBlock<float>&, Id, Id, Block<float>);
template void MultiplyRows<double>(
  const SparseMatrix&, const ConstBlock<double>&, Id, Id, Block<double>);

template<class Real>
void MultiplyBlock(const SparseMatrix& A, const ConstBlock<Real>& X, Block<Real> Y, int threads)
{
  ParallelRanges(A.rows, threads,
    [&](Id begin, Id end)
    { MultiplyRows<Real>(A, X, begin, end, Y.middleRows(begin, end - begin)); });
}

template void MultiplyBlock<float>(
  const SparseMatrix&, const ConstBlock<float>&, Block<float>, int);
template void MultiplyBlock<double>(
  const SparseMatrix&, const ConstBlock<double>&, Block<double>, int);

template<class Real>
EigenResidual<Real>::EigenResidual(const SparseMatrix& A, const SparseMatrix& B,
  const ConstBlock<Real>& X, const Eigen::VectorXd& values, std::vector<Index> columns)
  : A_(A), B_(B), columns_(CheckColumns<Real>(X, values, std::move(columns))),
    X_(Span(X, columns_)),
    values_(values.segment(columns_.empty() ? 0 : columns_.front(), X_.cols())
              .template cast<Real>()
              .array())
{
  CheckShapes(A, B, X);
}

template<class Real>
void EigenResidual<Real>::Rows(Id begin, Id end, Block<Real> rows) const
{
  const auto compute = [&](Real* to, Id stride)
  {
    ForEachRowPair<Real>(A_, B_, X_, begin, end,
      [&](Id row, Id column, const auto& a, const auto& b)
      {
        using Lanes = std::decay_t<decltype(a)>;
        const Eigen::Map<const Lanes> theta(values_.data() + column);
        Eigen::Map<Lanes>{ to + (row - begin)* stride + column } = a - theta * b;
      });
  };
  const Id count = static_cast<Id>(columns_.size());
  if (count == X_.cols())
  {
    compute(rows.data(), rows.outerStride());
    return;
  }
  Vectors<Real> all(end - begin, X_.cols());
  compute(all.data(), all.cols());
  for (Id row = 0; row < end - begin; ++row)
  {
    for (Id j = 0; j < count; ++j)
    {
      rows(row, j) = all(row, columns_[j] - columns_.front());
    }
  }
}

template class EigenResidual<float>;
template class EigenResidual<double>;

} // namespace gridfem
