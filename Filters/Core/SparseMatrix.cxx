#include "SparseMatrix.h"

#include "Errors.h"
#include "RowKernels.h"

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

SparseMatrix Transpose(const SparseMatrix& A)
{
  SparseMatrix T;
  T.rows = A.columns;
  T.columns = A.rows;
  Array<Id> rowBegin(T.rows + 1, 0);
  Array<Index> column(A.column.size());
  T.value.resize(A.value.size());
  for (const Index col : A.column)
  {
    ++rowBegin[col];
  }
  ExclusiveScan(rowBegin);
  T.rowBegin = rowBegin;
  Array<Id>& next = rowBegin;
  for (Index row = 0; row < A.rows; ++row)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      const Id place = next[A.column[k]]++;
      column[place] = row;
      T.value[place] = A.value[k];
    }
  }
  T.column = std::move(column);
  return T;
}

} // namespace gridfem
