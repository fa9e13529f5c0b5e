#include "Base/Parallel.h"
#include "Multigrid/BlockSweep.h"
#include "Multigrid/PatchFactor.h"
#include "Multigrid/RelaxPatch.h"
#include "Multigrid/Smoother.h"

#include <algorithm>

namespace gridfem
{
namespace
{

constexpr int N = FunctionsPerPatch;

/// Pivots of the scaled block below this are rounding: the direction is left out.
constexpr double SmallestPivot = 1e-14;

/// Rounding V to single precision changes V S Vᵀ = I by some 6e-8 / sqrt(pivot). From this pivot on
/// that is 2 %, which a smoother does not feel; below it, as on flat faces, V is kept in double.
constexpr double SmallestSinglePivot = 1e-11;

class PatchSmoother : public Smoother
{
public:
  PatchSmoother(
    const SparseMatrix& A, const PatchOrder& order, int threads, FactorPrecision precision);

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override;

  bool HasSingleFactors() const override;

  std::size_t Memory() const override;

private:
  /// A patch, in visiting order.
  struct Place
  {
    std::array<Index, N> dof;
    Index precision; // of its factor
  };
  enum Precision : Index
  {
    None, // no unknown can be solved for
    Single,
    Double
  };

  /// Of a patch that is visited soon; there may be none.
  EIGEN_ALWAYS_INLINE void FetchRows(const RowView& A, Id p) const
  {
    if (p >= 0 && p < static_cast<Id>(patches_.size()))
    {
      for (const Index row : patches_[p].dof)
      {
        FetchRow(A, row);
      }
    }
  }

  void SetPatch(Id p, const PatchFactor& factor, FactorPrecision precision);

  Index rows_;
  BlockRanges ranges_;
  Array<Place> patches_;
  // The factor of patch p is entry p of one of them. What is not used is never touched, and so
  // takes no memory.
  Array<std::array<float, N * N>> single_;
  Array<std::array<double, N * N>> double_;
};

PatchSmoother::PatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads, FactorPrecision precision)
  : rows_(A.rows)
{
  CheckOrder(A, order, threads);
  ranges_.colourBegin = order.colourBegin;
  ranges_.blockBegin = order.blockBegin.empty() ? std::vector<Id>{ 0 } : order.blockBegin;
  patches_.resize(order.dof.size());
  single_.resize(order.dof.size());
  double_.resize(order.dof.size());
  const BlockSource source(A, threads);
  ParallelRanges(
    static_cast<Id>(order.dof.size()), threads,
    [&](Id begin, Id end)
    {
      ForEachFactor(source, order.dof.data(), begin, end, SmallestPivot,
        [&](Id p, const PatchFactor& factor) { this->SetPatch(p, factor, precision); });
    },
    PatchesPerBlock);
}

/// Numbers that single precision does not hold would be zero or infinite.
bool IsSingle(const PatchFactor& factor, FactorPrecision precision)
{
  return !factor.hasLargeScales &&
         (precision == FactorPrecision::Single ||
           (precision == FactorPrecision::Mixed && factor.smallestPivot >= SmallestSinglePivot));
}

void PatchSmoother::SetPatch(Id p, const PatchFactor& factor, FactorPrecision precision)
{
  if (factor.count == 0)
  {
    patches_[p] = { factor.dof, None };
    return;
  }
  const bool isSingle = IsSingle(factor, precision);
  patches_[p] = { factor.dof, isSingle ? Single : Double };
  if (isSingle)
  {
    Eigen::Map<Eigen::Matrix<float, N, N>>(single_[p].data()) = factor.V.cast<float>();
  }
  else
  {
    Eigen::Map<PatchMatrix>(double_[p].data()) = factor.V;
  }
}

bool PatchSmoother::HasSingleFactors() const
{
  return std::any_of(
    patches_.begin(), patches_.end(), [](const Place& patch) { return patch.precision == Single; });
}

std::size_t PatchSmoother::Memory() const
{
  std::size_t bytes = patches_.size() * sizeof(patches_.front()) + ranges_.Memory();
  for (const Place& patch : patches_)
  {
    bytes += patch.precision == Single   ? sizeof(single_.front())
             : patch.precision == Double ? sizeof(double_.front())
                                         : 0;
  }
  return bytes;
}

void PatchSmoother::Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x,
  SweepDirection direction, int threads) const
{
  CheckSweep(A, rows_, b, x);
  const RowView rows(A);
  const Id ahead = direction == SweepDirection::Forward ? 2 : -2;
  SweepBlocks(ranges_, x.cols(), direction, 128 * static_cast<Id>(patches_.size()), threads,
    [&](Id p, auto chunk)
    {
      this->FetchRows(rows, p + ahead);
      const Place& patch = patches_[p];
      if (patch.precision == Single)
      {
        RelaxPatch(rows, patch.dof, single_[p].data(), b.data(), x.data(), chunk);
      }
      else if (patch.precision == Double)
      {
        RelaxPatch(rows, patch.dof, double_[p].data(), b.data(), x.data(), chunk);
      }
    });
}

} // namespace

std::unique_ptr<Smoother> MakePatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads, FactorPrecision precision)
{
  return std::make_unique<PatchSmoother>(A, order, threads, precision);
}

} // namespace gridfem
