#include "Base/RadixSort.h"

#include <utility>

namespace gridfem
{

namespace
{

/// Up to this many entries, sorting by comparison costs less than counting digits.
constexpr Id Few = 48;

/// Counters for more digit bits than this do not fit the first-level cache together with the
/// entries.
constexpr int MostDigitBits = 11;

/// Stable sort by digits, from the lowest digit up.
void SortByDigits(SortEntry* entries, Id count, int bits)
{
  const int passes = (bits + MostDigitBits - 1) / MostDigitBits;
  const int digitBits = (bits + passes - 1) / passes;
  const std::uint64_t mask = (std::uint64_t{ 1 } << digitBits) - 1;
  Array<SortEntry> buffer(count);
  std::vector<Id> place(mask + 1);
  SortEntry* from = entries;
  SortEntry* to = buffer.data();
  for (int pass = 0; pass < passes; ++pass)
  {
    const int shift = pass * digitBits;
    std::fill(place.begin(), place.end(), 0);
    for (Id k = 0; k < count; ++k)
    {
      ++place[(from[k].key >> shift) & mask];
    }
    ExclusiveScan(place);
    for (Id k = 0; k < count; ++k)
    {
      to[place[(from[k].key >> shift) & mask]++] = from[k];
    }
    std::swap(from, to);
  }
  if (from != entries)
  {
    std::copy_n(from, count, entries);
  }
}

} // namespace

void SortBuckets(Array<SortEntry>& entries, const std::vector<Id>& begin, int bits, int threads)
{
  if (bits == 0)
  {
    return;
  }
  ParallelBlocks(static_cast<Id>(begin.size()) - 1, threads,
    [&](Id bucket)
    {
      SortEntry* const first = entries.data() + begin[bucket];
      const Id count = begin[bucket + 1] - begin[bucket];
      if (count > Few)
      {
        SortByDigits(first, count, bits);
      }
      else
      {
        std::stable_sort(first, first + count,
          [](const SortEntry& a, const SortEntry& b) { return a.key < b.key; });
      }
    });
}

} // namespace gridfem
