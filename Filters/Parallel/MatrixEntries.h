// Entries of a sparse matrix that come in any order, as other processes tell them.
#ifndef GridFEM_MatrixEntries_h
#define GridFEM_MatrixEntries_h

#include "Algebra/SparseMatrix.h"

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

} // namespace gridfem

#endif
