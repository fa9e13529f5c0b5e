#include "PairedProduct.h"

#include "Errors.h"
#include "RowKernels.h"

#include <type_traits>

namespace gridfem
{
namespace
{

/// Calls body(column, lanes) for groups of 16, 4 and 1 columns; lanes gives their type.
template<class Body>
inline void ForEachLanes(Id columns, Body&& body)
{
  Id column = 0;
  for (; column + 16 <= columns; column += 16)
  {
    body(column, Eigen::Array<double, 16, 1>());
  }
  for (; column + 4 <= columns; column += 4)
  {
    body(column, Eigen::Array<double, 4, 1>());
  }
  for (; column < columns; ++column)
  {
    body(column, Eigen::Array<double, 1, 1>());
  }
}

template<class Lanes>
inline Eigen::Map<const Lanes> LanesAt(const ConstBlock& X, Id row, Id column)
{
  return Eigen::Map<const Lanes>(X.data() + row * X.outerStride() + column);
}

void CheckShapes(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock& X)
{
  if (A.columns != X.rows() || B.rows != A.rows || B.columns != A.columns ||
      B.NonZeros() != A.NonZeros())
  {
    throw InvalidInput("a paired product needs two matrices of one pattern that fit the block");
  }
}

/// Calls store(row, column, a, b) with the lanes of A X and B X that begin there.
template<class Store>
void ForEachRowPair(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock& X, Id first,
  Id last, Store&& store)
{
  const RowView rows(A);
  const double* valueB = B.value.data();
  for (Id row = first; row < last; ++row)
  {
    ForEachLanes(X.cols(),
      [&](Id column, auto lanes)
      {
        using Lanes = decltype(lanes);
        Lanes a = Lanes::Zero();
        Lanes b = Lanes::Zero();
        for (Id k = rows.begin[row]; k < rows.begin[row + 1]; ++k)
        {
          const auto x = LanesAt<Lanes>(X, rows.column[k], column);
          a += rows.value[k] * x;
          b += valueB[k] * x;
        }
        store(row, column, a, b);
      });
  }
}

} // namespace

PairedProduct::PairedProduct(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock& X)
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

void MultiplyRows(const SparseMatrix& A, const ConstBlock& X, Id begin, Id end, MultiVector& image)
{
  if (A.columns != X.rows())
  {
    throw InvalidInput("a matrix does not fit the block it is multiplied with");
  }
  const RowView rows(A);
  for (Id row = begin; row < end; ++row)
  {
    ForEachLanes(X.cols(),
      [&](Id column, auto lanes)
      {
        using Lanes = decltype(lanes);
        Lanes sum = Lanes::Zero();
        for (Id k = rows.begin[row]; k < rows.begin[row + 1]; ++k)
        {
          sum += rows.value[k] * LanesAt<Lanes>(X, rows.column[k], column);
        }
        Eigen::Map<Lanes>{ image.data() + (row - begin) * X.cols() + column } = sum;
      });
  }
}

EigenResidual::EigenResidual(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock& X,
  const Eigen::VectorXd& values, std::vector<Index> columns)
  : A_(A), B_(B), columns_(std::move(columns)),
    X_(X.middleCols(columns_.at(0), columns_.back() + 1 - columns_.front())),
    values_(values.segment(columns_.front(), X_.cols()))
{
  CheckShapes(A, B, X);
  if (values.size() != X.cols() || columns_.back() >= X.cols())
  {
    throw InvalidInput("a residual needs a value for every column, and wanted columns of these");
  }
}

void EigenResidual::Rows(Id begin, Id end, MultiVector& rows) const
{
  const auto compute = [&](double* to, Id stride)
  {
    ForEachRowPair(A_, B_, X_, begin, end,
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
    compute(rows.data(), rows.cols());
    return;
  }
  MultiVector all(end - begin, X_.cols());
  compute(all.data(), all.cols());
  for (Id row = 0; row < end - begin; ++row)
  {
    for (Id j = 0; j < count; ++j)
    {
      rows(row, j) = all(row, columns_[j] - columns_.front());
    }
  }
}

} // namespace gridfem
