// Columns of a block of vectors, in single or double precision: stored, made, selected. Used by the
// block iteration.
#ifndef GridFEM_BlockVectors_h
#define GridFEM_BlockVectors_h

#include "Base/Array.h"
#include "Base/Parallel.h"
#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// Neighbouring columns of a block that is stored elsewhere, all of them or some.
template<class Real>
using Block = Eigen::Ref<Vectors<Real>>;
template<class Real>
using ConstBlock = Eigen::Ref<const Vectors<Real>>;

/// Room for a block whose width changes from step to step. Memory is kept: touching fresh pages
/// takes longer than the work on them.
template<class Real>
class BlockBuffer
{
public:
  using Map = Eigen::Map<Vectors<Real>, 0, Eigen::OuterStride<>>;

  /// Room for blocks of up to so many columns; their numbers are lost where it has to grow.
  void Reserve(Id rows, Id columns);

  /// As Reserve, but the columns that are shown keep their numbers.
  void Grow(Id rows, Id columns, int threads = 0);

  /// Shows the first columns, of which there is room for at least so many; numbers stay.
  void Show(Id columns) { columns_ = columns; }

  /// Shows these columns, which ascend, and loses the others.
  void Keep(const std::vector<Index>& columns, int threads = 0);

  /// The columns that are shown. Rows lie the capacity apart.
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

/// to = from, in the precision of `to`; of one shape.
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

/// Uniform in [-1, 1), the same on every platform.
MultiVector RandomColumns(Id rows, Id columns);

} // namespace gridfem

#endif
