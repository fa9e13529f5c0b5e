// Entries of a sparse matrix in any order, as other processes send them.
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

/// The sum of A and the entries, as a square matrix with `rows` rows. Entries at one place are
/// added up.
SparseMatrix SumOf(const SparseMatrix& A, std::vector<MatrixEntry> entries, Index rows);

/// Calls body(row, column, value) for entries whose row and column are in a list. Row and column
/// are given as places in the list.
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

/// The part of A with the rows and columns in a list.
SparseMatrix PartOf(const SparseMatrix& A, const std::vector<Index>& list);

/// Converts an order of such a part to an order of the whole matrix.
PatchOrder InWhole(PatchOrder order, const std::vector<Index>& list);

} // namespace gridfem

#endif
