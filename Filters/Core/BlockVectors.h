// Columns of a block of vectors: stored, made, selected, multiplied. Used by the block iteration.
#ifndef GridFEM_BlockVectors_h
#define GridFEM_BlockVectors_h

#include "Types.h"

#include <vector>

namespace gridfem
{

/// Neighbouring columns of a block that is stored elsewhere, all of them or some.
using Block = Eigen::Ref<MultiVector>;
using ConstBlock = Eigen::Ref<const MultiVector>;

/// Room for a block whose width changes from step to step. Memory is kept: touching fresh pages
/// takes longer than the work on them.
class BlockBuffer
{
public:
  using Map = Eigen::Map<MultiVector, 0, Eigen::OuterStride<>>;

  BlockBuffer() : block_(nullptr, 0, 0, Eigen::OuterStride<>(0)) {}

  /// Room for blocks of up to so many columns; their numbers are lost where it has to grow.
  void Reserve(Id rows, Id columns);

  /// Shows the first columns, of which there is room for at least so many; numbers stay.
  void Show(Id columns);

  Map& View() { return block_; }
  const Map& View() const { return block_; }
  Id Columns() const { return block_.cols(); }

private:
  Eigen::VectorXd memory_;
  Map block_; // rows lie the capacity apart
};

/// Makes room for a block of this shape, in large pages where it is large; its numbers are lost
/// where the shape changes.
void Reshape(MultiVector& X, Id rows, Id columns);

/// Keeps the first columns only. Needs no second block: rows move up, and the rest of the memory is
/// given back.
void KeepColumns(MultiVector& X, Id columns);

/// Uniform in [-1, 1), the same on every platform.
MultiVector RandomColumns(Id rows, Id columns);

/// selected = the columns of X with these numbers, in this order. They may be the first columns of
/// X itself when the numbers ascend.
void SelectColumns(
  const ConstBlock& X, const std::vector<Index>& columns, Block selected, int threads = 0);

/// xᵀ y for every pair of columns. Same bits for any number of threads.
Eigen::VectorXd ColumnDots(const ConstBlock& X, const ConstBlock& Y, int threads = 0);

} // namespace gridfem

#endif
