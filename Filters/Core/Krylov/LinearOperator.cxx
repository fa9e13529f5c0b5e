#include "Krylov/LinearOperator.h"

#include "Multigrid/Multigrid.h"

namespace gridfem
{
LinearOperator OperatorOf(const Multigrid& multigrid)
{
  const SparseMatrix& A = multigrid.Matrix();
  const DistributedRows* const distributed = multigrid.Levels().front().Rows();
  const int threads = multigrid.Options().threads;
  const auto sum = [distributed](MultiVector& parts)
  {
    if (distributed)
    {
      distributed->Sum(parts);
    }
  };
  LinearOperator result;
  result.rows = A.rows;
  result.multiply = [&A, sum, threads](const MultiVector& x, MultiVector& y)
  {
    Multiply(A, x, y, threads);
    sum(y);
  };
  result.residual = [&A, distributed, sum, threads](
                      const MultiVector& x, const MultiVector& b, MultiVector& r)
  {
    ResidualPart(A, x, b, GhostRows(distributed), r, nullptr, threads);
    sum(r);
  };
  result.products = [distributed, threads](const MultiVector& x, const MultiVector& y)
  {
    Columns products = ColumnProducts(x, y, threads, GhostRows(distributed));
    SumOverProcesses(distributed, products);
    return products;
  };
  result.threads = threads;
  result.where = [&multigrid] { return multigrid.Where(); };
  return result;
}

Preconditioner CycleOf(const Multigrid& multigrid)
{
  return [&multigrid](const MultiVector& r, MultiVector& z) { multigrid.Precondition(r, z); };
}

} // namespace gridfem
