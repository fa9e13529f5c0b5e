#include "BlockSweep.h"
#include "Smoother.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

constexpr int N = FunctionsPerPatch;

/// Pivots of the scaled block below this are rounding: the direction is left out.
constexpr double SmallestPivot = 1e-14;

using LocalMatrix = Eigen::Matrix<double, N, N>;

/// A patch has `count` unknowns, ascending. The other places repeat the first one and have zeros in
/// the inverse, so that the sweep needs no case distinction.
struct Patch
{
  LocalMatrix inverse;
  std::array<Index, N> dof;
  Index count;
};

/// Replaces a symmetric matrix with unit diagonal by the inverse of its numerically independent
/// part, zeros elsewhere: symmetric Gauss-Jordan steps on the largest remaining diagonal, which are
/// the pivots of pivoted Cholesky. NaN is never a pivot.
void InvertIndependentPart(LocalMatrix& S, int count)
{
  unsigned kept = 0;
  for (int step = 0; step < count; ++step)
  {
    int pivot = -1;
    double largest = SmallestPivot;
    for (int i = 0; i < count; ++i)
    {
      if (!(kept >> i & 1u) && S(i, i) > largest)
      {
        largest = S(i, i);
        pivot = i;
      }
    }
    if (pivot < 0)
    {
      break;
    }
    kept |= 1u << pivot;
    const Eigen::Matrix<double, N, 1> column = S.col(pivot);
    const Eigen::Matrix<double, N, 1> scaled = column / largest;
    for (int j = 0; j < N; ++j)
    {
      S.col(j) -= scaled * column[j];
    }
    S.col(pivot) = scaled;
    S.row(pivot) = scaled;
    S(pivot, pivot) = -1.0 / largest;
  }
  for (int j = 0; j < N; ++j)
  {
    for (int i = 0; i < N; ++i)
    {
      S(i, j) = (kept >> i & kept >> j & 1u) ? -S(i, j) : 0.0;
    }
  }
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

void SetInverse(const SparseMatrix& A, const std::vector<double>& diagonal, Patch& patch)
{
  Eigen::Matrix<double, N, 1> scale = Eigen::Matrix<double, N, 1>::Zero();
  for (int i = 0; i < patch.count; ++i)
  {
    scale[i] = 1.0 / std::sqrt(diagonal[patch.dof[i]]);
  }
  patch.inverse = scale.asDiagonal() * PrincipalBlock(A, patch) * scale.asDiagonal();
  InvertIndependentPart(patch.inverse, patch.count);
  patch.inverse = scale.asDiagonal() * patch.inverse * scale.asDiagonal();
}

/// x += inverse (b - A x) on the patch.
template<class Chunk>
inline void Relax(const RowView& A, const Patch& patch, const double* b, double* x, Chunk chunk)
{
  using Lanes = typename Chunk::Lanes;
  Lanes residual[N];
  for (int i = 0; i < N; ++i)
  {
    const Index row = patch.dof[i];
    residual[i] = chunk.Row(b, row) - RowProduct(A, row, x, chunk);
  }
  if constexpr (Chunk::Width == 1)
  {
    Eigen::Matrix<double, N, 1> even = patch.inverse.col(0) * residual[0][0];
    Eigen::Matrix<double, N, 1> odd = patch.inverse.col(1) * residual[1][0];
    for (int j = 2; j < N; j += 2)
    {
      even += patch.inverse.col(j) * residual[j][0];
      odd += patch.inverse.col(j + 1) * residual[j + 1][0];
    }
    even += odd;
    for (int i = 0; i < N; ++i)
    {
      x[chunk.Offset(patch.dof[i])] += even[i];
    }
  }
  else
  {
    for (int i = 0; i < N; ++i)
    {
      Lanes step = patch.inverse(0, i) * residual[0];
      for (int j = 1; j < N; ++j)
      {
        step += patch.inverse(j, i) * residual[j];
      }
      chunk.Row(x, patch.dof[i]) += step;
    }
  }
}

class PatchSmoother : public Smoother
{
public:
  PatchSmoother(const SparseMatrix& A, const PatchOrder& order, int threads);

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override;

  std::size_t Memory() const override { return patches_.size() * sizeof(Patch) + ranges_.Memory(); }

private:
  void DropEmptyPatches();

  Index rows_;
  std::vector<Patch> patches_; // in visiting order
  BlockRanges ranges_;
};

PatchSmoother::PatchSmoother(const SparseMatrix& A, const PatchOrder& order, int threads)
  : rows_(A.rows)
{
  CheckOrder(A, order);
  ranges_.blockBegin = order.blockBegin;
  ranges_.colourBegin = order.colourBegin;
  patches_.resize(order.dof.size());
  const std::vector<double> diagonal = A.Diagonal();
  ParallelRanges(
    static_cast<Id>(patches_.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id p = begin; p < end; ++p)
      {
        SetUnknowns(order.dof[p], diagonal, patches_[p]);
        if (patches_[p].count > 0)
        {
          SetInverse(A, diagonal, patches_[p]);
        }
      }
    },
    512);
  this->DropEmptyPatches();
}

void PatchSmoother::DropEmptyPatches()
{
  Id kept = 0;
  Id begin = 0;
  for (std::size_t block = 1; block < ranges_.blockBegin.size(); ++block)
  {
    const Id end = ranges_.blockBegin[block];
    for (Id p = begin; p < end; ++p)
    {
      if (patches_[p].count > 0)
      {
        patches_[kept++] = patches_[p];
      }
    }
    begin = end;
    ranges_.blockBegin[block] = kept;
  }
  patches_.resize(kept);
}

void PatchSmoother::Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x,
  SweepDirection direction, int threads) const
{
  CheckSweep(A, rows_, b, x);
  const RowView rows(A);
  SweepBlocks(ranges_, x.cols(), direction, 128 * static_cast<Id>(patches_.size()), threads,
    [&](Id p, auto chunk) { Relax(rows, patches_[p], b.data(), x.data(), chunk); });
}

} // namespace

std::unique_ptr<Smoother> MakePatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads)
{
  return std::make_unique<PatchSmoother>(A, order, threads);
}

} // namespace gridfem
