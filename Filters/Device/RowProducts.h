// A sparse matrix on a device, in slices of rows of about the same length, so that neighboring
// threads read neighboring numbers (SELL-C-sigma; Kreutzer et al., SIAM J. Sci. Comput. 36, 2014).
#ifndef GridFEM_Device_RowProducts_h
#define GridFEM_Device_RowProducts_h

#include "Memory.h"
#include "Multigrid/Device.h"

#include <algorithm>

namespace gridfem::device
{

constexpr Index SliceRows = 32;    // rows of a slice: threads that run together
constexpr Index WindowRows = 1024; // rows that are sorted by length

/// The places of the entries of rows, as loops see them. Entry k of a slot is at First(slot) +
/// SliceRows k.
struct Places
{
  Index slots;
  const Index* rowOf;  // the row of each slot; -1: none
  const Index* slotOf; // the slot of each row
  const Index* length; // of the row of each slot
  const Id* begin;     // of each slice
  const Index* column; // of each entry

  GRIDFEM_ON_DEVICE Id First(Index slot) const
  {
    return begin[slot / SliceRows] + slot % SliceRows;
  }

  /// Calls body(place, column) for every entry of a row.
  template<class Body>
  GRIDFEM_ON_DEVICE void ForEachEntry(Index row, Body&& body) const
  {
    const Index slot = slotOf[row];
    const Id first = First(slot);
    for (Index k = 0; k < length[slot]; ++k)
    {
      body(first + Id(k) * SliceRows, column[first + Id(k) * SliceRows]);
    }
  }
};

/// Moves the entries of compressed rows to their places.
template<class T>
struct PlaceEntries
{
  Places places;
  const Id* rowBegin;
  const T* from;
  T* to;

  GRIDFEM_ON_DEVICE void operator()(Index slot) const
  {
    const Index row = places.rowOf[slot];
    if (row >= 0)
    {
      const Id first = places.First(slot);
      for (Index k = 0; k < places.length[slot]; ++k)
      {
        to[first + Id(k) * SliceRows] = from[rowBegin[row] + k];
      }
    }
  }
};

/// The pattern of a matrix on the device. Matrices share it if they can.
class Pattern
{
public:
  Pattern(Queue& queue, const DeviceMatrix& A) : rows_(A.rows), entries_(A.rowBegin[A.rows])
  {
    const Index slices = (rows_ + SliceRows - 1) / SliceRows;
    const auto lengthOf = [&](Index row)
    { return static_cast<Index>(A.rowBegin[row + 1] - A.rowBegin[row]); };
    std::vector<Index> rowOf(std::size_t(slices) * SliceRows, -1);
    std::vector<Index> slotOf(rows_);
    std::vector<Index> length(rowOf.size(), 0);
    std::vector<Id> begin(std::size_t(slices) + 1, 0);
    std::vector<Index> next;
    for (Index first = 0; first < rows_; first += WindowRows)
    {
      SortWindow(first, std::min(rows_, first + WindowRows), lengthOf, next, rowOf.data());
    }
    for (Index slot = 0; slot < rows_; ++slot)
    {
      slotOf[rowOf[slot]] = slot;
      length[slot] = lengthOf(rowOf[slot]);
    }
    for (Index slice = 0; slice < slices; ++slice)
    {
      begin[slice + 1] = begin[slice] + Id(SliceRows) * length[std::size_t(slice) * SliceRows];
    }
    rowOf_ = Copy(queue, rowOf);
    slotOf_ = Copy(queue, slotOf);
    length_ = Copy(queue, length);
    begin_ = Copy(queue, begin);
    rowBegin_ = Copy(queue, A.rowBegin, std::size_t(rows_) + 1);
    column_ = Buffer<Index>(begin.back());
    this->Place(queue, A.column, column_.Data());
  }

  Index Rows() const { return rows_; }
  Index Slots() const { return static_cast<Index>(rowOf_.Size()); }
  std::size_t Size() const { return column_.Size(); } // of arrays of values

  Places AsPlaces() const
  {
    return { Slots(), rowOf_.Data(), slotOf_.Data(), length_.Data(), begin_.Data(),
      column_.Data() };
  }

  /// Copies entries from compressed rows of the host to their places.
  template<class T>
  void Place(Queue& queue, const T* from, T* to) const
  {
    const Buffer<T> inRows = Copy(queue, from, entries_);
    queue.ForEach(
      this->Slots(), PlaceEntries<T>{ this->AsPlaces(), rowBegin_.Data(), inRows.Data(), to });
    queue.Wait();
  }

  std::size_t Bytes() const
  {
    return rowOf_.Bytes() + slotOf_.Bytes() + length_.Bytes() + begin_.Bytes() + rowBegin_.Bytes() +
           column_.Bytes();
  }

private:
  /// Sorts rows by length, longest first, in a stable counting sort.
  template<class Length>
  static void SortWindow(
    Index first, Index last, const Length& lengthOf, std::vector<Index>& next, Index* rowOf)
  {
    Index longest = 0;
    for (Index row = first; row < last; ++row)
    {
      longest = std::max(longest, lengthOf(row));
    }
    next.assign(std::size_t(longest) + 2, 0);
    for (Index row = first; row < last; ++row)
    {
      ++next[longest - lengthOf(row) + 1];
    }
    next[0] = first;
    for (std::size_t k = 1; k < next.size(); ++k)
    {
      next[k] += next[k - 1];
    }
    for (Index row = first; row < last; ++row)
    {
      rowOf[next[longest - lengthOf(row)]++] = row;
    }
  }

  Index rows_;
  Id entries_;
  Buffer<Index> rowOf_;
  Buffer<Index> slotOf_;
  Buffer<Index> length_;
  Buffer<Id> begin_;
  Buffer<Id> rowBegin_;
  Buffer<Index> column_;
};

/// Computes rows of A x for blocks of vectors. Copied into a loop by value.
struct RowProducts
{
  Places places;
  const float* value;
  Index columns; // of the block

  /// Calls body(place of the result in a block, its value).
  template<class Body>
  GRIDFEM_ON_DEVICE void operator()(Index item, const float* x, Body&& body) const
  {
    const Index slot = item / columns;
    const Index own = item - slot * columns;
    const Index row = places.rowOf[slot];
    if (row < 0)
    {
      return;
    }
    const Id first = places.First(slot);
    const Id end = first + Id(places.length[slot]) * SliceRows;
    float sum = 0.0f;
    GRIDFEM_UNROLL
    for (Id k = first; k < end; k += SliceRows)
    {
      sum += value[k] * x[Id(places.column[k]) * columns + own];
    }
    body(Id(row) * columns + own, sum);
  }
};

/// A matrix in single precision.
class Matrix
{
public:
  Matrix() = default;
  explicit Matrix(std::shared_ptr<const Pattern> pattern)
    : pattern_(std::move(pattern)), value_(pattern_->Size())
  {
  }

  const std::shared_ptr<const Pattern>& SharedPattern() const { return pattern_; }
  Places AsPlaces() const { return pattern_->AsPlaces(); }
  float* Values() const { return value_.Data(); }

  /// How many items a loop over the products has.
  Index Items(Index columns) const { return pattern_->Slots() * columns; }
  RowProducts Products(Index columns) const
  {
    return { pattern_->AsPlaces(), value_.Data(), columns };
  }

  std::size_t Bytes() const { return value_.Bytes(); }

private:
  std::shared_ptr<const Pattern> pattern_;
  Buffer<float> value_;
};

} // namespace gridfem::device

#endif
