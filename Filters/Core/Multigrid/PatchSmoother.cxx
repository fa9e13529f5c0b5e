#include "Base/PrecisionTraits.h"
#include "Multigrid/BlockSweep.h"
#include "Multigrid/PatchInverses.h"
#include "Multigrid/Smoother.h"

namespace gridfem
{
namespace
{

/// Relaxes the patches in visiting order.
template<class Real>
class PatchSmoother : public BasicSmoother<Real>
{
public:
  PatchSmoother(const SparseMatrix& A, const PatchOrder& order, int threads,
    std::optional<FactorPrecision> precision)
    : rows_(A.rows), ranges_(RangesOf(A, order, threads)),
      inverses_(A, order.dof, threads, precision)
  {
  }

  void Sweep(const BasicSparseMatrix<Real>& A, const Vectors<Real>& b, Vectors<Real>& x,
    SweepDirection direction, int threads) const override
  {
    CheckSweep(A, rows_, b, x);
    const RowView rows(A);
    const auto sweep = [&](auto&& relax)
    { SweepBlocks<Real>(ranges_, x.cols(), direction, 128 * inverses_.Count(), threads, relax); };
    if (!inverses_.HaveKernels())
    {
      sweep([&](Id p, auto chunk) { inverses_.Relax(p, rows, b.data(), x.data(), chunk); });
      return;
    }
    const Id next = direction == SweepDirection::Forward ? 1 : -1;
    sweep(
      [&](Id p, auto chunk)
      {
        // Prefetches the data with the longest latency: the rows of the matrix, or the vectors if
        // there are many columns.
        if constexpr (decltype(chunk)::Width < WidestPanel)
        {
          inverses_.FetchRows(rows, p + 2 * next);
        }
        else
        {
          inverses_.FetchVectors(p + next, b.data(), x.data(), chunk);
        }
        inverses_.RelaxByKernel(p, rows, b.data(), x.data(), chunk);
      });
  }

  bool HasSingleFactors() const override { return inverses_.HasSingle(); }

  bool IsSingle() const override { return PrecisionTraits<Real>::IsSingle; }

  Id UnresolvedPatches() const override { return inverses_.Unresolved(); }

  std::size_t Memory() const override { return inverses_.Memory() + ranges_.Memory(); }

private:
  static BlockRanges RangesOf(const SparseMatrix& A, const PatchOrder& order, int threads)
  {
    CheckOrder(A, order, threads);
    return { order.blockBegin.empty() ? std::vector<Id>{ 0 } : order.blockBegin, order.colorBegin };
  }

  Index rows_;
  BlockRanges ranges_;
  PatchInverses inverses_;
};

} // namespace

std::unique_ptr<Smoother> MakePatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads, FactorPrecision precision)
{
  return std::make_unique<PatchSmoother<double>>(A, order, threads, precision);
}

std::unique_ptr<BasicSmoother<float>> MakeSinglePatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads)
{
  return std::make_unique<PatchSmoother<float>>(A, order, threads, std::nullopt);
}

} // namespace gridfem
