#include "Multigrid/PatchInverses.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Base/PrecisionTraits.h"

#include <string>

namespace gridfem
{
namespace
{

/// Pivots of a patch's scaled block below this value are left out.
double SmallestPivotOf(bool isSingle)
{
  return isSingle ? PrecisionTraits<float>::SmallestPatchPivot
                  : PrecisionTraits<double>::SmallestPatchPivot;
}

/// Rounding V to single precision changes V S Vᵀ = I by about 6e-8 / sqrt(pivot). At this pivot the
/// change is 2 %, too little to affect a smoother. If a pivot is smaller, as on flat faces, V is
/// kept in double.
constexpr double SmallestSinglePivot = 1e-11;

/// Whether V may be in single precision. Numbers outside its range would become zero or infinite.
bool IsSingle(const PatchFactor& factor, FactorPrecision precision)
{
  return !factor.hasLargeScales &&
         (precision == FactorPrecision::Single ||
           (precision == FactorPrecision::Mixed && factor.smallestPivot >= SmallestSinglePivot));
}

} // namespace

PatchInverses::PatchInverses(const SparseMatrix& A, const UnknownGroups& patches, int threads,
  std::optional<FactorPrecision> precision)
{
  if (patches.size > LargestGroup)
  {
    throw InvalidInput("A patch has " + std::to_string(patches.size) + " unknowns; at most " +
                       std::to_string(LargestGroup) + " are relaxed together.");
  }
  unresolved_ = patches.size == PatchKernelWidth
                  ? this->FillPatches(A, patches, threads, precision)
                  : this->FillGroups(A, patches, threads, !precision);
}

Id PatchInverses::FillGroups(
  const SparseMatrix& A, const UnknownGroups& patches, int threads, bool isSingle)
{
  groups_.resize(patches.Count());
  const BlockSource source(A, threads);
  return ParallelSum(
    patches.Count(), threads, Id{ 0 },
    [&](Id begin, Id end)
    {
      Id unresolved = 0;
      for (Id p = begin; p < end; ++p)
      {
        groups_[p] = FactorGroup(source, patches[p], SmallestPivotOf(isSingle));
        if (isSingle && groups_[p].hasLargeScales)
        {
          groups_[p].V.resize(0, 0);
        }
        unresolved += isSingle && (groups_[p].hasLargeScales || !groups_[p].isComplete) ? 1 : 0;
      }
      return unresolved;
    },
    PatchesPerBlock);
}

Id PatchInverses::FillPatches(const SparseMatrix& A, const UnknownGroups& patches, int threads,
  std::optional<FactorPrecision> precision)
{
  const Id count = patches.Count();
  const bool isPacked = !precision;
  patches_.resize(count);
  single_.resize(isPacked ? 0 : count);
  double_.resize(isPacked ? 0 : count);
  packed_.resize(isPacked ? count : 0);
  const BlockSource source(A, threads);
  return ParallelSum(
    count, threads, Id{ 0 },
    [&](Id begin, Id end)
    {
      Id unresolved = 0;
      ForEachFactor(source, patches, begin, end, SmallestPivotOf(isPacked),
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
    for (int i = 0, k = 0; i < PatchKernelWidth; ++i)
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
    Eigen::Map<Eigen::Matrix<float, PatchKernelWidth, PatchKernelWidth>>(single_[p].data()) =
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
  for (const GroupFactor& group : groups_)
  {
    bytes += sizeof(group) + group.unknown.size() * sizeof(Index) + group.V.size() * sizeof(double);
  }
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
