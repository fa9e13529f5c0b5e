// Makes the rows of a sparse matrix in parallel.
#ifndef GridFEM_FillRows_h
#define GridFEM_FillRows_h

#include "Algebra/SparseMatrix.h"
#include "Base/PerThreadLists.h"

#include <algorithm>
#include <utility>

namespace gridfem
{

/// Fills a matrix whose shape is already set. row(r, columns, values) appends the entries of row r.
/// For a mere pattern it appends no values.
template<class Row>
void FillRows(SparseMatrix& matrix, int threads, Row&& row)
{
  const Id blocks = (Id(matrix.rows) + DefaultBlockSize - 1) / DefaultBlockSize;
  PerThreadLists<Index> columns(blocks, threads);
  PerThreadLists<double> values(blocks, threads);
  Array<Id> rowBegin(Id(matrix.rows) + 1, 0);
  const auto fillBlock = [&](Id block, Array<Index>& column, Array<double>& value)
  {
    const Id end = std::min<Id>(matrix.rows, (block + 1) * DefaultBlockSize);
    for (Id r = block * DefaultBlockSize; r < end; ++r)
    {
      const std::size_t before = column.size();
      row(static_cast<Index>(r), column, value);
      rowBegin[r] = static_cast<Id>(column.size() - before);
    }
  };
  ParallelBlocks(blocks, threads,
    [&](Id block, int thread)
    {
      columns.Make(block, thread,
        [&](Array<Index>& column) {
          values.Make(
            block, thread, [&](Array<double>& value) { fillBlock(block, column, value); });
        });
    });
  ExclusiveScan(rowBegin);
  Array<Index> column;
  columns.AppendTo(column, threads);
  values.AppendTo(matrix.value, threads);
  matrix.rowBegin = std::move(rowBegin);
  matrix.column = std::move(column);
}

} // namespace gridfem

#endif
