#include "BlockSweep.h"
#include "Parallel.h"
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
  LocalMatrix row = LocalMatrix::Zero(); // column k: row k of V; zero but in the first k + 1 of
                                         // `order`
  std::array<int, N> order;              // of the pivots; the unknowns that are left out come last
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

/// Symmetric elimination with the pivots of pivoted Cholesky, applied to the identity as well. Both
/// matrices are stored so that vectors run along columns.
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

/// What the blocks are cut from: a matrix, and where the diagonal is in its rows.
struct BlockSource
{
  const SparseMatrix& A;
  Array<Id> diagonal; // per row; -1 where it is not a positive number

  BlockSource(const SparseMatrix& matrix, int threads) : A(matrix), diagonal(matrix.rows)
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

  double Diagonal(Index row) const { return A.value[diagonal[row]]; }
};

/// The block of A with the patch's unknowns, which ascend, as rows and columns; zeros beyond
/// `count`.
LocalMatrix PrincipalBlock(const BlockSource& source, const Patch& patch)
{
  const SparseMatrix& A = source.A;
  LocalMatrix S = LocalMatrix::Zero();
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

/// Puts the patch's unknowns in the order of the pivots.
/// @return  V for them, scaled back to A: lower triangular, and mirrored to the upper triangle
LocalMatrix SetFactor(const BlockSource& source, Patch& patch, bool& isSingle)
{
  Eigen::Matrix<double, N, 1> scale = Eigen::Matrix<double, N, 1>::Zero();
  for (int i = 0; i < patch.count; ++i)
  {
    scale[i] = 1.0 / std::sqrt(source.Diagonal(patch.dof[i]));
  }
  const InverseFactor factor =
    Factor(scale.asDiagonal() * PrincipalBlock(source, patch) * scale.asDiagonal(), patch.count);
  const std::array<Index, N> dof = patch.dof;
  LocalMatrix V = LocalMatrix::Zero();
  for (int j = 0; j < N; ++j)
  {
    patch.dof[j] = dof[factor.order[j]];
    for (int i = j; i < N; ++i)
    {
      V(i, j) = V(j, i) = factor.row(factor.order[j], i) * scale[factor.order[j]];
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

class PatchSmoother : public Smoother
{
public:
  PatchSmoother(const SparseMatrix& A, const PatchOrder& order, int threads);

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override;

  std::size_t Memory() const override;

private:
  /// A patch, in visiting order.
  struct Place
  {
    std::array<Index, N> dof;
    Index precision; // of its factor
  };
  enum Precision : Index
  {
    None, // no unknown can be solved for
    Single,
    Double
  };

  void SetPatch(const BlockSource& source, const std::array<Index, N>& dof, Id p);

  Index rows_;
  BlockRanges ranges_;
  Array<Place> patches_;
  // The factor of patch p is entry p of one of them. What is not used is never touched, and so
  // takes no memory.
  Array<std::array<float, N * N>> single_;
  Array<std::array<double, N * N>> double_;
};

PatchSmoother::PatchSmoother(const SparseMatrix& A, const PatchOrder& order, int threads)
  : rows_(A.rows)
{
  CheckOrder(A, order);
  ranges_.colourBegin = order.colourBegin;
  ranges_.blockBegin = order.blockBegin.empty() ? std::vector<Id>{ 0 } : order.blockBegin;
  patches_.resize(order.dof.size());
  single_.resize(order.dof.size());
  double_.resize(order.dof.size());
  const BlockSource source(A, threads);
  ParallelRanges(static_cast<Id>(order.dof.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id p = begin; p < end; ++p)
      {
        this->SetPatch(source, order.dof[p], p);
      }
    });
}

void PatchSmoother::SetPatch(const BlockSource& source, const std::array<Index, N>& dof, Id p)
{
  Patch patch = UnknownsOf(dof, source);
  if (patch.count == 0)
  {
    patches_[p] = { patch.dof, None };
    return;
  }
  bool isSingle = false;
  const LocalMatrix V = SetFactor(source, patch, isSingle);
  patches_[p] = { patch.dof, isSingle ? Single : Double };
  if (isSingle)
  {
    Eigen::Map<Eigen::Matrix<float, N, N>>(single_[p].data()) = V.cast<float>();
  }
  else
  {
    Eigen::Map<LocalMatrix>(double_[p].data()) = V;
  }
}

std::size_t PatchSmoother::Memory() const
{
  std::size_t bytes = patches_.size() * sizeof(patches_.front()) + ranges_.Memory();
  for (const Place& patch : patches_)
  {
    bytes += patch.precision == Single   ? sizeof(single_.front())
             : patch.precision == Double ? sizeof(double_.front())
                                         : 0;
  }
  return bytes;
}

void PatchSmoother::Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x,
  SweepDirection direction, int threads) const
{
  CheckSweep(A, rows_, b, x);
  const RowView rows(A);
  SweepBlocks(ranges_, x.cols(), direction, 128 * static_cast<Id>(patches_.size()), threads,
    [&](Id p, auto chunk)
    {
      const Place& patch = patches_[p];
      if (patch.precision == Single)
      {
        Relax(rows, patch.dof, single_[p].data(), b.data(), x.data(), chunk);
      }
      else if (patch.precision == Double)
      {
        Relax(rows, patch.dof, double_[p].data(), b.data(), x.data(), chunk);
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
