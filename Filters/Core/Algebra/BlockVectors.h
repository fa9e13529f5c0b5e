// Storage, copies and random values for blocks of vectors, in single or double precision. The block
// iteration uses them.
#ifndef GridFEM_BlockVectors_h
#define GridFEM_BlockVectors_h

#include "Base/Array.h"
#include "Base/Parallel.h"
#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// A view of adjacent columns of a block that is stored elsewhere: all of its columns or some.
template<class Real>
using Block = Eigen::Ref<Vectors<Real>>;
template<class Real>
using ConstBlock = Eigen::Ref<const Vectors<Real>>;

/// Storage for a block whose width changes from step to step. It keeps its memory, because touching
/// fresh pages takes longer than the work on them.
template<class Real>
class BlockBuffer
{
public:
  using Map = Eigen::Map<Vectors<Real>, 0, Eigen::OuterStride<>>;

  /// Makes room for blocks of up to `columns` columns. If the buffer has to grow, its numbers are
  /// lost.
  void Reserve(Id rows, Id columns);

  /// Makes room like Reserve, but the visible columns keep their numbers.
  void Grow(Id rows, Id columns, int threads = 0);

  /// Makes the first `columns` columns visible; there must be room for them. Numbers stay.
  void Show(Id columns) { columns_ = columns; }

  /// Makes only these columns visible, given in ascending order. The other columns are lost.
  void Keep(const std::vector<Index>& columns, int threads = 0);

  /// Returns the visible columns. The distance between two rows is the capacity.
  Map View() { return Map(memory_.data(), rows_, columns_, Eigen::OuterStride<>(capacity_)); }
  Eigen::Map<const Vectors<Real>, 0, Eigen::OuterStride<>> View() const
  {
    return { memory_.data(), rows_, columns_, Eigen::OuterStride<>(capacity_) };
  }
  Id Rows() const { return rows_; }
  Id Columns() const { return columns_; }

private:
  Array<Real> memory_;
  Id rows_ = 0;
  Id columns_ = 0;
  Id capacity_ = 0;
};

/// Copies `from` to `to`, converted to the precision of `to`. Both have the same shape.
template<class From, class To>
void CopyBlock(const From& from, To to, int threads)
{
  ParallelRanges(from.rows(), threads,
    [&](Id begin, Id end)
    {
      to.middleRows(begin, end - begin) =
        from.middleRows(begin, end - begin).template cast<typename To::Scalar>();
    });
}

/// Random numbers, uniform in [-1, 1), the same on every platform.
MultiVector RandomColumns(Id rows, Id columns);

} // namespace gridfem

#endif
