// Columns of a block of vectors: made, selected, multiplied. Used by the block iteration.
#ifndef GridFEM_BlockVectors_h
#define GridFEM_BlockVectors_h

#include "Types.h"

#include <vector>

namespace gridfem
{

/// Makes room for a block of this shape, in large pages where it is large; its numbers are lost
/// where the shape changes.
void Reshape(MultiVector& X, Id rows, Id columns);

/// Uniform in [-1, 1), the same on every platform.
MultiVector RandomColumns(Id rows, Id columns);

/// The columns of X with these numbers, in this order.
MultiVector SelectColumns(const MultiVector& X, const std::vector<Index>& columns, int threads = 0);

/// xᵀ y for every pair of columns. Same bits for any number of threads.
Eigen::VectorXd ColumnDots(const MultiVector& X, const MultiVector& Y, int threads = 0);

} // namespace gridfem

#endif
