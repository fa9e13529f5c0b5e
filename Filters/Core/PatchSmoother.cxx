#include "BlockSweep.h"
#include "Smoother.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

namespace gridfem
{
namespace
{

constexpr int N = FunctionsPerPatch;

/// Pivots of the scaled block below this are rounding: the direction is left out.
constexpr double SmallestPivot = 1e-14;

/// Rounding V to single precision changes V S Vᵀ = I by some 6e-8 / sqrt(pivot). From this pivot on
/// that is 2 %, which a smoother does not feel; below it, as on flat faces, V is kept in double.
constexpr double SmallestSinglePivot = 1e-11;

/// Sizes that single precision holds with all its digits.
constexpr double LargestSingle = 1e30;

using LocalMatrix = Eigen::Matrix<double, N, N>;

/// A patch has `count` unknowns. The other places repeat the first one and have zeros in the
/// factor, so that the sweep needs no case distinction.
struct Patch
{
  std::array<Index, N> dof;
  Index count;
};

/// Vᵀ V is the inverse of a scaled block S on its numerically independent part.
struct InverseFactor
{
  LocalMatrix V = LocalMatrix::Zero(); // row k: zero but in the first k + 1 of `order`
  std::array<int, N> order;            // of the pivots; the unknowns that are left out come last
  double smallestPivot = 1.0;
};

/// Position, in `order` of the largest diagonal above SmallestPivot; -1 if none. NaN never is.
int FindPivot(const LocalMatrix& S, const std::array<int, N>& order, int begin, int end)
{
  int found = -1;
  double largest = SmallestPivot;
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

/// Symmetric elimination with the pivots of pivoted Cholesky, applied to the identity as well.
InverseFactor Factor(LocalMatrix S, int count)
{
  InverseFactor factor;
  std::iota(factor.order.begin(), factor.order.end(), 0);
  LocalMatrix rows = LocalMatrix::Identity();
  for (int step = 0; step < count; ++step)
  {
    const int found = FindPivot(S, factor.order, step, count);
    if (found < 0)
    {
      break;
    }
    std::swap(factor.order[step], factor.order[found]);
    const int p = factor.order[step];
    factor.smallestPivot = S(p, p);
    factor.V.row(step) = rows.row(p) / std::sqrt(S(p, p));
    for (int k = step + 1; k < count; ++k)
    {
      const int i = factor.order[k];
      const double part = S(i, p) / S(p, p);
      S.row(i) -= part * S.row(p);
      rows.row(i) -= part * rows.row(p);
    }
  }
  return factor;
}

/// The block of A with the patch's unknowns as rows and columns; zeros beyond `count`.
LocalMatrix PrincipalBlock(const SparseMatrix& A, const Patch& patch)
{
  LocalMatrix S = LocalMatrix::Zero();
  for (int i = 0; i < patch.count; ++i)
  {
    const Id end = A.rowBegin[patch.dof[i] + 1];
    Id k = A.rowBegin[patch.dof[i]];
    for (int j = 0; j < patch.count; ++j)
    {
      while (k < end && A.column[k] < patch.dof[j])
      {
        ++k;
      }
      if (k < end && A.column[k] == patch.dof[j])
      {
        S(i, j) = A.value[k];
      }
    }
  }
  return S;
}

/// The unknowns that can be solved for: used places, once, with a positive diagonal; ascending.
void SetUnknowns(const std::array<Index, N>& dof, const std::vector<double>& diagonal, Patch& patch)
{
  auto end = std::copy_if(dof.begin(), dof.end(), patch.dof.begin(),
    [&](Index unknown) { return unknown >= 0 && IsUsableDiagonal(diagonal[unknown]); });
  std::sort(patch.dof.begin(), end);
  end = std::unique(patch.dof.begin(), end);
  patch.count = static_cast<Index>(end - patch.dof.begin());
  std::fill(end, patch.dof.end(), patch.dof.front());
}

/// Puts the patch's unknowns in the order of the pivots.
/// @return  V for them, scaled back to A: lower triangular, and mirrored to the upper triangle
LocalMatrix SetFactor(
  const SparseMatrix& A, const std::vector<double>& diagonal, Patch& patch, bool& isSingle)
{
  Eigen::Matrix<double, N, 1> scale = Eigen::Matrix<double, N, 1>::Zero();
  for (int i = 0; i < patch.count; ++i)
  {
    scale[i] = 1.0 / std::sqrt(diagonal[patch.dof[i]]);
  }
  const InverseFactor factor =
    Factor(scale.asDiagonal() * PrincipalBlock(A, patch) * scale.asDiagonal(), patch.count);
  const std::array<Index, N> dof = patch.dof;
  LocalMatrix V = LocalMatrix::Zero();
  for (int j = 0; j < N; ++j)
  {
    patch.dof[j] = dof[factor.order[j]];
    for (int i = j; i < N; ++i)
    {
      V(i, j) = V(j, i) = factor.V(i, factor.order[j]) * scale[factor.order[j]];
    }
  }
  isSingle = factor.smallestPivot >= SmallestSinglePivot &&
             scale.head(patch.count).maxCoeff() / std::sqrt(factor.smallestPivot) < LargestSingle &&
             scale.head(patch.count).minCoeff() > 1.0 / LargestSingle;
  return V;
}

/// r = Vᵀ V r for one column: vectors run along the patch.
/// @param V  lower triangle, mirrored to the upper one, so that both products run along columns
template<class Real>
inline void ApplyInverse(const Real* V, double (&r)[N])
{
  double y[N] = {};
  for (int j = 0; j < N; ++j)
  {
    for (int i = 0; i < N; ++i)
    {
      y[i] += V[N * j + i] * (i >= j ? r[j] : 0.0);
    }
  }
  std::fill(r, r + N, 0.0);
  for (int j = 0; j < N; ++j)
  {
    for (int i = 0; i < N; ++i)
    {
      r[i] += V[N * j + i] * (i <= j ? y[j] : 0.0);
    }
  }
}

/// The same for several columns: vectors run along them.
template<class Real, class Lanes>
inline void ApplyInverse(const Real* V, Lanes (&r)[N])
{
  for (int i = N - 1; i >= 0; --i)
  {
    r[i] *= double(V[N * i + i]);
    for (int j = 0; j < i; ++j)
    {
      r[i] += double(V[N * i + j]) * r[j];
    }
  }
  for (int i = 0; i < N; ++i)
  {
    r[i] *= double(V[N * i + i]);
    for (int j = i + 1; j < N; ++j)
    {
      r[i] += double(V[N * i + j]) * r[j];
    }
  }
}

/// x += Vᵀ V (b - A x) on the patch.
template<class Chunk, class Real>
inline void Relax(const RowView& A, const std::array<Index, N>& dof, const Real* V, const double* b,
  double* x, Chunk chunk)
{
  using Lanes = typename Chunk::Lanes;
  std::conditional_t<Chunk::Width == 1, double, Lanes> r[N];
  for (int i = 0; i < N; ++i)
  {
    const Lanes residual = chunk.Row(b, dof[i]) - RowProduct(A, dof[i], x, chunk);
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
  for (int i = 0; i < N; ++i)
  {
    chunk.Row(x, dof[i]) += r[i];
  }
}

/// Factors of some patches, in visiting order.
struct PatchFactors
{
  /// The factor of a patch is single[factor], or exact[-1 - factor] where that is negative.
  struct Place
  {
    std::array<Index, N> dof;
    Index factor;
  };
  std::vector<Place> patches;
  std::vector<std::array<float, N * N>> single;
  std::vector<std::array<double, N * N>> exact;

  void Append(const std::array<Index, N>& dof, const LocalMatrix& V, bool isSingle)
  {
    if (isSingle)
    {
      patches.push_back({ dof, static_cast<Index>(single.size()) });
      Eigen::Map<Eigen::Matrix<float, N, N>>(single.emplace_back().data()) = V.cast<float>();
    }
    else
    {
      patches.push_back({ dof, -1 - static_cast<Index>(exact.size()) });
      Eigen::Map<LocalMatrix>(exact.emplace_back().data()) = V;
    }
  }

  void Append(const PatchFactors& more)
  {
    const Index singles = static_cast<Index>(single.size());
    const Index exacts = static_cast<Index>(exact.size());
    for (const Place& place : more.patches)
    {
      patches.push_back({ place.dof, place.factor + (place.factor < 0 ? -exacts : singles) });
    }
    single.insert(single.end(), more.single.begin(), more.single.end());
    exact.insert(exact.end(), more.exact.begin(), more.exact.end());
  }
};

class PatchSmoother : public Smoother
{
public:
  PatchSmoother(const SparseMatrix& A, const PatchOrder& order, int threads);

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override;

  std::size_t Memory() const override
  {
    return factors_.patches.size() * sizeof(factors_.patches.front()) +
           factors_.single.size() * sizeof(factors_.single.front()) +
           factors_.exact.size() * sizeof(factors_.exact.front()) + ranges_.Memory();
  }

private:
  Index rows_;
  PatchFactors factors_;
  BlockRanges ranges_;
};

PatchSmoother::PatchSmoother(const SparseMatrix& A, const PatchOrder& order, int threads)
  : rows_(A.rows)
{
  CheckOrder(A, order);
  const Id blocks = std::max<Id>(0, static_cast<Id>(order.blockBegin.size()) - 1);
  const std::vector<double> diagonal = A.Diagonal(threads);
  std::vector<PatchFactors> parts(blocks);
  ParallelBlocks(blocks, threads,
    [&](Id block)
    {
      for (Id p = order.blockBegin[block]; p < order.blockBegin[block + 1]; ++p)
      {
        Patch patch;
        SetUnknowns(order.dof[p], diagonal, patch);
        if (patch.count > 0)
        {
          bool isSingle = false;
          const LocalMatrix V = SetFactor(A, diagonal, patch, isSingle);
          parts[block].Append(patch.dof, V, isSingle);
        }
      }
    });
  ranges_.colourBegin = order.colourBegin;
  ranges_.blockBegin = { 0 };
  for (PatchFactors& part : parts)
  {
    factors_.Append(std::exchange(part, {}));
    ranges_.blockBegin.push_back(static_cast<Id>(factors_.patches.size()));
  }
}

void PatchSmoother::Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x,
  SweepDirection direction, int threads) const
{
  CheckSweep(A, rows_, b, x);
  const RowView rows(A);
  SweepBlocks(ranges_, x.cols(), direction, 128 * static_cast<Id>(factors_.patches.size()), threads,
    [&](Id p, auto chunk)
    {
      const PatchFactors::Place& patch = factors_.patches[p];
      if (patch.factor >= 0)
      {
        Relax(rows, patch.dof, factors_.single[patch.factor].data(), b.data(), x.data(), chunk);
      }
      else
      {
        Relax(rows, patch.dof, factors_.exact[-1 - patch.factor].data(), b.data(), x.data(), chunk);
      }
    });
}

} // namespace

std::unique_ptr<Smoother> MakePatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads)
{
  return std::make_unique<PatchSmoother>(A, order, threads);
}

} // namespace gridfem
