// A sparse matrix in compressed rows, with products for several vectors at once, in single or
// double precision.
#ifndef GridFEM_SparseMatrix_h
#define GridFEM_SparseMatrix_h

#include "Base/SharedArray.h"

#include <vector>

namespace gridfem
{

template<class Real>
struct BasicSparseMatrix
{
  Index rows = 0;
  Index columns = 0;
  SharedArray<Id> rowBegin;  // rows + 1
  SharedArray<Index> column; // ascending in each row
  Array<Real> value;

  Id NonZeros() const { return static_cast<Id>(column.size()); }
  std::size_t Memory() const;

  /// Value at (row, column), 0 where there is no entry.
  Real Coefficient(Index row, Index col) const;

  std::vector<Real> Diagonal(int threads = 1) const;
};

using SparseMatrix = BasicSparseMatrix<double>;

/// The same in single precision; the pattern is shared.
BasicSparseMatrix<float> InSinglePrecision(const SparseMatrix& A, int threads = 0);

/// A matrix that never changes once it is made, so that hierarchies can share it.
template<class Real>
class BasicSharedMatrix
{
public:
  using Matrix = BasicSparseMatrix<Real>;

  BasicSharedMatrix() : BasicSharedMatrix(Matrix()) {}
  BasicSharedMatrix(Matrix matrix) : matrix_(std::make_shared<const Matrix>(std::move(matrix))) {}

  operator const Matrix&() const { return *matrix_; }
  const Matrix* operator->() const { return matrix_.get(); }

private:
  std::shared_ptr<const Matrix> matrix_;
};

using SharedMatrix = BasicSharedMatrix<double>;

/// y = A x; y must not be x. Throws InvalidInput, as the next two, when shapes do not fit. Same
/// bits for any number of threads.
void Multiply(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads = 0);
void Multiply(
  const BasicSparseMatrix<float>& A, const Vectors<float>& x, Vectors<float>& y, int threads = 0);

/// y += A x.
void MultiplyAdd(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads = 0);
void MultiplyAdd(
  const BasicSparseMatrix<float>& A, const Vectors<float>& x, Vectors<float>& y, int threads = 0);

/// r = b - A x; r may be b.
void Residual(const SparseMatrix& A, const MultiVector& x, const MultiVector& b, MultiVector& r,
  int threads = 0);

/// The same where rows before `foreign` leave out b, which belongs to other processes: a part of
/// the residual.
/// @param energy  if not null: xᵀ(b + r) of every column, a part, too; r must not be b then
template<class Real>
void ResidualPart(const BasicSparseMatrix<Real>& A, const Vectors<Real>& x, const Vectors<Real>& b,
  Index foreign, Vectors<Real>& r, Eigen::ArrayXd* energy, int threads);

/// A column: A times ones.
MultiVector RowSums(const SparseMatrix& A, int threads = 0);

/// Divides each row by a number. Rows without entries stay as they are.
void DivideRows(const MultiVector& by, SparseMatrix& A, int threads = 0);

SparseMatrix Transpose(const SparseMatrix& A, int threads = 0);

} // namespace gridfem

#endif
