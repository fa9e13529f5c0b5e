#include "RadixSort.h"

#include "Parallel.h"

namespace gridfem
{

namespace
{

constexpr int DigitBits = 11;
constexpr Id Digits = Id{ 1 } << DigitBits;
constexpr Id RangeSize = Id{ 1 } << 17;

} // namespace

void RadixSort(std::vector<SortEntry>& entries, int bits, int threads)
{
  const Id count = static_cast<Id>(entries.size());
  const Id ranges = (count + RangeSize - 1) / RangeSize;
  std::vector<SortEntry> sorted(entries.size());
  std::vector<Id> begin(ranges * Digits);
  for (int shift = 0; shift < bits; shift += DigitBits)
  {
    const auto digit = [shift](std::uint64_t key)
    { return static_cast<Id>(key >> shift) & (Digits - 1); };
    std::fill(begin.begin(), begin.end(), 0);
    ParallelBlocks(ranges, threads,
      [&](Id range)
      {
        for (Id k = range * RangeSize; k < std::min(count, (range + 1) * RangeSize); ++k)
        {
          ++begin[range * Digits + digit(entries[k].key)];
        }
      });
    Id total = 0;
    for (Id d = 0; d < Digits; ++d)
    {
      for (Id range = 0; range < ranges; ++range)
      {
        const Id next = total + begin[range * Digits + d];
        begin[range * Digits + d] = total;
        total = next;
      }
    }
    ParallelBlocks(ranges, threads,
      [&](Id range)
      {
        for (Id k = range * RangeSize; k < std::min(count, (range + 1) * RangeSize); ++k)
        {
          sorted[begin[range * Digits + digit(entries[k].key)]++] = entries[k];
        }
      });
    entries.swap(sorted);
  }
}

} // namespace gridfem
