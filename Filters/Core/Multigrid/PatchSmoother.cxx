#include "Multigrid/BlockSweep.h"
#include "Multigrid/PatchInverses.h"
#include "Multigrid/Smoother.h"

namespace gridfem
{
namespace
{

/// Patches in visiting order.
class PatchSmoother : public Smoother
{
public:
  PatchSmoother(
    const SparseMatrix& A, const PatchOrder& order, int threads, FactorPrecision precision)
    : rows_(A.rows), ranges_(RangesOf(A, order, threads)),
      inverses_(A, order.dof, threads, precision)
  {
  }

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override
  {
    CheckSweep(A, rows_, b, x);
    const RowView rows(A);
    const Id ahead = direction == SweepDirection::Forward ? 2 : -2;
    SweepBlocks(ranges_, x.cols(), direction, 128 * inverses_.Count(), threads,
      [&](Id p, auto chunk)
      {
        inverses_.FetchRows(rows, p + ahead);
        inverses_.Relax(p, rows, b.data(), x.data(), chunk);
      });
  }

  bool HasSingleFactors() const override { return inverses_.HasSingle(); }

  std::size_t Memory() const override { return inverses_.Memory() + ranges_.Memory(); }

private:
  static BlockRanges RangesOf(const SparseMatrix& A, const PatchOrder& order, int threads)
  {
    CheckOrder(A, order, threads);
    return { order.blockBegin.empty() ? std::vector<Id>{ 0 } : order.blockBegin,
      order.colourBegin };
  }

  Index rows_;
  BlockRanges ranges_;
  PatchInverses inverses_;
};

} // namespace

std::unique_ptr<Smoother> MakePatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads, FactorPrecision precision)
{
  return std::make_unique<PatchSmoother>(A, order, threads, precision);
}

} // namespace gridfem
