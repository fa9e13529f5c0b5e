#include "Algebra/SparseMatrix.h"

#include "Algebra/RowKernels.h"
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
    throw InvalidInput(std::string("a sparse matrix product needs ") + std::to_string(want) +
                       " rows of " + what + ", got " + std::to_string(have));
  }
}

/// Calls body(row, chunk, product of the row with the chunk of x) for every row and chunk.
template<class Body>
void ForEachRow(const SparseMatrix& A, const MultiVector& x, int threads, Body&& body)
{
  // Short ranges keep their part of the matrix in the cache while chunk after chunk passes.
  constexpr Id RowsPerRange = 1024;
  const RowView rows(A);
  ParallelRanges(
    A.rows, ThreadsFor(A.NonZeros() * x.cols(), threads),
    [&](Id begin, Id end)
    {
      ForEachChunk(x.cols(),
        [&](auto chunk)
        {
          for (Index row = static_cast<Index>(begin); row < end; ++row)
          {
            body(row, chunk, RowProduct(rows, row, x.data(), chunk));
          }
        });
    },
    RowsPerRange);
}

} // namespace

double SparseMatrix::Coefficient(Index row, Index col) const
{
  const auto first = column.begin() + rowBegin[row];
  const auto last = column.begin() + rowBegin[row + 1];
  const auto found = std::lower_bound(first, last, col);
  return found != last && *found == col ? value[found - column.begin()] : 0.0;
}

std::vector<double> SparseMatrix::Diagonal(int threads) const
{
  std::vector<double> diagonal(std::min(rows, columns));
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

void Multiply(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads)
{
  CheckRows(x.rows(), A.columns, "x");
  y.resize(A.rows, x.cols());
  ForEachRow(A, x, threads,
    [&](Index row, auto chunk, const auto& product) { chunk.Row(y.data(), row) = product; });
}

void MultiplyAdd(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads)
{
  CheckRows(x.rows(), A.columns, "x");
  CheckRows(y.rows(), A.rows, "y");
  ForEachRow(A, x, threads,
    [&](Index row, auto chunk, const auto& product) { chunk.Row(y.data(), row) += product; });
}

void Residual(
  const SparseMatrix& A, const MultiVector& x, const MultiVector& b, MultiVector& r, int threads)
{
  CheckRows(x.rows(), A.columns, "x");
  CheckRows(b.rows(), A.rows, "b");
  r.resize(A.rows, x.cols());
  ForEachRow(A, x, threads,
    [&](Index row, auto chunk, const auto& product)
    { chunk.Row(r.data(), row) = chunk.Row(b.data(), row) - product; });
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
