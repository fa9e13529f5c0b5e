// Sparse matrices whose rows are made in parallel.
#ifndef GridFEM_FillRows_h
#define GridFEM_FillRows_h

#include "Parallel.h"
#include "SparseMatrix.h"

#include <algorithm>

namespace gridfem
{

/// Fills a matrix whose shape is set from rows made block by block: row(r, columns, values) appends
/// one row's entries; a pattern's rows have no values.
template<class Row>
void FillRows(SparseMatrix& matrix, int threads, Row&& row)
{
  struct Part
  {
    Array<Index> column;
    Array<double> value;
  };
  const Id blocks = (Id(matrix.rows) + DefaultBlockSize - 1) / DefaultBlockSize;
  std::vector<Part> parts(blocks);
  Array<Id> rowBegin(Id(matrix.rows) + 1, 0);
  ParallelRanges(matrix.rows, threads,
    [&](Id begin, Id end)
    {
      Part& part = parts[begin / DefaultBlockSize];
      for (Id r = begin; r < end; ++r)
      {
        const std::size_t before = part.column.size();
        row(static_cast<Index>(r), part.column, part.value);
        rowBegin[r] = static_cast<Id>(part.column.size() - before);
      }
    });
  Array<Index> column(ExclusiveScan(rowBegin));
  const bool hasValues =
    std::any_of(parts.begin(), parts.end(), [](const Part& part) { return !part.value.empty(); });
  matrix.value.resize(hasValues ? column.size() : 0);
  ParallelBlocks(blocks, threads,
    [&](Id block)
    {
      const Id begin = rowBegin[block * DefaultBlockSize];
      const Part part = std::move(parts[block]);
      std::copy(part.column.begin(), part.column.end(), column.begin() + begin);
      std::copy(part.value.begin(), part.value.end(), matrix.value.begin() + begin);
    });
  matrix.rowBegin = std::move(rowBegin);
  matrix.column = std::move(column);
}

} // namespace gridfem

#endif
