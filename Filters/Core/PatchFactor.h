// The inverse of a patch's block of a matrix, as patch smoothers of any precision store it.
#ifndef GridFEM_PatchFactor_h
#define GridFEM_PatchFactor_h

#include "SparseMatrix.h"

#include <array>

namespace gridfem
{

using PatchMatrix = Eigen::Matrix<double, FunctionsPerPatch, FunctionsPerPatch>;

/// What the blocks are cut from: a matrix, and where the diagonal is in its rows. Keeps a
/// reference.
struct BlockSource
{
  const SparseMatrix& A;
  Array<Id> diagonal; // per row; -1 where it is not a positive number

  BlockSource(const SparseMatrix& matrix, int threads);

  double Diagonal(Index row) const { return A.value[diagonal[row]]; }
};

/// Vᵀ V is the inverse of the block on its numerically independent part. A patch has `count`
/// unknowns. The other places repeat the first one and have zeros in V, so that a sweep needs no
/// case distinction.
struct PatchFactor
{
  std::array<Index, FunctionsPerPatch> dof; // in the order of the pivots
  Index count = 0;                          // 0: no unknown can be solved for
  PatchMatrix V;               // lower triangular, and mirrored to the upper triangle; zero without
                               // unknowns
  double smallestPivot = 1.0;  // kept, of the block scaled to unit diagonal
  bool isComplete = true;      // no pivot was left out
  bool hasLargeScales = false; // V would leave the range of single precision
};

/// Pivoted Cholesky of the scaled block, stopped at the smallest pivot that counts. Places of dof
/// with -1 are not used; unknowns without a positive diagonal are left out.
PatchFactor FactorPatch(
  const BlockSource& source, const std::array<Index, FunctionsPerPatch>& dof, double smallestPivot);

} // namespace gridfem

#endif
