// The interface of a linear system and of a preconditioner to an iteration: products and sums.
// Matrices and cycles in other places, such as several processes or a GPU, offer the same.
#ifndef GridFEM_LinearOperator_h
#define GridFEM_LinearOperator_h

#include "Algebra/ColumnAlgebra.h"

#include <functional>
#include <string>

namespace gridfem
{

template<class Real>
class BasicMultigrid;
using Multigrid = BasicMultigrid<double>;

/// A symmetric positive semi-definite A, applied to blocks of vectors with any number of columns.
struct LinearOperator
{
  // Rows of the vectors in this process.
  Id rows = 0;
  std::function<void(const MultiVector& x, MultiVector& y)> multiply;                       // A x
  std::function<void(const MultiVector& x, const MultiVector& b, MultiVector& r)> residual; // b-A x
  /// x_cᵀ y_c of every column c, summed over all processes. The iteration takes its decisions from
  /// these sums alone.
  std::function<Columns(const MultiVector& x, const MultiVector& y)> products;
  int threads = 0; // threads that add up vectors
  /// Where its cycles run; see Multigrid::Where.
  std::function<std::string()> where = [] { return std::string(); };
};

/// z = B r for every column, B symmetric positive semi-definite.
using Preconditioner = std::function<void(const MultiVector& r, MultiVector& z)>;

/// The finest matrix of the hierarchy. The hierarchy has to outlive the operator.
LinearOperator OperatorOf(const Multigrid& multigrid);

/// One cycle from zero. The hierarchy has to outlive the preconditioner.
Preconditioner CycleOf(const Multigrid& multigrid);

} // namespace gridfem

#endif
