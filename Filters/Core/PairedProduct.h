// Stiffness and mass times the same block of vectors in one pass: the two matrices share their
// pattern, so every row of the block is fetched once. Eigenproblems multiply by hundreds of
// columns.
#ifndef GridFEM_PairedProduct_h
#define GridFEM_PairedProduct_h

#include "SparseMatrix.h"

namespace gridfem
{

/// pair = [A X, B X] side by side, for matrices of one pattern; pair must not be X. Throws
/// InvalidInput when the shapes do not fit. Same bits for any number of threads.
void MultiplyPair(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X,
  MultiVector& pair, int threads = 0);

/// residual = A X - B X diag(values), under the same conditions.
void EigenResidual(const SparseMatrix& A, const SparseMatrix& B, const MultiVector& X,
  const Eigen::VectorXd& values, MultiVector& residual, int threads = 0);

} // namespace gridfem

#endif
