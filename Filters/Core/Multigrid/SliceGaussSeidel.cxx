#include "Multigrid/BlockSweep.h"
#include "Multigrid/Smoother.h"

#include <algorithm>
#include <numeric>

namespace gridfem
{
namespace
{

/// Number of slabs, if there are enough slices. It is larger than the number of threads.
constexpr Id MostSlabs = 64;

class SliceGaussSeidel : public Smoother
{
public:
  SliceGaussSeidel(const SparseMatrix& A, const PatchOrder& order, int sweeps);

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override;

  std::size_t Memory() const override
  {
    return unknown_.size() * (sizeof(Index) + sizeof(double)) +
           (sliceBegin_.size() + slabBegin_.size()) * sizeof(Id);
  }

private:
  /// Slices first .. last - 1 that sweep number `sweep` visits in a slab, or at the boundary below
  /// a slab.
  struct Range
  {
    Id first;
    Id last;
  };
  Range SlabSlices(Id slab, int sweep) const;
  Range BoundarySlices(Id slab, int sweep) const;

  void SortBySlice(const std::vector<Index>& slice);

  std::vector<Index> unknown_;          // by slice, ascending in each
  std::vector<double> inverseDiagonal_; // of the unknowns in that order; 0: left alone
  std::vector<Id> sliceBegin_;          // slice k has unknown_[sliceBegin_[k] ..]
  std::vector<Id> slabBegin_;           // first slice of each slab, and the number of slices
  int sweeps_;
};

void CheckSlices(const SparseMatrix& A, const PatchOrder& order, int sweeps)
{
  if (sweeps < 1)
  {
    throw InvalidInput("A slice-decomposed smoother needs at least one sweep.");
  }
  if (A.rows != A.columns || static_cast<Index>(order.slice.size()) != A.rows)
  {
    throw InvalidInput("There are " + std::to_string(order.slice.size()) +
                       " slices of unknowns for " + std::to_string(A.rows) + " rows.");
  }
  for (Index row = 0; row < A.rows; ++row)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      if (std::abs(order.slice[row] - order.slice[A.column[k]]) > 1)
      {
        throw InvalidInput("Unknowns " + std::to_string(row) + " and " +
                           std::to_string(A.column[k]) +
                           " are coupled but not in adjacent slices.");
      }
    }
  }
}

SliceGaussSeidel::SliceGaussSeidel(const SparseMatrix& A, const PatchOrder& order, int sweeps)
  : sweeps_(sweeps)
{
  CheckSlices(A, order, sweeps);
  this->SortBySlice(order.slice);
  slabBegin_ = { 0 };
  for (const Index boundary : SlabBoundaries(order.slice, sweeps))
  {
    slabBegin_.push_back(boundary - order.slice[unknown_.front()]);
  }
  slabBegin_.push_back(static_cast<Id>(sliceBegin_.size()) - 1);
  for (const Index unknown : unknown_)
  {
    const double diagonal = A.Coefficient(unknown, unknown);
    inverseDiagonal_.push_back(IsUsableDiagonal(diagonal) ? 1.0 / diagonal : 0.0);
  }
}

void SliceGaussSeidel::SortBySlice(const std::vector<Index>& slice)
{
  unknown_.resize(slice.size());
  std::iota(unknown_.begin(), unknown_.end(), 0);
  std::stable_sort(
    unknown_.begin(), unknown_.end(), [&](Index i, Index j) { return slice[i] < slice[j]; });
  const Index lowest = unknown_.empty() ? 0 : slice[unknown_.front()];
  const Index highest = unknown_.empty() ? -1 : slice[unknown_.back()];
  sliceBegin_.assign(highest - lowest + 2, 0);
  for (const Index height : slice)
  {
    ++sliceBegin_[height - lowest];
  }
  ExclusiveScan(sliceBegin_);
}

/// Slices of a slab in one sweep. The lowest and the highest slab leave out nothing at the ends of
/// the surface.
SliceGaussSeidel::Range SliceGaussSeidel::SlabSlices(Id slab, int sweep) const
{
  const Id below = slab > 0 ? sweep : 0;
  const Id above = slab + 2 < static_cast<Id>(slabBegin_.size()) ? sweep + 1 : 0;
  return { slabBegin_[slab] + below, slabBegin_[slab + 1] - above };
}

SliceGaussSeidel::Range SliceGaussSeidel::BoundarySlices(Id slab, int sweep) const
{
  return { slabBegin_[slab] - sweep - 1, slabBegin_[slab] + sweep };
}

void SliceGaussSeidel::Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x,
  SweepDirection direction, int threads) const
{
  CheckSweep(A, static_cast<Id>(unknown_.size()), b, x);
  const RowView rows(A);
  const bool forward = direction == SweepDirection::Forward;
  const auto relax = [&](Id item, auto chunk)
  {
    const Index row = unknown_[item];
    const double scale = inverseDiagonal_[item];
    if (scale > 0.0)
    {
      chunk.Row(x.data(), row) +=
        scale * (chunk.Row(b.data(), row) - RowProduct(rows, row, x.data(), chunk));
    }
  };
  const auto relaxSlices = [&](const Range& range)
  {
    const Id begin = sliceBegin_[range.first];
    const Id end = sliceBegin_[range.last];
    ForEachChunk(x.cols(),
      [&](auto chunk)
      {
        for (Id i = begin; i < end; ++i)
        {
          relax(forward ? i : begin + end - 1 - i, chunk);
        }
      });
  };
  const Id slabs = static_cast<Id>(slabBegin_.size()) - 1;
  ParallelPhases(
    forward ? std::vector<Id>{ slabs, slabs - 1 } : std::vector<Id>{ slabs - 1, slabs },
    ThreadsFor(sweeps_ * A.NonZeros() * x.cols(), threads),
    [&](Id phase, Id k)
    {
      for (int step = 0; step < sweeps_; ++step)
      {
        const int sweep = forward ? step : sweeps_ - 1 - step;
        const bool isSlab = (phase == 0) == forward;
        relaxSlices(isSlab ? this->SlabSlices(k, sweep) : this->BoundarySlices(k + 1, sweep));
      }
    });
}

} // namespace

std::vector<Index> SlabBoundaries(const std::vector<Index>& slice, int sweeps)
{
  std::vector<Index> boundaries;
  if (slice.empty())
  {
    return boundaries;
  }
  const auto [lowest, highest] = std::minmax_element(slice.begin(), slice.end());
  std::vector<Id> before(*highest - *lowest + 2, 0); // number of unknowns below each slice
  for (const Index height : slice)
  {
    ++before[height - *lowest];
  }
  ExclusiveScan(before);
  const Id enough = (static_cast<Id>(slice.size()) + MostSlabs - 1) / MostSlabs;
  const Index slices = *highest - *lowest + 1;
  Index begin = 0;
  for (Index k = 2 * sweeps; k + 2 * sweeps <= slices; ++k)
  {
    if (k - begin >= 2 * sweeps && before[k] - before[begin] >= enough)
    {
      boundaries.push_back(*lowest + k);
      begin = k;
    }
  }
  return boundaries;
}

std::unique_ptr<Smoother> MakeSliceGaussSeidel(
  const SparseMatrix& A, const PatchOrder& order, int sweeps)
{
  return std::make_unique<SliceGaussSeidel>(A, order, sweeps);
}

} // namespace gridfem
