#include "Multigrid/Smoother.h"

#include "Multigrid/BlockSweep.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// True for 0 = begin[0] <= begin[1] <= ... <= begin[last] = count. `begin` may be empty when count
/// is 0.
bool Covers(const std::vector<Id>& begin, Id count)
{
  if (begin.empty())
  {
    return count == 0;
  }
  return begin.front() == 0 && begin.back() == count && std::is_sorted(begin.begin(), begin.end());
}

} // namespace

void CheckOrder(const SparseMatrix& A, const PatchOrder& order, int threads)
{
  if (A.rows != A.columns || static_cast<Id>(A.rowBegin.size()) != Id(A.rows) + 1)
  {
    throw InvalidInput("A smoother needs a square matrix.");
  }
  const Id blocks = std::max<Id>(0, Id(order.blockBegin.size()) - 1);
  if (!Covers(order.blockBegin, order.dof.Count()) || !Covers(order.colorBegin, blocks))
  {
    throw InvalidInput("Blocks and colors of a patch order must cover all patches.");
  }
  ParallelRanges(order.dof.Count(), threads,
    [&](Id begin, Id end)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        for (const Index unknown : order.dof[patch])
        {
          if (unknown < -1 || unknown >= A.rows)
          {
            throw InvalidInput("Patch " + std::to_string(patch) + " names unknown " +
                               std::to_string(unknown) + " of " + std::to_string(A.rows));
          }
        }
      }
    });
}

template<class Real>
void CheckSweep(
  const BasicSparseMatrix<Real>& A, Id rows, const Vectors<Real>& b, const Vectors<Real>& x)
{
  if (A.rows != rows || b.rows() != rows || x.rows() != rows || b.cols() != x.cols())
  {
    throw InvalidInput("A sweep over " + std::to_string(rows) + " unknowns got a matrix of " +
                       std::to_string(A.rows) + ", b " + std::to_string(b.rows()) + " x " +
                       std::to_string(b.cols()) + " and x " + std::to_string(x.rows()) + " x " +
                       std::to_string(x.cols()));
  }
}

template void CheckSweep(
  const BasicSparseMatrix<float>&, Id, const Vectors<float>&, const Vectors<float>&);
template void CheckSweep(const SparseMatrix&, Id, const MultiVector&, const MultiVector&);

} // namespace gridfem
