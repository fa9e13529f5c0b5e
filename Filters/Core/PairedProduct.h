// Stiffness and mass times the same block of vectors in one pass: the two matrices share their
// pattern, so every row of the block is fetched once. Eigenproblems multiply by hundreds of
// columns.
#ifndef GridFEM_PairedProduct_h
#define GridFEM_PairedProduct_h

#include "BlockVectors.h"
#include "SparseMatrix.h"

namespace gridfem
{

/// [A X, B X] side by side, for matrices of one pattern, some rows at a time. Keeps references.
/// Throws InvalidInput when the shapes do not fit.
class PairedProduct
{
public:
  PairedProduct(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock& X);

  /// The rows begin .. end - 1, from the first row of `image` on, which has 2 X.cols() columns.
  void Rows(Id begin, Id end, MultiVector& image) const;

private:
  const SparseMatrix& A_;
  const SparseMatrix& B_;
  ConstBlock X_;
};

/// The rows begin .. end - 1 of A X, from the first row of `image` on, which has X.cols() columns.
/// Throws InvalidInput when the shapes do not fit.
void MultiplyRows(const SparseMatrix& A, const ConstBlock& X, Id begin, Id end, MultiVector& image);

/// residual = A X - B X diag(values) for matrices of one pattern; residual has the shape of X and
/// its rows lie one behind the other. Throws InvalidInput when the shapes do not fit. Same bits for
/// any number of threads.
void EigenResidual(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock& X,
  const Eigen::VectorXd& values, Block residual, int threads = 0);

} // namespace gridfem

#endif
