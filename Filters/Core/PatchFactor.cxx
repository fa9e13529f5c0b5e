#include "PatchFactor.h"

#include "BlockSweep.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gridfem
{
namespace
{

constexpr int N = FunctionsPerPatch;

/// Sizes that single precision holds with all its digits.
constexpr double LargestSingle = 1e30;

/// The unknowns of a patch, `count` of them.
struct Patch
{
  std::array<Index, N> dof;
  Index count;
};

/// Vᵀ V is the inverse of a scaled block S on its numerically independent part.
struct InverseFactor
{
  PatchMatrix row = PatchMatrix::Zero(); // column k: row k of V; zero but in the first k + 1 of
                                         // `order`
  std::array<int, N> order;              // of the pivots; the unknowns that are left out come last
  int rank = 0;
  double smallestPivot = 1.0;
};

/// Position, in `order` of the largest diagonal above `smallest`; -1 if none. NaN never is.
int FindPivot(
  const PatchMatrix& S, const std::array<int, N>& order, int begin, int end, double smallest)
{
  int found = -1;
  double largest = smallest;
  for (int k = begin; k < end; ++k)
  {
    if (S(order[k], order[k]) > largest)
    {
      largest = S(order[k], order[k]);
      found = k;
    }
  }
  return found;
}

/// Symmetric elimination with the pivots of pivoted Cholesky, applied to the identity as well. Both
/// matrices are stored so that vectors run along columns.
InverseFactor Factor(PatchMatrix S, int count, double smallestPivot)
{
  InverseFactor factor;
  std::iota(factor.order.begin(), factor.order.end(), 0);
  PatchMatrix rows = PatchMatrix::Identity();
  for (int step = 0; step < count; ++step)
  {
    const int found = FindPivot(S, factor.order, step, count, smallestPivot);
    if (found < 0)
    {
      break;
    }
    std::swap(factor.order[step], factor.order[found]);
    const int p = factor.order[step];
    factor.rank = step + 1;
    factor.smallestPivot = S(p, p);
    factor.row.col(step) = rows.col(p) / std::sqrt(S(p, p));
    for (int k = step + 1; k < count; ++k)
    {
      const int i = factor.order[k];
      const double part = S(p, i) / S(p, p);
      S.col(i) -= part * S.col(p);
      rows.col(i) -= part * rows.col(p);
    }
  }
  return factor;
}

/// The block of A with the patch's unknowns, which ascend, as rows and columns; zeros beyond
/// `count`.
PatchMatrix PrincipalBlock(const BlockSource& source, const Patch& patch)
{
  const SparseMatrix& A = source.A;
  PatchMatrix S = PatchMatrix::Zero();
  for (int i = 0; i < patch.count; ++i)
  {
    const Id end = A.rowBegin[patch.dof[i] + 1];
    Id k = source.diagonal[patch.dof[i]];
    S(i, i) = A.value[k];
    for (int j = i + 1; j < patch.count; ++j)
    {
      while (k < end && A.column[k] < patch.dof[j])
      {
        ++k;
      }
      if (k < end && A.column[k] == patch.dof[j])
      {
        S(i, j) = S(j, i) = A.value[k];
      }
    }
  }
  return S;
}

/// The unknowns that can be solved for: used places, once, with a positive diagonal; ascending.
Patch UnknownsOf(const std::array<Index, N>& dof, const BlockSource& source)
{
  Patch patch;
  auto end = std::copy_if(dof.begin(), dof.end(), patch.dof.begin(),
    [&](Index unknown) { return unknown >= 0 && source.diagonal[unknown] >= 0; });
  std::sort(patch.dof.begin(), end);
  end = std::unique(patch.dof.begin(), end);
  patch.count = static_cast<Index>(end - patch.dof.begin());
  std::fill(end, patch.dof.end(), patch.count > 0 ? patch.dof.front() : 0);
  return patch;
}

} // namespace

BlockSource::BlockSource(const SparseMatrix& matrix, int threads) : A(matrix), diagonal(matrix.rows)
{
  ParallelRanges(A.rows, threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        const Index* const last = A.column.data() + A.rowBegin[row + 1];
        const Index* const found =
          std::lower_bound(A.column.data() + A.rowBegin[row], last, static_cast<Index>(row));
        const Id place = found - A.column.data();
        const bool isUsable = found != last && *found == row && IsUsableDiagonal(A.value[place]);
        diagonal[row] = isUsable ? place : -1;
      }
    });
}

PatchFactor FactorPatch(
  const BlockSource& source, const std::array<Index, N>& dof, double smallestPivot)
{
  const Patch patch = UnknownsOf(dof, source);
  PatchFactor result;
  result.dof = patch.dof;
  result.count = patch.count;
  result.V.setZero();
  if (patch.count == 0)
  {
    return result;
  }
  Eigen::Matrix<double, N, 1> scale = Eigen::Matrix<double, N, 1>::Zero();
  for (int i = 0; i < patch.count; ++i)
  {
    scale[i] = 1.0 / std::sqrt(source.Diagonal(patch.dof[i]));
  }
  const InverseFactor factor =
    Factor(scale.asDiagonal() * PrincipalBlock(source, patch) * scale.asDiagonal(), patch.count,
      smallestPivot);
  for (int j = 0; j < N; ++j)
  {
    result.dof[j] = patch.dof[factor.order[j]];
    for (int i = j; i < N; ++i)
    {
      result.V(i, j) = result.V(j, i) = factor.row(factor.order[j], i) * scale[factor.order[j]];
    }
  }
  result.smallestPivot = factor.smallestPivot;
  result.isComplete = factor.rank == patch.count;
  result.hasLargeScales =
    !(scale.head(patch.count).maxCoeff() / std::sqrt(factor.smallestPivot) < LargestSingle &&
      scale.head(patch.count).minCoeff() > 1.0 / LargestSingle);
  return result;
}

} // namespace gridfem
