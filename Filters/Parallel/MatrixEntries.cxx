#include "Parallel/MatrixEntries.h"

#include "Algebra/RowBuilder.h"

#include <algorithm>

namespace gridfem
{

SparseMatrix SumOf(const SparseMatrix& A, std::vector<MatrixEntry> entries, Index rows)
{
  std::sort(entries.begin(), entries.end(),
    [](const MatrixEntry& a, const MatrixEntry& b) { return a.row < b.row; });
  RowBuilder sum;
  RowBuilder::Entries ofRow;
  std::size_t next = 0;
  for (Index row = 0; row < rows; ++row)
  {
    ofRow.clear();
    for (Id k = row < A.rows ? A.rowBegin[row] : 0; row < A.rows && k < A.rowBegin[row + 1]; ++k)
    {
      ofRow.emplace_back(A.column[k], A.value[k]);
    }
    for (; next < entries.size() && entries[next].row == row; ++next)
    {
      ofRow.emplace_back(entries[next].column, entries[next].value);
    }
    sum.Append(ofRow);
  }
  return sum.Finish(rows);
}

PatchOrder InWhole(PatchOrder order, const std::vector<Index>& list)
{
  for (Index& unknown : order.dof.unknown)
  {
    unknown = unknown < 0 ? unknown : list[unknown];
  }
  return order;
}

SparseMatrix PartOf(const SparseMatrix& A, const std::vector<Index>& list)
{
  std::vector<MatrixEntry> entries;
  ForEntries(A, list, [&](const MatrixEntry& entry) { entries.push_back(entry); });
  return SumOf({}, std::move(entries), static_cast<Index>(list.size()));
}

} // namespace gridfem
