// The inverses of all patches of a level, and the relaxation of one patch. A patch smoother visits
// the patches in an order of its own; the march of heat visits them in the order of the heat.
#ifndef GridFEM_PatchInverses_h
#define GridFEM_PatchInverses_h

#include "Algebra/RowKernels.h"
#include "Base/PrecisionTraits.h"
#include "Multigrid/PatchFactor.h"
#include "Multigrid/PatchInverse.h"
#include "Multigrid/Smoother.h"

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <vector>

namespace gridfem
{

/// x += Vᵀ V (b - A x) on the patch. It is not inlined, so that surrounding code does not change
/// its machine code.
template<class Chunk, class Real, class Factor>
EIGEN_DONT_INLINE void RelaxPatch(const RowView<Real>& A,
  const std::array<Index, PatchKernelWidth>& dof, const Factor& V, const Real* b, Real* x,
  Chunk chunk)
{
  using ColumnLanes = typename Chunk::ColumnLanes;
  std::conditional_t<Chunk::Width == 1, Real, ColumnLanes> r[PatchKernelWidth];
  for (int i = 0; i < PatchKernelWidth; ++i)
  {
    const ColumnLanes residual = chunk.Row(b, dof[i]) - RowProduct(A, dof[i], x, chunk);
    if constexpr (Chunk::Width == 1)
    {
      r[i] = residual[0];
    }
    else
    {
      r[i] = residual;
    }
  }
  ApplyInverse(V, r);
  for (int i = 0; i < PatchKernelWidth; ++i)
  {
    chunk.Row(x, dof[i]) += r[i];
  }
}

/// Largest number of unknowns of a group. A thread holds this many while it relaxes a group.
constexpr int LargestGroup = 64;

/// r = Vᵀ V r for one column. Vector instructions run along the group.
inline void ApplyToColumn(const Eigen::MatrixXd& V, double* r)
{
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, LargestGroup, 1>;
  Eigen::Map<Eigen::VectorXd> residual(r, V.rows());
  Column half(V.rows());
  half.noalias() = V * residual;
  residual.noalias() = V.transpose() * half;
}

/// x += Vᵀ V (b - A x) on a group of any size.
template<class Chunk, class Real>
EIGEN_DONT_INLINE void RelaxGroup(
  const RowView<Real>& A, const GroupFactor& group, const Real* b, Real* x, Chunk chunk)
{
  const auto& V = group.V;
  const auto count = static_cast<int>(V.rows());
  Eigen::Array<double, Chunk::Width, 1> r[LargestGroup];
  for (int i = 0; i < count; ++i)
  {
    const Index row = group.unknown[i];
    r[i] = (chunk.Row(b, row) - RowProduct(A, row, x, chunk)).template cast<double>();
  }
  if constexpr (Chunk::Width == 1)
  {
    ApplyToColumn(V, &r[0][0]);
    for (int i = 0; i < count; ++i)
    {
      chunk.Row(x, group.unknown[i]) += r[i].template cast<Real>();
    }
    return;
  }
  for (int i = count - 1; i >= 0; --i)
  {
    r[i] *= V(i, i);
    for (int j = 0; j < i; ++j)
    {
      r[i] += V(i, j) * r[j];
    }
  }
  for (int i = 0; i < count; ++i)
  {
    r[i] *= V(i, i);
    for (int j = i + 1; j < count; ++j)
    {
      r[i] += V(j, i) * r[j];
    }
    chunk.Row(x, group.unknown[i]) += r[i].template cast<Real>();
  }
}

/// Vᵀ V of every patch. Patches of PatchKernelWidth unknowns store it in single precision where the
/// options and the numbers allow. Patches of any other size always store it in double.
class PatchInverses
{
public:
  /// @param precision  none: for vectors in single precision, without the directions that single
  ///   precision does not hold or resolve
  /// Throws InvalidInput if patches have more than LargestGroup unknowns.
  PatchInverses(const SparseMatrix& A, const UnknownGroups& patches, int threads,
    std::optional<FactorPrecision> precision);

  Id Count() const { return static_cast<Id>(patches_.size() + groups_.size()); }

  /// Unknowns in the order of the factor. Unused places repeat a used one.
  UnknownGroup Unknowns(Id p) const
  {
    return groups_.empty() ? UnknownGroup(patches_[p].dof.data(), PatchKernelWidth)
                           : UnknownGroup(groups_[p].unknown.data(), Id(groups_[p].unknown.size()));
  }

