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
  BlockBuffer() : block_(nullptr, 0, 0) {}

  /// Makes room for a block of this shape; its numbers are lost.
  void Reshape(Id rows, Id columns);

  Eigen::Map<MultiVector>& View() { return block_; }
  const Eigen::Map<MultiVector>& View() const { return block_; }
  Id Columns() const { return block_.cols(); }
  void Swap(BlockBuffer& other);

private:
  Eigen::VectorXd memory_;
  Eigen::Map<MultiVector> block_;
};

/// Makes room for a block of this shape, in large pages where it is large; its numbers are lost
/// where the shape changes.
void Reshape(MultiVector& X, Id rows, Id columns);

/// Keeps the first columns only. Needs no second block: rows move up, and the rest of the memory is
/// given back.
void KeepColumns(MultiVector& X, Id columns);

/// Uniform in [-1, 1), the same on every platform.
MultiVector RandomColumns(Id rows, Id columns);

/// The columns of X with these numbers, in this order, as `selected`.
void SelectColumns(
  const ConstBlock& X, const std::vector<Index>& columns, BlockBuffer& selected, int threads = 0);

/// xᵀ y for every pair of columns. Same bits for any number of threads.
Eigen::VectorXd ColumnDots(const ConstBlock& X, const ConstBlock& Y, int threads = 0);

} // namespace gridfem

#endif
