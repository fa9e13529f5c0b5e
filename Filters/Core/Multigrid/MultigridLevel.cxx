#include "Multigrid/MultigridLevel.h"

namespace gridfem
{
namespace
{

/// coarse = Pᵀ part. The part is whole if processes prolong parts. Otherwise its ghost rows hold
/// no terms that their owners count, too.
template<class Real>
void RestrictPart(const BasicMultigridLevel<Real>& level, const Vectors<Real>& part,
  Vectors<Real>& coarse, int threads)
{
  MakeRoom(level.restriction->rows, part.cols(), coarse);
  Multiply(level.restriction, part, coarse, threads);
  if (level.distributed)
  {
    level.distributed->SumCoarse(coarse);
  }
}

} // namespace

template<class Real>
Columns BasicMultigridLevel<Real>::Products(
  const Vectors<Real>& x, const Vectors<Real>& y, int threads) const
{
  Columns products = ColumnProducts(x, y, threads, GhostRows(this->Rows()));
  SumOverProcesses(this->Rows(), products);
  return products;
}

template<class Real>
void BasicMultigridLevel<Real>::Residual(
  const Vectors<Real>& b, const Vectors<Real>& x, Vectors<Real>& r, int threads) const
{
  ResidualPart<Real>(A, x, b, GhostRows(this->Rows()), r, nullptr, threads);
  if (const DistributedRows* const rows = this->Rows())
  {
    rows->Sum(r);
  }
}

template<class Real>
void BasicMultigridLevel<Real>::Sweep(
  const Vectors<Real>& b, Vectors<Real>& x, SweepDirection direction, int times, int threads) const
{
  for (int sweep = 0; sweep < times; ++sweep)
  {
    smoother->Sweep(A, b, x, direction, threads);
  }
}

template<class Real>
void BasicMultigridLevel<Real>::Restrict(
  const Vectors<Real>& b, Vectors<Real>& coarse, int threads) const
{
  const DistributedRows* const rows = this->Rows();
  if (!rows || rows->ArePartsProlonged())
  {
    RestrictPart(*this, b, coarse, threads);
    return;
  }
  Vectors<Real> own = b;
  own.topRows(rows->Ghosts()).setZero();
  RestrictPart(*this, own, coarse, threads);
}

template<class Real>
void BasicMultigridLevel<Real>::RestrictResidual(const Vectors<Real>& b, const Vectors<Real>& x,
  Vectors<Real>& scratch, Vectors<Real>& coarse, Columns* energy, int threads) const
{
  MakeRoom(b.rows(), b.cols(), scratch);
  ResidualPart(A, x, b, GhostRows(this->Rows()), scratch, energy, threads);
  SumProlonged<Real>(this->Rows(), scratch);
  RestrictPart(*this, scratch, coarse, threads);
  if (energy)
  {
    SumOverProcesses(this->Rows(), *energy);
  }
}

template<class Real>
void BasicMultigridLevel<Real>::Prolong(
  const Vectors<Real>& coarse, Vectors<Real>& fine, int threads) const
{
  Multiply(prolongation, coarse, fine, threads);
  SumProlonged<Real>(this->Rows(), fine);
}

template<class Real>
void BasicMultigridLevel<Real>::ProlongAdd(
  const Vectors<Real>& coarse, Vectors<Real>& x, Vectors<Real>& scratch, int threads) const
{
  const DistributedRows* const rows = this->Rows();
  if (rows && rows->ArePartsProlonged())
  {
    this->Prolong(coarse, scratch, threads);
    x += scratch;
  }
  else
  {
    MultiplyAdd(prolongation, coarse, x, threads);
  }
}

template struct BasicMultigridLevel<float>;
template struct BasicMultigridLevel<double>;

} // namespace gridfem
