// Runs a sweep over the blocks of a PatchOrder, for all smoothers: color after color, with the
// blocks of one color in parallel. One team of threads does all colors. Waking a team for each
// would take longer than a color of a coarse level.
#ifndef GridFEM_BlockSweep_h
#define GridFEM_BlockSweep_h

#include "Algebra/RowKernels.h"
#include "Base/Errors.h"
#include "Multigrid/Smoother.h"

#include <atomic>
#include <thread>
#include <vector>

namespace gridfem
{

/// Items (patches or unknowns) in visiting order, cut into blocks and colors as in PatchOrder.
struct BlockRanges
{
  std::vector<Id> blockBegin;
  std::vector<Id> colorBegin;

  Id NumberOfColors() const { return std::max<Id>(0, Id(colorBegin.size()) - 1); }
  std::size_t Memory() const { return (blockBegin.size() + colorBegin.size()) * sizeof(Id); }
};

/// Runs body(phase, item) for all items of phase 0, then of phase 1, and so on. Items of one phase
/// run in any order, in parallel. A thread that has to wait for a phase polls for a while and then
/// yields. The body must not throw.
/// @param count  number of items of each phase
template<class Body>
void ParallelPhases(const std::vector<Id>& count, int threads, Body&& body)
{
  constexpr int LooksBeforeYield = 4096;
  const Id phases = static_cast<Id>(count.size());
  std::vector<std::atomic<Id>> next(phases);
  std::vector<std::atomic<Id>> done(phases);
#pragma omp parallel num_threads(NumberOfThreads(threads))
  {
    for (Id phase = 0; phase < phases; ++phase)
    {
      for (Id item = next[phase]++; item < count[phase]; item = next[phase]++)
      {
        body(phase, item);
        ++done[phase];
      }
      for (int look = 0; done[phase] < count[phase]; ++look)
      {
        if (look >= LooksBeforeYield)
        {
          std::this_thread::yield();
        }
      }
    }
  }
}

/// Calls body(block) for every block, color after color in the order of the direction.
template<class Body>
void VisitBlocks(const BlockRanges& ranges, SweepDirection direction, int threads, Body&& body)
{
  const bool forward = direction == SweepDirection::Forward;
  const Id colors = ranges.NumberOfColors();
  const auto colorOf = [&](Id step) { return forward ? step : colors - 1 - step; };
  std::vector<Id> blocks(colors);
  for (Id step = 0; step < colors; ++step)
  {
    blocks[step] = ranges.colorBegin[colorOf(step) + 1] - ranges.colorBegin[colorOf(step)];
  }
  ParallelPhases(
    blocks, threads, [&](Id step, Id k) { body(ranges.colorBegin[colorOf(step)] + k); });
}

/// Calls relax(item, chunk) for every item and every chunk of `columns`, in the order of the
/// direction.
/// @param work  multiplications of the whole sweep per column
template<class Real = double, class Relax>
void SweepBlocks(const BlockRanges& ranges, Id columns, SweepDirection direction, Id work,
  int threads, Relax&& relax)
{
  const bool forward = direction == SweepDirection::Forward;
  VisitBlocks(ranges, direction, ThreadsFor(work * columns, threads),
    [&](Id block)
    {
      const Id begin = ranges.blockBegin[block];
      const Id end = ranges.blockBegin[block + 1];
      ForEachChunk<Real>(columns,
        [&](auto chunk)
        {
          for (Id i = begin; i < end; ++i)
          {
            relax(forward ? i : begin + end - 1 - i, chunk);
          }
        });
    });
}

/// Whether a diagonal can be divided by, with room for the inverse of the numbers it scales.
inline bool IsUsableDiagonal(double value)
{
  return value > 1e-200 && value < 1e200;
}

/// Throws InvalidInput when the order is not a partition into blocks and colors, or names unknowns
/// that the matrix does not have.
void CheckOrder(const SparseMatrix& A, const PatchOrder& order, int threads = 1);

/// Throws InvalidInput when the shapes of a sweep do not fit.
template<class Real>
void CheckSweep(
  const BasicSparseMatrix<Real>& A, Id rows, const Vectors<Real>& b, const Vectors<Real>& x);

} // namespace gridfem

#endif
