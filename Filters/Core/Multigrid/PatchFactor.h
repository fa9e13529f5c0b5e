// The inverse of a patch's block of a matrix, as patch smoothers of any precision store it.
#ifndef GridFEM_PatchFactor_h
#define GridFEM_PatchFactor_h

#include "Algebra/SparseMatrix.h"
#include "Base/Prefetch.h"

#include <algorithm>
#include <array>

namespace gridfem
{

using PatchMatrix = Eigen::Matrix<double, FunctionsPerPatch, FunctionsPerPatch>;

/// What the blocks are cut from: a matrix, and where the diagonal is in its rows. Keeps a
/// reference.
struct BlockSource
{
  const SparseMatrix& A;
  struct Row
  {
    Id diagonal;  // where it is; -1 where it is not a positive number
    double scale; // 1 / √diagonal; 0 where it is not a positive number
  };
  Array<Row> row;

  BlockSource(const SparseMatrix& matrix, int threads);
};

/// Vᵀ V is the inverse of the block on its numerically independent part. A patch has `count`
/// unknowns. The other places repeat the first one and have zeros in V, so that a sweep needs no
/// case distinction.
struct PatchFactor
{
  // Lower triangular, and mirrored to the upper triangle; zero without unknowns.
  PatchMatrix V = PatchMatrix::Zero();
  std::array<Index, FunctionsPerPatch> dof; // in the order of elimination
  double smallestPivot = 1.0;               // kept, of the block scaled to unit diagonal
  Index count = 0;                          // 0: no unknown can be solved for
  bool isComplete = true;                   // no pivot was left out
  bool hasLargeScales = false;              // V would leave the range of single precision
};

/// For sweeps in single precision: directions with smaller pivots of a patch's scaled block are
/// left out: rounding to single precision would disturb their corrections more than it serves the
/// others. Pivots are about the square of a flat face's slope against the grid. Boxes of which all
/// faces have one slope need as many steps as in double with pivots of 3e-6, twice as many with
/// 3e-7, and do not converge with 3e-8.
constexpr double SmallestPivotOfSingle = 1e-6;

/// As many patches are factored together as vector registers have lanes.
constexpr int PatchesAtOnce = 8;

/// Pivoted Cholesky of the scaled blocks, stopped at the smallest pivot that counts. Blocks whose
/// pivots stay large in the order of their unknowns keep that order: it is as exact, and without
/// choices all lanes go at once. Places of dof with -1 are not used; unknowns without a positive
/// diagonal are left out.
/// @param dof, factors  `count` of them, at most PatchesAtOnce
void FactorPatches(const BlockSource& source, const std::array<Index, FunctionsPerPatch>* dof,
  int count, double smallestPivot, PatchFactor* factors);

/// What a patch's block is cut from: its rows from the diagonal on.
EIGEN_ALWAYS_INLINE void FetchRows(
  const BlockSource& source, const std::array<Index, FunctionsPerPatch>& dof)
{
  for (const Index unknown : dof)
  {
    const Id k = unknown >= 0 ? source.row[unknown].diagonal : -1;
    if (k >= 0)
    {
      Fetch(source.A.column.data() + k);
      Fetch<2>(source.A.value.data() + k);
    }
  }
}

/// Calls body(patch, factor) for the patches from `begin` to `end`.
template<class Body>
void ForEachFactor(const BlockSource& source, const std::array<Index, FunctionsPerPatch>* dof,
  Id begin, Id end, double smallestPivot, Body&& body)
{
  std::array<PatchFactor, PatchesAtOnce> factors;
  for (Id first = begin; first < end; first += PatchesAtOnce)
  {
    const int count = static_cast<int>(std::min<Id>(PatchesAtOnce, end - first));
    for (Id next = first + count; next < std::min(end, first + 2 * PatchesAtOnce); ++next)
    {
      FetchRows(source, dof[next]);
    }
    FactorPatches(source, dof + first, count, smallestPivot, factors.data());
    for (int k = 0; k < count; ++k)
    {
      body(first + k, factors[k]);
    }
  }
}

} // namespace gridfem

#endif
