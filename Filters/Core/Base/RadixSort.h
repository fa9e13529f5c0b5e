// Stable sorting of items by integer keys: into buckets by the first digit, then every bucket by
// itself in the cache.
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

/// Sorts every bucket, entries[begin[b] .. begin[b + 1]), by the lowest `bits` bits.
void SortBuckets(Array<SortEntry>& entries, const std::vector<Id>& begin, int bits, int threads);

/// Entries ascending by key; equal keys in the order of their sources. The same for any number of
/// threads. Cost O(n bits / 11).
/// @param sources  what entries come from, in parallel ranges of at least `smallestRange`
/// @param bits     of the keys, 1..64
/// @param visit    visit(begin, end, add) calls add(key, item) for every entry of some sources, in
///                 their order; it is called twice for each
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
