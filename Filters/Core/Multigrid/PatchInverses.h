// The inverses of all patches of a level, and the relaxation of one of them: what a patch smoother
// does in an order of its own, and a march of heat in that of the heat.
#ifndef GridFEM_PatchInverses_h
#define GridFEM_PatchInverses_h

#include "Algebra/RowKernels.h"
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

/// x += Vᵀ V (b - A x) on the patch.
template<class Chunk, class Real, class Factor>
inline void RelaxPatch(const RowView<Real>& A, const std::array<Index, FunctionsPerPatch>& dof,
  const Factor& V, const Real* b, Real* x, Chunk chunk)
{
  using ColumnLanes = typename Chunk::ColumnLanes;
  std::conditional_t<Chunk::Width == 1, Real, ColumnLanes> r[FunctionsPerPatch];
  for (int i = 0; i < FunctionsPerPatch; ++i)
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
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    chunk.Row(x, dof[i]) += r[i];
  }
}

/// Vᵀ V of every patch, in single precision where the options and the numbers allow it.
class PatchInverses
{
public:
  /// @param dof        unknowns of each patch, -1 for an unused place
  /// @param precision  none: single, for vectors in single precision; what that does not hold or
  ///                   resolve is left out
  PatchInverses(const SparseMatrix& A, const std::vector<std::array<Index, FunctionsPerPatch>>& dof,
    int threads, std::optional<FactorPrecision> precision);

  Id Count() const { return static_cast<Id>(patches_.size()); }

  /// Unknowns in the order of the factor. Unused places repeat one that is used.
  const std::array<Index, FunctionsPerPatch>& Unknowns(Id p) const { return patches_[p].dof; }

  /// x += Vᵀ V (b - A x) on the patch, for a chunk of columns.
  template<class Real, class Chunk>
  EIGEN_ALWAYS_INLINE void Relax(
    Id p, const RowView<Real>& A, const Real* b, Real* x, Chunk chunk) const
  {
    const Patch& patch = patches_[p];
    if (patch.kind == Single)
    {
      RelaxPatch(A, patch.dof, single_[p], b, x, chunk);
    }
    else if (patch.kind == Double)
    {
      RelaxPatch(A, patch.dof, double_[p], b, x, chunk);
    }
    else if (patch.kind == Packed)
    {
      RelaxPatch(A, patch.dof, packed_[p], b, x, chunk);
    }
  }

  /// Asks for the rows of a patch that is visited soon; there may be none.
  template<class Real>
  EIGEN_ALWAYS_INLINE void FetchRows(const RowView<Real>& A, Id p) const
  {
    if (p >= 0 && p < this->Count())
    {
      for (const Index row : patches_[p].dof)
      {
        FetchRow(A, row);
      }
    }
  }

  /// Asks for what vectors of many columns have in these rows.
  template<class Real, class Chunk>
  EIGEN_ALWAYS_INLINE void FetchVectors(Id p, const Real* b, const Real* x, Chunk chunk) const
  {
    constexpr std::size_t lines = (Chunk::Width * sizeof(Real) + LineSize - 1) / LineSize;
    if (p >= 0 && p < this->Count())
    {
      for (const Index row : patches_[p].dof)
      {
        Fetch<lines>(b + chunk.Offset(row));
        Fetch<lines>(x + chunk.Offset(row));
      }
    }
  }

  /// Asks for the patch itself, with a given precision, for orders that are not that of memory.
  EIGEN_ALWAYS_INLINE void FetchInverse(Id p) const
  {
    Fetch(&patches_[p]);
    Fetch<4>(single_[p].data());
  }

  bool HasSingle() const;
  /// Those whose directions single precision does not all resolve, where it has to.
  Id Unresolved() const { return unresolved_; }
  std::size_t Memory() const;

private:
  struct Patch
  {
    std::array<Index, FunctionsPerPatch> dof;
    Index kind; // of its factor
  };
  enum Kind : Index
  {
    None, // no unknown can be solved for
    Single,
    Double,
    Packed // in single precision, for many columns
  };

  /// Returns false where the patch is left out in part or as a whole.
  bool Set(Id p, const PatchFactor& factor, std::optional<FactorPrecision> precision);

  Array<Patch> patches_;
  Id unresolved_ = 0;
  // The factor of patch p is entry p of one of them. What is not used is never touched, and so
  // takes no memory.
  Array<MirroredFactor<float>> single_;
  Array<MirroredFactor<double>> double_;
  Array<PackedFactor<float>> packed_;
};

} // namespace gridfem

#endif
