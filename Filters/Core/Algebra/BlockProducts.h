// Stiffness and mass times the same block of vectors in one pass: the two matrices share their
// pattern, so every row of the block is fetched once. Eigenproblems multiply by hundreds of
// columns. Blocks may be in single precision; sums are in double but for residuals.
#ifndef GridFEM_BlockProducts_h
#define GridFEM_BlockProducts_h

#include "Algebra/BlockVectors.h"
#include "Algebra/SparseMatrix.h"

#include <vector>

namespace gridfem
{

/// [A X, B X] side by side, for matrices of one pattern, some rows at a time. Keeps references.
/// Throws InvalidInput when the shapes do not fit.
template<class Real>
class BlockProducts
{
public:
  BlockProducts(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock<Real>& X);

  /// The rows begin .. end - 1, from the first row of `image` on, which has 2 X.cols() columns.
  void Rows(Id begin, Id end, Vectors<Real>& image) const;

private:
  const SparseMatrix& A_;
  const SparseMatrix& B_;
  ConstBlock<Real> X_;
};

/// The rows begin .. end - 1 of A X, from the first row of `image` on, which has X.cols() columns.
/// Throws InvalidInput when the shapes do not fit.
template<class Real>
void MultiplyRows(
  const SparseMatrix& A, const ConstBlock<Real>& X, Id begin, Id end, Block<Real> image);

/// Y = A X for columns of wider blocks, under the same conditions.
template<class Real>
void MultiplyBlock(
  const SparseMatrix& A, const ConstBlock<Real>& X, Block<Real> Y, int threads = 0);

/// Columns of A X - B X diag(values), a few rows at a time. A and B have the same pattern. Sums are
/// in the precision of X, whose own rounding is as large. Keeps references.
template<class Real>
class EigenResidual
{
public:
  /// @param values   one per column of X
  /// @param columns  of X that are wanted, ascending; all between the first and the last cost time
  /// Throws InvalidInput when the shapes do not fit.
  EigenResidual(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock<Real>& X,
    const Eigen::VectorXd& values, std::vector<Index> columns);

  /// The rows begin .. end - 1 of the wanted columns.
  void Rows(Id begin, Id end, Block<Real> rows) const;

private:
  const SparseMatrix& A_;
  const SparseMatrix& B_;
  std::vector<Index> columns_;
  ConstBlock<Real> X_; // from the first wanted column to the last
  Eigen::Array<Real, Eigen::Dynamic, 1> values_;
};

} // namespace gridfem

#endif
