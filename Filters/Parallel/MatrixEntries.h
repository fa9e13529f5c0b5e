// Entries of a sparse matrix that come in any order, as other processes tell them.
#ifndef GridFEM_MatrixEntries_h
#define GridFEM_MatrixEntries_h

#include "Multigrid/Smoother.h"

#include <vector>

namespace gridfem
{

struct MatrixEntry
{
  Index row;
  Index column;
  double value;
};

/// A square matrix of so many rows: those of A, to which entries are added; entries of one place
/// are added up.
SparseMatrix SumOf(const SparseMatrix& A, std::vector<MatrixEntry> entries, Index rows);

/// Calls body(row, column, value) for entries whose row and column are in a list, places in it.
template<class Body>
void ForEntries(const SparseMatrix& A, const std::vector<Index>& list, Body&& body)
{
  std::vector<Index> place(A.rows, -1);
  for (std::size_t k = 0; k < list.size(); ++k)
  {
    place[list[k]] = static_cast<Index>(k);
  }
  for (const Index row : list)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      if (place[A.column[k]] >= 0)
      {
        body(MatrixEntry{ place[row], place[A.column[k]], A.value[k] });
      }
    }
  }
}

/// The rows and columns of a list.
SparseMatrix PartOf(const SparseMatrix& A, const std::vector<Index>& list);

/// An order of such a part becomes one of the whole.
PatchOrder InWhole(PatchOrder order, const std::vector<Index>& list);

} // namespace gridfem

#endif
