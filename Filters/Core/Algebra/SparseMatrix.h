// A sparse matrix in compressed rows, with products for several vectors at once.
#ifndef GridFEM_SparseMatrix_h
#define GridFEM_SparseMatrix_h

#include "Base/SharedArray.h"

#include <vector>

namespace gridfem
{

struct SparseMatrix
{
  Index rows = 0;
  Index columns = 0;
  SharedArray<Id> rowBegin;  // rows + 1
  SharedArray<Index> column; // ascending in each row
  Array<double> value;

  Id NonZeros() const { return static_cast<Id>(column.size()); }

  /// Value at (row, column), 0 where there is no entry.
  double Coefficient(Index row, Index col) const;

  std::vector<double> Diagonal(int threads = 1) const;
};

/// A matrix that never changes once it is made, so that hierarchies can share it.
class SharedMatrix
{
public:
  SharedMatrix() : SharedMatrix(SparseMatrix()) {}
  SharedMatrix(SparseMatrix matrix)
    : matrix_(std::make_shared<const SparseMatrix>(std::move(matrix)))
  {
  }

  operator const SparseMatrix&() const { return *matrix_; }
  const SparseMatrix* operator->() const { return matrix_.get(); }

private:
  std::shared_ptr<const SparseMatrix> matrix_;
};

/// y = A x; y must not be x. Throws InvalidInput, as the next two, when shapes do not fit. Same
/// bits for any number of threads.
void Multiply(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads = 0);

/// y += A x.
void MultiplyAdd(const SparseMatrix& A, const MultiVector& x, MultiVector& y, int threads = 0);

/// r = b - A x; r may be b.
void Residual(const SparseMatrix& A, const MultiVector& x, const MultiVector& b, MultiVector& r,
  int threads = 0);

SparseMatrix Transpose(const SparseMatrix& A, int threads = 0);

} // namespace gridfem

#endif
