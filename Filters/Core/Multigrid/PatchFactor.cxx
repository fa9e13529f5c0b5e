#include "Multigrid/PatchFactor.h"

#include "Algebra/PivotedCholesky.h"
#include "Base/Parallel.h"
#include "Base/SimdLanes.h"
#include "Multigrid/BlockSweep.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace gridfem
{
namespace
{

constexpr int N = PatchKernelWidth;

/// Numbers up to this size, and their inverses, keep all digits in single precision.
constexpr double LargestSingle = 1e30;

/// The unknowns of a patch; `count` of them are used.
struct Patch
{
  std::array<Index, N> dof;
  Index count;
};

/// Vᵀ V is the inverse of a scaled block S on its numerically independent part.
struct InverseFactor
{
  // Column k is row k of V. It is zero except in the first k + 1 unknowns of `order`.
  PatchMatrix row = PatchMatrix::Zero();
  std::array<int, N> order; // of the pivots; unknowns that are left out come last
  int rank = 0;
  double smallestPivot = 1.0;
};

/// Position in `order` of the largest diagonal entry above `smallest`; -1 if none. NaN is never
/// chosen.
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

/// Calls visit(i, j, value) for the upper triangle of a patch's block of A. The unknowns of the
/// patch ascend.
template<class Visit>
void ForEachEntry(const BlockSource& source, const Patch& patch, Visit&& visit)
{
  const SparseMatrix& A = source.A;
  for (int i = 0; i < patch.count; ++i)
  {
    const Id end = A.rowBegin[patch.dof[i] + 1];
    Id k = source.row[patch.dof[i]].diagonal;
    visit(i, i, A.value[k]);
    for (int j = i + 1; j < patch.count; ++j)
    {
      while (k < end && A.column[k] < patch.dof[j])
      {
        ++k;
      }
      visit(i, j, k < end && A.column[k] == patch.dof[j] ? A.value[k] : 0.0);
    }
  }
}

/// The patch's block, with zeros beyond `count`.
PatchMatrix PrincipalBlock(const BlockSource& source, const Patch& patch)
{
  PatchMatrix S = PatchMatrix::Zero();
  ForEachEntry(source, patch, [&](int i, int j, double value) { S(i, j) = S(j, i) = value; });
  return S;
}

/// Whether a place is used and its unknown has a positive diagonal.
bool IsSolvable(const BlockSource& source, Index unknown)
{
  return unknown >= 0 && source.row[unknown].diagonal >= 0;
}

/// Copies each solvable unknown once, in ascending order.
/// @return  the end of the copy
template<class From, class To>
To CopySolvable(From begin, From end, const BlockSource& source, To copy)
{
  const To last =
    std::copy_if(begin, end, copy, [&](Index unknown) { return IsSolvable(source, unknown); });
  std::sort(copy, last);
  return std::unique(copy, last);
}

/// The unknowns of a patch that can be solved for.
Patch UnknownsOf(const Index* dof, const BlockSource& source)
{
  // Nearly always all unknowns are solvable. The place of an unknown is then the number of smaller
  // unknowns.
  Patch patch;
  patch.dof.fill(-1);
  patch.count = N;
  for (int i = 0; i < N; ++i)
  {
    int smaller = 0;
    for (int j = 0; j < N; ++j)
    {
      smaller += dof[j] < dof[i] ? 1 : 0;
    }
    patch.dof[smaller] = dof[i];
  }
  if (std::all_of(patch.dof.begin(), patch.dof.end(),
        [&](Index unknown) { return IsSolvable(source, unknown); }))
  {
    return patch;
  }
  const auto end = CopySolvable(dof, dof + N, source, patch.dof.begin());
  patch.count = static_cast<Index>(end - patch.dof.begin());
  std::fill(end, patch.dof.end(), patch.count > 0 ? patch.dof.front() : 0);
  return patch;
}

/// The diagonal scaling of a patch's block; zeros beyond `count`.
using PatchScale = Eigen::Matrix<double, N, 1>;

PatchScale ScaleOf(const BlockSource& source, const Patch& patch)
{
  PatchScale scale = PatchScale::Zero();
  for (int i = 0; i < patch.count; ++i)
  {
    scale[i] = source.row[patch.dof[i]].scale;
  }
  return scale;
}

template<class Scale>
bool HasLargeScales(const Scale& scale, double smallestPivot)
{
  return !(scale.maxCoeff() / std::sqrt(smallestPivot) < LargestSingle &&
           scale.minCoeff() > 1.0 / LargestSingle);
}

/// Factors one patch with pivots.
/// @param block  not scaled
void FactorWithPivots(const PatchMatrix& block, const Patch& patch, const PatchScale& scale,
  double smallestPivot, PatchFactor& result)
{
  result = PatchFactor();
  result.dof = patch.dof;
  result.count = patch.count;
  if (patch.count == 0)
  {
    return;
  }
  const InverseFactor factor =
    Factor(scale.asDiagonal() * block * scale.asDiagonal(), patch.count, smallestPivot);
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
  result.hasLargeScales = HasLargeScales(scale.head(patch.count), factor.smallestPivot);
}

static_assert(PatchesAtOnce == LaneCount && N == LaneCount);

/// Scaled blocks of patches without a missing unknown, and the inverses of their factors. Each
/// patch has a lane.
class LaneFactors
{
public:
  /// Starts from unit matrices.
  LaneFactors()
  {
    for (int j = 0; j < N; ++j)
    {
      for (int i = 0; i <= j; ++i)
      {
        S_[i][j].setConstant(i == j ? 1.0 : 0.0);
      }
      scale_[j].setOnes();
    }
  }

  void Set(int lane, const BlockSource& source, const Patch& patch, const PatchScale& scale)
  {
    for (int i = 0; i < N; ++i)
    {
      scale_[i][lane] = scale[i];
    }
    ForEachEntry(source, patch,
      [&](int i, int j, double value) { S_[i][j][lane] = scale[i] * value * scale[j]; });
  }

  /// Elimination in the order of the unknowns, applied to the identity as well.
  void Factor()
  {
    for (int step = 0; step < N; ++step)
    {
      V_[step][step].setOnes();
      const Lanes inverse = 1.0 / S_[step][step];
      for (int i = step + 1; i < N; ++i)
      {
        const Lanes part = S_[step][i] * inverse;
        for (int j = i; j < N; ++j)
        {
          S_[i][j] -= part * S_[step][j];
        }
        for (int j = 0; j < step; ++j)
        {
          V_[i][j] -= part * V_[step][j];
        }
        V_[i][step] = -part;
      }
    }
    for (int i = 0; i < N; ++i)
    {
      const Lanes factor = 1.0 / S_[i][i].sqrt();
      for (int j = 0; j <= i; ++j)
      {
        V_[i][j] *= factor;
      }
    }
  }

  /// NaN if any pivot is NaN.
  double SmallestPivot(int lane) const
  {
    double smallest = 1.0;
    for (int i = 0; i < N; ++i)
    {
      const double pivot = S_[i][i][lane];
      smallest = pivot >= smallest ? smallest : pivot;
    }
    return smallest;
  }

  /// The factors of the first `count` patches, scaled and mirrored.
  void Get(int count, PatchFactor* factors) const
  {
    for (int i = 0; i < N; ++i)
    {
      LaneBlock row;
      for (int j = 0; j < N; ++j)
      {
        row.col(j) = V_[std::max(i, j)][std::min(i, j)] * scale_[std::min(i, j)];
      }
      std::array<double*, LaneCount> column{};
      for (int lane = 0; lane < count; ++lane)
      {
        column[lane] = factors[lane].V.col(i).data();
      }
      StoreLanes(row, column, count, 0);
    }
  }

private:
  Lanes S_[N][N]; // upper triangle; in the end the pivots are on the diagonal
  Lanes V_[N][N]; // lower triangle
  Lanes scale_[N];
};

/// The order of elimination does not matter if all pivots are at least this large.
double SafePivot(double smallestPivot)
{
  return std::max(1e-10, 100.0 * smallestPivot);
}

} // namespace

BlockSource::BlockSource(const SparseMatrix& matrix, int threads) : A(matrix), row(matrix.rows)
{
  ParallelRanges(A.rows, threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        // Counts the columns before the diagonal. In short rows that is faster than bisection.
        const Index* const first = A.column.data() + A.rowBegin[i];
        const Index* const last = A.column.data() + A.rowBegin[i + 1];
        const Index* const found =
          first + std::count_if(first, last, [i](Index column) { return column < i; });
        const Id place = found - A.column.data();
        const bool isUsable = found != last && *found == i && IsUsableDiagonal(A.value[place]);
        row[i] = isUsable ? Row{ place, 1.0 / std::sqrt(A.value[place]) } : Row{ -1, 0.0 };
      }
    });
}

