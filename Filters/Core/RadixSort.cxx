#include "RadixSort.h"

#include "Parallel.h"

namespace gridfem
{

namespace
{

/// More digits than this do not fit the first cache beside the entries.
constexpr int MostDigitBits = 12;
constexpr Id RangeSize = Id{ 1 } << 17;

} // namespace

void RadixSort(Array<SortEntry>& entries, int bits, int threads)
{
  const int passes = (bits + MostDigitBits - 1) / MostDigitBits;
  const int digitBits = passes > 0 ? (bits + passes - 1) / passes : 0;
  const Id digits = Id{ 1 } << digitBits;
  const Id count = static_cast<Id>(entries.size());
  const Id ranges = (count + RangeSize - 1) / RangeSize;
  Array<SortEntry> sorted(entries.size());
  std::vector<Id> begin(ranges * digits);
  for (int shift = 0; shift < bits; shift += digitBits)
  {
    const auto digit = [shift, digits](std::uint64_t key)
    { return static_cast<Id>(key >> shift) & (digits - 1); };
    std::fill(begin.begin(), begin.end(), 0);
    ParallelBlocks(ranges, threads,
      [&](Id range)
      {
        for (Id k = range * RangeSize; k < std::min(count, (range + 1) * RangeSize); ++k)
        {
          ++begin[range * digits + digit(entries[k].key)];
        }
      });
    Id total = 0;
    for (Id d = 0; d < digits; ++d)
    {
      for (Id range = 0; range < ranges; ++range)
      {
        const Id next = total + begin[range * digits + d];
        begin[range * digits + d] = total;
        total = next;
      }
    }
    ParallelBlocks(ranges, threads,
      [&](Id range)
      {
        for (Id k = range * RangeSize; k < std::min(count, (range + 1) * RangeSize); ++k)
        {
          sorted[begin[range * digits + digit(entries[k].key)]++] = entries[k];
        }
      });
    entries.swap(sorted);
  }
}

} // namespace gridfem
