// Stable sort of items by integer keys. It distributes the items into buckets by the leading digit,
// then sorts each bucket on its own within the cache.
#ifndef GridFEM_RadixSort_h
#define GridFEM_RadixSort_h

#include "Base/Grouping.h"

#include <algorithm>
#include <vector>

namespace gridfem
{

struct SortEntry
{
  std::uint64_t key;
  Id item;
};

/// Sorts every bucket, entries[begin[b] .. begin[b + 1]), by the lowest `bits` bits of the keys.
void SortBuckets(Array<SortEntry>& entries, const std::vector<Id>& begin, int bits, int threads);

/// Returns the entries in ascending order of their keys. Entries with equal keys keep the order of
/// their sources. The result is the same for any number of threads. Cost O(n bits / 11).
/// @param sources  number of sources of entries, visited in parallel in ranges of at least
///   `smallestRange`
/// @param bits     number of bits of the keys, 1..64
/// @param visit    visit(begin, end, add) calls add(key, item) for every entry of sources [begin,
///   end), in their order. It is called twice for each range
template<class Visit>
Array<SortEntry> SortByKey(
  Id sources, int bits, int threads, Visit&& visit, Id smallestRange = Id{ 1 } << 14)
{
  constexpr int MostBucketBits = 12;
  constexpr Id MostRanges = 64;
  const int rest = std::max(0, bits - MostBucketBits);
  const Id buckets = Id{ 1 } << (bits - rest);
  const Id size = std::max(smallestRange, (sources + MostRanges - 1) / MostRanges);
  const Id ranges = (sources + size - 1) / size;
  std::vector<Id> next(ranges * buckets, 0);
  const auto forRanges = [&](const auto& body)
  {
    ParallelBlocks(ranges, threads,
      [&](Id range)
      {
        Id* const ofBucket = next.data() + range * buckets;
        visit(range * size, std::min(sources, (range + 1) * size),
          [&](std::uint64_t key, Id item) { body(key, item, ofBucket[key >> rest]); });
      });
  };
  forRanges([](std::uint64_t, Id, Id& count) { ++count; });
  std::vector<Id> begin(buckets + 1);
  ScanGroups(next, ranges, begin);
  Array<SortEntry> entries(begin.back());
  forRanges([&](std::uint64_t key, Id item, Id& place) { entries[place++] = { key, item }; });
  SortBuckets(entries, begin, rest, threads);
  return entries;
}

} // namespace gridfem

#endif
