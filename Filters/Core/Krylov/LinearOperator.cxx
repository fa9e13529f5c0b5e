#include "Krylov/LinearOperator.h"

#include "Multigrid/Multigrid.h"

namespace gridfem
{
LinearOperator OperatorOf(const Multigrid& multigrid)
{
  const SparseMatrix& A = multigrid.Matrix();
  const DividedRows* const divided = RowsOf(multigrid.Levels().front());
  const int threads = multigrid.Options().threads;
  const auto sum = [divided](MultiVector& parts)
  {
    if (divided)
    {
      divided->Sum(parts);
    }
  };
  LinearOperator result;
  result.rows = A.rows;
  result.multiply = [&A, sum, threads](const MultiVector& x, MultiVector& y)
  {
    Multiply(A, x, y, threads);
    sum(y);
  };
  result.residual = [&A, divided, sum, threads](
                      const MultiVector& x, const MultiVector& b, MultiVector& r)
  {
    ResidualPart(A, x, b, ForeignRows(divided), r, nullptr, threads);
    sum(r);
  };
  result.products = [divided, threads](const MultiVector& x, const MultiVector& y)
  {
    Columns products = ColumnProducts(x, y, threads, ForeignRows(divided));
    SumOverProcesses(divided, products);
    return products;
  };
  result.threads = threads;
  return result;
}

Preconditioner CycleOf(const Multigrid& multigrid)
{
  return [&multigrid](const MultiVector& r, MultiVector& z) { multigrid.Precondition(r, z); };
}

} // namespace gridfem
