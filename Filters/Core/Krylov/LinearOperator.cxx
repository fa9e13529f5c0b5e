#include "Krylov/LinearOperator.h"

#include "Multigrid/Multigrid.h"

namespace gridfem
{

namespace
{

/// The same where processes hold the rows together; A is the part of this one.
LinearOperator OperatorOf(const SparseMatrix& A, const DividedRows& divided, int threads)
{
  LinearOperator result = OperatorOf(A, threads);
  result.multiply = [&A, &divided, threads](const MultiVector& x, MultiVector& y)
  {
    Multiply(A, x, y, threads);
    divided.Sum(y);
  };
  result.residual = [multiply = result.multiply](
                      const MultiVector& x, const MultiVector& b, MultiVector& r)
  {
    multiply(x, r);
    r = b - r;
  };
  result.products = [&divided, threads](const MultiVector& x, const MultiVector& y)
  {
    Columns products = ColumnProducts(x, y, threads, divided.Foreign());
    divided.SumNumbers(products.data(), products.size());
    return products;
  };
  return result;
}

} // namespace

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
  const auto& divided = multigrid.Levels().front().divided;
  const int threads = multigrid.Options().threads;
  return divided ? OperatorOf(multigrid.Matrix(), divided->Rows(), threads)
                 : OperatorOf(multigrid.Matrix(), threads);
}

Preconditioner CycleOf(const Multigrid& multigrid)
{
  return [&multigrid](const MultiVector& r, MultiVector& z) { multigrid.Precondition(r, z); };
}

} // namespace gridfem
