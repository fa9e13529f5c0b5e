// A sparse matrix in compressed row format. Its products handle several vectors at once, in single
// or double precision.
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
  SharedArray<Id> rowBegin;  // rows + 1 entries
  SharedArray<Index> column; // ascending in each row
  Array<Real> value;

  Id NonZeros() const { return static_cast<Id>(column.size()); }
  std::size_t Memory() const;

  /// The value at (row, column), or 0 if there is no entry.
  Real Coefficient(Index row, Index col) const;

  std::vector<Real> Diagonal(int threads = 1) const;
};

using SparseMatrix = BasicSparseMatrix<double>;

/// Returns A in single precision. The copy shares the pattern of A.
BasicSparseMatrix<float> InSinglePrecision(const SparseMatrix& A, int threads = 0);

/// An immutable matrix that several hierarchies can share.
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

/// Computes y = A x; y must not be x. Multiply, MultiplyAdd and Residual throw InvalidInput when
/// shapes do not fit. Same bits for any number of threads.
void Multiply(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads = 0);
void Multiply(
  const BasicSparseMatrix<float>& A, const Vectors<float>& x, Vectors<float>& y, int threads = 0);

/// Computes y += A x.
void MultiplyAdd(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads = 0);
void MultiplyAdd(
  const BasicSparseMatrix<float>& A, const Vectors<float>& x, Vectors<float>& y, int threads = 0);

/// Computes r = b - A x; r may be b.
void Residual(const SparseMatrix& A, const MultiVector& x, const MultiVector& b, MultiVector& r,
  int threads = 0);

/// Computes this process's part of the residual. It leaves out b in the rows before `ghosts`,
/// because these rows belong to other processes.
/// @param energy  if not null: receives this process's part of xᵀ(b + r) for every column; r must
///   not be b then
template<class Real>
void ResidualPart(const BasicSparseMatrix<Real>& A, const Vectors<Real>& x, const Vectors<Real>& b,
  Index ghosts, Vectors<Real>& r, Eigen::ArrayXd* energy, int threads);

/// Computes a A + b B for matrices with the same pattern, in place if `result` has it. Same bits
/// for any number of threads.
void Combine(double a, const SparseMatrix& A, double b, const SparseMatrix& B, SparseMatrix& result,
  int threads = 0);

/// Returns A times a vector of ones, as one column.
MultiVector RowSums(const SparseMatrix& A, int threads = 0);

/// Divides each row r by by(r, 0). Rows without entries stay unchanged.
void DivideRows(const MultiVector& by, SparseMatrix& A, int threads = 0);

SparseMatrix Transpose(const SparseMatrix& A, int threads = 0);

} // namespace gridfem

#endif