void FactorPatches(const BlockSource& source, const Index* dof, int count, double smallestPivot,
  PatchFactor* factors)
{
  std::array<Patch, PatchesAtOnce> patch;
  std::array<PatchScale, PatchesAtOnce> scale;
  LaneFactors lanes;
  for (int k = 0; k < count; ++k)
  {
    patch[k] = UnknownsOf(dof + N * k, source);
    scale[k] = ScaleOf(source, patch[k]);
    if (patch[k].count == N)
    {
      lanes.Set(k, source, patch[k], scale[k]);
    }
  }
  lanes.Factor();
  lanes.Get(count, factors);
  for (int k = 0; k < count; ++k)
  {
    PatchFactor& result = factors[k];
    result.smallestPivot = lanes.SmallestPivot(k);
    if (!(patch[k].count == N && result.smallestPivot >= SafePivot(smallestPivot)))
    {
      FactorWithPivots(PrincipalBlock(source, patch[k]), patch[k], scale[k], smallestPivot, result);
      continue;
    }
    result.dof = patch[k].dof;
    result.count = N;
    result.isComplete = true;
    result.hasLargeScales = HasLargeScales(scale[k], result.smallestPivot);
  }
}

GroupFactor FactorGroup(const BlockSource& source, UnknownGroup group, double smallestPivot)
{
  GroupFactor result;
  std::vector<Index>& unknown = result.unknown;
  unknown.resize(group.size());
  unknown.erase(CopySolvable(group.begin(), group.end(), source, unknown.begin()), unknown.end());
  const auto count = static_cast<Index>(unknown.size());
  if (count == 0)
  {
    unknown.push_back(0);
    return result;
  }
  Eigen::VectorXd scale(count);
  Eigen::MatrixXd S(count, count);
  for (Index i = 0; i < count; ++i)
  {
    scale[i] = source.row[unknown[i]].scale;
    for (Index j = 0; j <= i; ++j)
    {
      S(i, j) = S(j, i) = scale[i] * source.A.Coefficient(unknown[i], unknown[j]) * scale[j];
    }
  }
  const std::vector<Index> pivots = PivotedCholesky(S, smallestPivot);
  const auto rank = static_cast<Index>(pivots.size());
  result.V.setIdentity(rank, rank);
  S.topLeftCorner(rank, rank).triangularView<Eigen::Lower>().solveInPlace(result.V);
  std::vector<Index> ordered;
  for (const Index pivot : pivots)
  {
    result.V.col(static_cast<Index>(ordered.size())) *= scale[pivot];
    ordered.push_back(unknown[pivot]);
    unknown[pivot] = -1;
  }
  std::copy_if(unknown.begin(), unknown.end(), std::back_inserter(ordered),
    [](Index rest) { return rest >= 0; });
  unknown = std::move(ordered);
  const double root = rank > 0 ? S.diagonal().head(rank).minCoeff() : 1.0;
  result.isComplete = rank == count;
  result.hasLargeScales = HasLargeScales(scale, root * root);
  return result;
}

} // namespace gridfem
