#include "Algebra/SparseMatrix.h"

#include "Algebra/ColumnAlgebra.h"
#include "Base/Errors.h"
#include "Base/Grouping.h"

#include <algorithm>
#include <string>

namespace gridfem
{
namespace
{

void CheckRows(Id have, Id want, const char* what)
{
  if (have != want)
  {
    throw InvalidInput(std::string("A sparse matrix product needs ") + std::to_string(want) +
                       " rows of " + what + ", got " + std::to_string(have));
  }
}

/// Ranges are short, so that their part of the matrix stays in the cache while all chunks are
/// multiplied.
constexpr Id RowsPerRange = 1024;

/// Calls body(row, chunk, product) for rows begin .. end - 1 and every chunk. `product` is the row
/// times the chunk of x.
template<class Real, class Body>
void ForRows(const RowView<Real>& A, const Vectors<Real>& x, Id begin, Id end, Body&& body)
{
  ForEachChunk<Real>(x.cols(),
    [&](auto chunk)
    {
      for (Index row = static_cast<Index>(begin); row < end; ++row)
      {
        body(row, chunk, RowProduct(A, row, x.data(), chunk));
      }
    });
}

template<class Real, class Body>
void ForEachRow(const BasicSparseMatrix<Real>& A, const Vectors<Real>& x, int threads, Body&& body)
{
  const RowView rows(A);
  ParallelRanges(
    A.rows, ThreadsFor(A.NonZeros() * x.cols(), threads),
    [&](Id begin, Id end) { ForRows(rows, x, begin, end, body); }, RowsPerRange);
}

template<class Real>
void MultiplyAny(
  const BasicSparseMatrix<Real>& A, const Vectors<Real>& x, Vectors<Real>& y, int threads)
{
  CheckRows(x.rows(), A.columns, "x");
  y.resize(A.rows, x.cols());
  ForEachRow(A, x, threads,
    [&](Index row, auto chunk, const auto& product) { chunk.Row(y.data(), row) = product; });
}

template<class Real>
void MultiplyAddAny(
  const BasicSparseMatrix<Real>& A, const Vectors<Real>& x, Vectors<Real>& y, int threads)
{
  CheckRows(x.rows(), A.columns, "x");
  CheckRows(y.rows(), A.rows, "y");
  ForEachRow(A, x, threads,
    [&](Index row, auto chunk, const auto& product) { chunk.Row(y.data(), row) += product; });
}

} // namespace

template<class Real>
std::size_t BasicSparseMatrix<Real>::Memory() const
{
  return rowBegin.size() * sizeof(Id) + column.size() * sizeof(Index) + value.size() * sizeof(Real);
}

template<class Real>
Real BasicSparseMatrix<Real>::Coefficient(Index row, Index col) const
{
  const auto first = column.begin() + rowBegin[row];
  const auto last = column.begin() + rowBegin[row + 1];
  const auto found = std::lower_bound(first, last, col);
  return found != last && *found == col ? value[found - column.begin()] : Real(0);
}

template<class Real>
std::vector<Real> BasicSparseMatrix<Real>::Diagonal(int threads) const
{
  std::vector<Real> diagonal(std::min(rows, columns));
  ParallelRanges(static_cast<Id>(diagonal.size()), ThreadsFor(this->NonZeros(), threads),
    [&](Id begin, Id end)
    {
      for (Index row = static_cast<Index>(begin); row < end; ++row)
      {
        diagonal[row] = this->Coefficient(row, row);
      }
    });
  return diagonal;
}

template struct BasicSparseMatrix<float>;
template struct BasicSparseMatrix<double>;

BasicSparseMatrix<float> InSinglePrecision(const SparseMatrix& A, int threads)
{
  BasicSparseMatrix<float> single{ A.rows, A.columns, A.rowBegin, A.column, {} };
  single.value.resize(A.value.size());
  ParallelRanges(static_cast<Id>(A.value.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        single.value[k] = static_cast<float>(A.value[k]);
      }
    });
  return single;
}

void Multiply(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads)
{
  MultiplyAny(A, x, y, threads);
}

