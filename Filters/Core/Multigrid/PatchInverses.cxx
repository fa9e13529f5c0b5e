#include "Multigrid/PatchInverses.h"

#include "Base/Parallel.h"

namespace gridfem
{
namespace
{

/// Pivots of the scaled block below this are rounding: the direction is left out.
constexpr double SmallestPivot = 1e-14;

/// Rounding V to single precision changes V S Vᵀ = I by some 6e-8 / sqrt(pivot). From this pivot on
/// that is 2 %, which a smoother does not feel; below it, as on flat faces, V is kept in double.
constexpr double SmallestSinglePivot = 1e-11;

/// Numbers that single precision does not hold would be zero or infinite.
bool IsSingle(const PatchFactor& factor, FactorPrecision precision)
{
  return !factor.hasLargeScales &&
         (precision == FactorPrecision::Single ||
           (precision == FactorPrecision::Mixed && factor.smallestPivot >= SmallestSinglePivot));
}

} // namespace

PatchInverses::PatchInverses(const SparseMatrix& A,
  const std::vector<std::array<Index, FunctionsPerPatch>>& dof, int threads,
  FactorPrecision precision)
{
  patches_.resize(dof.size());
  single_.resize(dof.size());
  double_.resize(dof.size());
  const BlockSource source(A, threads);
  ParallelRanges(
    static_cast<Id>(dof.size()), threads,
    [&](Id begin, Id end)
    {
      ForEachFactor(source, dof.data(), begin, end, SmallestPivot,
        [&](Id p, const PatchFactor& factor) { this->Set(p, factor, precision); });
    },
    PatchesPerBlock);
}

void PatchInverses::Set(Id p, const PatchFactor& factor, FactorPrecision precision)
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
    Eigen::Map<Eigen::Matrix<float, FunctionsPerPatch, FunctionsPerPatch>>(single_[p].data()) =
      factor.V.cast<float>();
  }
  else
  {
    Eigen::Map<PatchMatrix>(double_[p].data()) = factor.V;
  }
}

bool PatchInverses::HasSingle() const
{
  return std::any_of(
    patches_.begin(), patches_.end(), [](const Patch& patch) { return patch.precision == Single; });
}

std::size_t PatchInverses::Memory() const
{
  std::size_t bytes = patches_.size() * sizeof(patches_.front());
  for (const Patch& patch : patches_)
  {
    bytes += patch.precision == Single   ? sizeof(single_.front())
             : patch.precision == Double ? sizeof(double_.front())
                                         : 0;
  }
  return bytes;
}

} // namespace gridfem
