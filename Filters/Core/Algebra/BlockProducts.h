// Multiplies stiffness and mass by the same block of vectors in one pass. The two matrices share
// their pattern, so every row of the block is fetched once. Eigenproblems multiply by hundreds of
// columns. Blocks may be in single precision; sums are in double precision, except for residuals.
#ifndef GridFEM_BlockProducts_h
#define GridFEM_BlockProducts_h

#include "Algebra/BlockVectors.h"
#include "Algebra/SparseMatrix.h"

#include <vector>

namespace gridfem
{

/// Computes [A X, B X] side by side, some rows at a time, for two matrices with the same pattern.
/// Keeps references to its arguments. Throws InvalidInput when the shapes do not fit.
template<class Real>
class BlockProducts
{
public:
  BlockProducts(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock<Real>& X);

  /// Computes rows begin .. end - 1 and stores them from the first row of `image` on. `image` has 2
  /// X.cols() columns.
  void Rows(Id begin, Id end, Vectors<Real>& image) const;

private:
  const SparseMatrix& A_;
  const SparseMatrix& B_;
  ConstBlock<Real> X_;
};

/// Computes rows begin .. end - 1 of A X and stores them from the first row of `image` on. `image`
/// has X.cols() columns. Throws InvalidInput when the shapes do not fit.
template<class Real>
void MultiplyRows(
  const SparseMatrix& A, const ConstBlock<Real>& X, Id begin, Id end, Block<Real> image);

/// Computes Y = A X for columns of wider blocks, under the same conditions.
template<class Real>
void MultiplyBlock(
  const SparseMatrix& A, const ConstBlock<Real>& X, Block<Real> Y, int threads = 0);

/// Computes columns of A X - B X diag(values), a few rows at a time. A and B have the same pattern.
/// Sums are in the precision of X, because the rounding of X itself is as large. Keeps references
/// to A, B and X.
template<class Real>
class EigenResidual
{
public:
  /// @param values   one number per column of X
  /// @param columns  the wanted columns of X, ascending; every column between the first and the
  ///   last costs time
  /// Throws InvalidInput when the shapes do not fit.
  EigenResidual(const SparseMatrix& A, const SparseMatrix& B, const ConstBlock<Real>& X,
    const Eigen::VectorXd& values, std::vector<Index> columns);

  /// Computes rows begin .. end - 1 of the wanted columns.
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
