// How a sweep runs over the blocks of a PatchOrder: colour after colour, the blocks of one colour
// in parallel. Shared by the smoothers.
#ifndef GridFEM_BlockSweep_h
#define GridFEM_BlockSweep_h

#include "Errors.h"
#include "RowKernels.h"
#include "Smoother.h"

#include <string>

namespace gridfem
{

/// Items (patches or unknowns) in visiting order, cut into blocks and colours as in PatchOrder.
struct BlockRanges
{
  std::vector<Id> blockBegin;
  std::vector<Id> colourBegin;

  Id NumberOfColours() const { return std::max<Id>(0, Id(colourBegin.size()) - 1); }
  std::size_t Memory() const { return (blockBegin.size() + colourBegin.size()) * sizeof(Id); }
};

/// Calls relax(item, chunk) for every item and every chunk of `columns`, in the order of the
/// direction. @param work  multiplications of the whole sweep per column
template<class Relax>
void SweepBlocks(const BlockRanges& ranges, Id columns, SweepDirection direction, Id work,
  int threads, Relax&& relax)
{
  const bool forward = direction == SweepDirection::Forward;
  const Id colours = ranges.NumberOfColours();
  const int useful = ThreadsFor(work * columns, threads);
  for (Id step = 0; step < colours; ++step)
  {
    const Id colour = forward ? step : colours - 1 - step;
    const Id firstBlock = ranges.colourBegin[colour];
    ParallelBlocks(ranges.colourBegin[colour + 1] - firstBlock, useful,
      [&](Id k)
      {
        const Id begin = ranges.blockBegin[firstBlock + k];
        const Id end = ranges.blockBegin[firstBlock + k + 1];
        ForEachChunk(columns,
          [&](auto chunk)
          {
            for (Id i = begin; i < end; ++i)
            {
              relax(forward ? i : begin + end - 1 - i, chunk);
            }
          });
      });
  }
}

/// Diagonals that can be divided by, with room for the inverse of what they scale.
inline bool IsUsableDiagonal(double value)
{
  return value > 1e-200 && value < 1e200;
}

/// Throws InvalidInput when the order is not a partition into blocks and colours, or names unknowns
/// that the matrix does not have.
void CheckOrder(const SparseMatrix& A, const PatchOrder& order);

/// Throws InvalidInput when the shapes of a sweep do not fit.
void CheckSweep(const SparseMatrix& A, Id rows, const MultiVector& b, const MultiVector& x);

} // namespace gridfem

#endif
