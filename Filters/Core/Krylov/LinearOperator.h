// What an iteration sees of a linear system: products and sums, and a preconditioner. Matrices and
// cycles in other places, such as several processes or a GPU, offer the same.
#ifndef GridFEM_LinearOperator_h
#define GridFEM_LinearOperator_h

#include "Algebra/ColumnAlgebra.h"

#include <functional>

namespace gridfem
{

template<class Real>
class BasicMultigrid;
using Multigrid = BasicMultigrid<double>;

/// A symmetric positive semi-definite A, for blocks of vectors with any number of columns.
struct LinearOperator
{
  Id rows = 0;                                                        // of vectors in this process
  std::function<void(const MultiVector& x, MultiVector& y)> multiply; // A x
  std::function<void(const MultiVector& x, const MultiVector& b, MultiVector& r)> residual; // b-A x
  /// x_cᵀ y_c of every column c, summed over all processes: the iteration decides by these alone.
  std::function<Columns(const MultiVector& x, const MultiVector& y)> products;
  int threads = 0; // that add up vectors
};

/// z = B r for every column, B symmetric positive semi-definite.
using Preconditioner = std::function<void(const MultiVector& r, MultiVector& z)>;

/// Its finest matrix. The hierarchy has to outlive what is made of it.
LinearOperator OperatorOf(const Multigrid& multigrid);

/// One cycle from zero.
Preconditioner CycleOf(const Multigrid& multigrid);

} // namespace gridfem

#endif
