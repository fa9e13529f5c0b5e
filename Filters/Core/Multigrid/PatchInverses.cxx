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
  std::optional<FactorPrecision> precision)
{
  patches_.resize(dof.size());
  const bool isPacked = !precision;
  single_.resize(isPacked ? 0 : dof.size());
  double_.resize(isPacked ? 0 : dof.size());
  packed_.resize(isPacked ? dof.size() : 0);
  const BlockSource source(A, threads);
  unresolved_ = ParallelSum(
    static_cast<Id>(dof.size()), threads, Id{ 0 },
    [&](Id begin, Id end)
    {
      Id unresolved = 0;
      ForEachFactor(source, dof.data(), begin, end,
        isPacked ? SmallestPivotOfSingle : SmallestPivot,
        [&](Id p, const PatchFactor& factor)
        { unresolved += this->Set(p, factor, precision) ? 0 : 1; });
      return unresolved;
    },
    PatchesPerBlock);
}

bool PatchInverses::Set(Id p, const PatchFactor& factor, std::optional<FactorPrecision> precision)
{
  const bool isPacked = !precision;
  if (factor.count == 0 || (isPacked && factor.hasLargeScales))
  {
    patches_[p] = { factor.dof, None };
    return !factor.hasLargeScales;
  }
  if (isPacked)
  {
    patches_[p] = { factor.dof, Packed };
    for (int i = 0, k = 0; i < FunctionsPerPatch; ++i)
    {
      for (int j = 0; j <= i; ++j, ++k)
      {
        packed_[p][k] = static_cast<float>(factor.V(i, j));
      }
    }
    return factor.isComplete;
  }
  const bool isSingle = IsSingle(factor, *precision);
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
  return true;
}

bool PatchInverses::HasSingle() const
{
  return std::any_of(patches_.begin(), patches_.end(),
    [](const Patch& patch) { return patch.kind == Single || patch.kind == Packed; });
}

std::size_t PatchInverses::Memory() const
{
  std::size_t bytes = patches_.size() * sizeof(patches_.front());
  for (const Patch& patch : patches_)
  {
    bytes += patch.kind == Single   ? sizeof(single_.front())
             : patch.kind == Double ? sizeof(double_.front())
             : patch.kind == Packed ? sizeof(packed_.front())
                                    : 0;
  }
  return bytes;
}

} // namespace gridfem
