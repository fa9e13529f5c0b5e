// The inverse of a patch's block of a matrix, for patch smoothers of any precision. Patches have
// PatchKernelWidth unknowns; groups have any number.
#ifndef GridFEM_PatchFactor_h
#define GridFEM_PatchFactor_h

#include "Algebra/SparseMatrix.h"
#include "Base/Prefetch.h"
#include "Multigrid/UnknownGroups.h"

#include <algorithm>
#include <array>

namespace gridfem
{

using PatchMatrix = Eigen::Matrix<double, PatchKernelWidth, PatchKernelWidth>;

/// The source of blocks: a matrix, and the place of the diagonal in each row. Keeps a reference.
struct BlockSource
{
  const SparseMatrix& A;
  struct Row
  {
    Id diagonal;  // place of the diagonal entry; -1 if it is not a positive number
    double scale; // 1 / √diagonal; 0 if the diagonal is not a positive number
  };
  Array<Row> row;

  BlockSource(const SparseMatrix& matrix, int threads);
};

/// Factor of a patch: Vᵀ V is the inverse of the block on its numerically independent part. A patch
/// has `count` unknowns. The other places repeat the first one and have zeros in V, so that a sweep
/// needs no case distinction.
struct PatchFactor
{
  // Lower triangular, and mirrored to the upper triangle. Zero if there are no unknowns.
  PatchMatrix V = PatchMatrix::Zero();
  std::array<Index, PatchKernelWidth> dof; // in the order of elimination
  double smallestPivot = 1.0;              // smallest kept pivot of the scaled block
  Index count = 0;                         // 0: no unknown can be solved for
  bool isComplete = true;                  // no pivot was left out
  bool hasLargeScales = false;             // V would leave the range of single precision
};

/// The same for a group of any size. Vᵀ V is the inverse of the block of the first unknowns.
struct GroupFactor
{
  Eigen::MatrixXd V;          // lower triangular; zero above the diagonal
  std::vector<Index> unknown; // the solvable unknowns, V's first; else any unknown
  bool isComplete = true;
  bool hasLargeScales = false;
};

/// Number of patches that are factored together, as many as vector registers have lanes.
constexpr int PatchesAtOnce = 8;

/// Pivoted Cholesky of the scaled blocks, stopped at the smallest pivot that counts. Blocks whose
/// pivots stay large in the order of their unknowns keep that order. It is equally accurate, and
/// without pivot choices all lanes go at once. Unknowns without a positive diagonal are left out.
/// @param dof, factors  of `count` patches, at most PatchesAtOnce, one after the other; -1 in dof
///   marks an unused place
void FactorPatches(const BlockSource& source, const Index* dof, int count, double smallestPivot,
  PatchFactor* factors);

/// Factors one group of any size by pivoted Cholesky.
GroupFactor FactorGroup(const BlockSource& source, UnknownGroup group, double smallestPivot);

/// Prefetches the data of a patch's block: its rows from the diagonal on.
EIGEN_ALWAYS_INLINE void FetchRows(const BlockSource& source, const Index* dof)
{
  for (int i = 0; i < PatchKernelWidth; ++i)
  {
    const Index unknown = dof[i];
    const Id k = unknown >= 0 ? source.row[unknown].diagonal : -1;
    if (k >= 0)
    {
      Fetch(source.A.column.data() + k);
      Fetch<2>(source.A.value.data() + k);
    }
  }
}

/// Calls body(patch, factor) for the patches from `begin` to `end`.
/// @param patches  of PatchKernelWidth unknowns each
template<class Body>
void ForEachFactor(const BlockSource& source, const UnknownGroups& patches, Id begin, Id end,
  double smallestPivot, Body&& body)
{
  const auto dofOf = [&](Id patch) { return patches.unknown.data() + PatchKernelWidth * patch; };
  std::array<PatchFactor, PatchesAtOnce> factors;
  for (Id first = begin; first < end; first += PatchesAtOnce)
  {
    const int count = static_cast<int>(std::min<Id>(PatchesAtOnce, end - first));
    for (Id next = first + count; next < std::min(end, first + 2 * PatchesAtOnce); ++next)
    {
      FetchRows(source, dofOf(next));
    }
    FactorPatches(source, dofOf(first), count, smallestPivot, factors.data());
    for (int k = 0; k < count; ++k)
    {
      body(first + k, factors[k]);
    }
  }
}

} // namespace gridfem

#endif