  /// Whether patches have PatchKernelWidth unknowns. Loops over many patches ask once. A test in
  /// every patch makes sweeps over eight columns in double precision 15 % slower.
  bool HaveKernels() const { return groups_.empty(); }

  /// x += Vᵀ V (b - A x) on the patch, for a chunk of columns.
  /// @param Real  float if the inverses are for vectors in single precision, else double
  template<class Real, class Chunk>
  EIGEN_ALWAYS_INLINE void Relax(
    Id p, const RowView<Real>& A, const Real* b, Real* x, Chunk chunk) const
  {
    if (this->HaveKernels())
    {
      this->RelaxByKernel(p, A, b, x, chunk);
    }
    else
    {
      RelaxGroup(A, groups_[p], b, x, chunk);
    }
  }

  /// Relax for patches that have kernels.
  template<class Real, class Chunk>
  EIGEN_ALWAYS_INLINE void RelaxByKernel(
    Id p, const RowView<Real>& A, const Real* b, Real* x, Chunk chunk) const
  {
    const Patch& patch = patches_[p];
    if constexpr (PrecisionTraits<Real>::IsSingle)
    {
      if (patch.kind == Packed)
      {
        RelaxPatch(A, patch.dof, packed_[p], b, x, chunk);
      }
    }
    else if (patch.kind == Single)
    {
      RelaxPatch(A, patch.dof, single_[p], b, x, chunk);
    }
    else if (patch.kind == Double)
    {
      RelaxPatch(A, patch.dof, double_[p], b, x, chunk);
    }
  }

  /// Prefetches the rows of a patch that is visited soon. p may be out of range.
  template<class Real>
  EIGEN_ALWAYS_INLINE void FetchRows(const RowView<Real>& A, Id p) const
  {
    if (p >= 0 && p < static_cast<Id>(patches_.size()))
    {
      for (const Index row : patches_[p].dof)
      {
        FetchRow(A, row);
      }
    }
  }

  /// Prefetches these rows of b and x, for many columns.
  template<class Real, class Chunk>
  EIGEN_ALWAYS_INLINE void FetchVectors(Id p, const Real* b, const Real* x, Chunk chunk) const
  {
    constexpr std::size_t lines = (Chunk::Width * sizeof(Real) + LineSize - 1) / LineSize;
    if (p >= 0 && p < static_cast<Id>(patches_.size()))
    {
      for (const Index row : patches_[p].dof)
      {
        Fetch<lines>(b + chunk.Offset(row));
        Fetch<lines>(x + chunk.Offset(row));
      }
    }
  }

  /// Prefetches the patch itself and its factor, for orders that differ from the order in memory.
  EIGEN_ALWAYS_INLINE void FetchInverse(Id p) const
  {
    if (groups_.empty())
    {
      Fetch(&patches_[p]);
      Fetch<4>(single_[p].data());
    }
  }

  bool HasSingle() const;
  /// Number of patches with directions that vectors in single precision do not resolve.
  Id Unresolved() const { return unresolved_; }
  std::size_t Memory() const;

private:
  struct Patch
  {
    std::array<Index, PatchKernelWidth> dof;
    Index kind; // kind of its factor
  };
  enum Kind : Index
  {
    None, // no unknown can be solved for
    Single,
    Double,
    Packed // in single precision, for many columns
  };

  /// Both return the number of unresolved patches.
  Id FillPatches(const SparseMatrix& A, const UnknownGroups& patches, int threads,
    std::optional<FactorPrecision> precision);
  Id FillGroups(const SparseMatrix& A, const UnknownGroups& patches, int threads, bool isSingle);
  /// Returns false if the patch is left out in part or as a whole.
  bool Set(Id p, const PatchFactor& factor, std::optional<FactorPrecision> precision);

  Id unresolved_ = 0;
  std::vector<GroupFactor> groups_; // if patches have another size than PatchKernelWidth
  Array<Patch> patches_;            // if patches have that size
  // The factor of patch p is entry p of one of these arrays. Unused entries are never touched and
  // so take no memory.
  Array<MirroredFactor<float>> single_;
  Array<MirroredFactor<double>> double_;
  Array<PackedFactor<float>> packed_;
};

} // namespace gridfem

#endif