void Multiply(
  const BasicSparseMatrix<float>& A, const Vectors<float>& x, Vectors<float>& y, int threads)
{
  MultiplyAny(A, x, y, threads);
}

void MultiplyAdd(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads)
{
  MultiplyAddAny(A, x, y, threads);
}

void MultiplyAdd(
  const BasicSparseMatrix<float>& A, const Vectors<float>& x, Vectors<float>& y, int threads)
{
  MultiplyAddAny(A, x, y, threads);
}

void Residual(
  const SparseMatrix& A, const MultiVector& x, const MultiVector& b, MultiVector& r, int threads)
{
  ResidualPart<double>(A, x, b, 0, r, nullptr, threads);
}

template<class Real>
void ResidualPart(const BasicSparseMatrix<Real>& A, const Vectors<Real>& x, const Vectors<Real>& b,
  Index ghosts, Vectors<Real>& r, Eigen::ArrayXd* energy, int threads)
{
  CheckRows(x.rows(), A.columns, "x");
  CheckRows(b.rows(), A.rows, "b");
  r.resize(A.rows, x.cols());
  const RowView rows(A);
  const int team = ThreadsFor(A.NonZeros() * x.cols(), threads);
  const auto fill = [&](Id begin, Id end)
  {
    ForRows(rows, x, begin, end,
      [&](Index row, auto chunk, const auto& product)
      {
        auto to = chunk.Row(r.data(), row);
        if (row < ghosts)
        {
          to = -product;
        }
        else
        {
          to = chunk.Row(b.data(), row) - product;
        }
      });
  };
  if (!energy)
  {
    ParallelRanges(A.rows, team, fill, RowsPerRange);
    return;
  }
  *energy = ParallelSum(
    A.rows, team, Columns(Columns::Zero(x.cols())),
    [&](Id begin, Id end) -> Columns
    {
      fill(begin, end);
      return RowProducts(x, r, begin, end) + RowProducts(x, b, std::max<Id>(begin, ghosts), end);
    },
    RowsPerRange);
}

template void ResidualPart(const BasicSparseMatrix<float>&, const Vectors<float>&,
  const Vectors<float>&, Index, Vectors<float>&, Eigen::ArrayXd*, int);
template void ResidualPart(const SparseMatrix&, const MultiVector&, const MultiVector&, Index,
  MultiVector&, Eigen::ArrayXd*, int);

void Combine(double a, const SparseMatrix& A, double b, const SparseMatrix& B, SparseMatrix& result,
  int threads)
{
  if (result.value.empty() || result.rows != A.rows || result.NonZeros() != A.NonZeros())
  {
    result = B;
  }
  ParallelRanges(result.NonZeros(), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        result.value[k] = a * A.value[k] + b * B.value[k];
      }
    });
}

MultiVector RowSums(const SparseMatrix& A, int threads)
{
  MultiVector sums;
  Multiply(A, MultiVector::Ones(A.columns, 1), sums, threads);
  return sums;
}

void DivideRows(const MultiVector& by, SparseMatrix& A, int threads)
{
  ParallelRanges(A.rows, threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
        {
          A.value[k] /= by(row, 0);
        }
      }
    });
}

SparseMatrix Transpose(const SparseMatrix& A, int threads)
{
  const Groups entries = GroupItems(A.column.data(), A.NonZeros(), A.columns, threads);
  Array<Index> rowOf(A.NonZeros());
  ParallelRanges(A.rows, threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        std::fill(rowOf.begin() + A.rowBegin[row], rowOf.begin() + A.rowBegin[row + 1],
          static_cast<Index>(row));
      }
    });
  SparseMatrix T;
  T.rows = A.columns;
  T.columns = A.rows;
  T.value.resize(A.value.size());
  Array<Index> column(A.column.size());
  ParallelRanges(A.NonZeros(), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        column[k] = rowOf[entries.item[k]];
        T.value[k] = A.value[entries.item[k]];
      }
    });
  T.rowBegin = Array<Id>(entries.begin.begin(), entries.begin.end());
  T.column = std::move(column);
  return T;
}

} // namespace gridfem
