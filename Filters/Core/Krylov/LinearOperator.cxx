#include "Krylov/LinearOperator.h"

#include "Multigrid/Multigrid.h"

namespace gridfem
{

LinearOperator OperatorOf(const SparseMatrix& A, int threads)
{
  LinearOperator result;
  result.rows = A.rows;
  result.multiply = [&A, threads](const MultiVector& x, MultiVector& y)
  { Multiply(A, x, y, threads); };
  result.residual = [&A, threads](const MultiVector& x, const MultiVector& b, MultiVector& r)
  { Residual(A, x, b, r, threads); };
  result.products = [threads](const MultiVector& x, const MultiVector& y)
  { return ColumnProducts(x, y, threads); };
  result.threads = threads;
  return result;
}

LinearOperator OperatorOf(const Multigrid& multigrid)
{
  return OperatorOf(multigrid.Matrix(), multigrid.Options().threads);
}

Preconditioner CycleOf(const Multigrid& multigrid)
{
  return [&multigrid](const MultiVector& r, MultiVector& z) { multigrid.Precondition(r, z); };
}

} // namespace gridfem
