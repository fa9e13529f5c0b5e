// Lists the items of each group, given the group of each item: pieces of a patch, children of a
// parent.
#ifndef GridFEM_Grouping_h
#define GridFEM_Grouping_h

#include "Base/Array.h"
#include "Base/Parallel.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gridfem
{

/// Turns counts[range * groups + group], the number of items per range and group, into the position
/// of the first such item. The order is group by group, and range by range within a group. `begin`
/// has one entry more than there are groups and receives the start of each group.
template<class Counts, class Begins>
void ScanGroups(Counts& counts, Id ranges, Begins& begin)
{
  const Id groups = static_cast<Id>(begin.size()) - 1;
  typename Begins::value_type total = 0;
  for (Id group = 0; group < groups; ++group)
  {
    begin[group] = total;
    for (Id range = 0; range < ranges; ++range)
    {
      total += std::exchange(counts[range * groups + group], total);
    }
  }
  begin[groups] = total;
}

/// The items of group g are item[begin[g] .. begin[g + 1]), in ascending order.
struct Groups
{
  Array<Index> begin;
  Array<Index> item;
};

/// Fewer items than this are sorted faster than a sleeping thread wakes.
constexpr Id ItemsPerRange = 16 * DefaultBlockSize;

/// Groups items by a counting sort. Ranges of items are processed in parallel. Cost
/// O(items + groups).
/// @param group  the group of each of the `items` items, in [0, numberOfGroups)
inline Groups GroupItems(const Index* group, Id items, Id numberOfGroups, int threads = 1)
{
  // Each range has one counter per group. All counters together are at most four times the items.
  const Id most = std::min(4 * items / (numberOfGroups + 1), items / ItemsPerRange);
  const Id ranges = std::clamp<Id>(most, 1, NumberOfThreads(threads));
  Array<Index> next(ranges * numberOfGroups);
  const auto forItems = [&](const auto& visit)
  {
    ParallelBlocks(ranges, threads,
      [&](Id range)
      {
        Index* const ofGroup = next.data() + range * numberOfGroups;
        const auto end = static_cast<Index>((range + 1) * items / ranges);
        // Neighboring items often share a group. Each increment of a counter waits for the one
        // before, so a whole run of equal groups is counted at once.
        for (auto item = static_cast<Index>(range * items / ranges); item < end;)
        {
          const Index first = item;
          while (++item < end && group[item] == group[first])
          {
          }
          visit(ofGroup[group[first]], first, item);
        }
      });
  };
  ParallelBlocks(ranges, threads,
    [&](Id range)
    { std::fill_n(next.begin() + range * numberOfGroups, numberOfGroups, Index{ 0 }); });
  forItems([](Index& count, Index first, Index last) { count += last - first; });
  Groups groups{ Array<Index>(numberOfGroups + 1), Array<Index>(items) };
  ScanGroups(next, ranges, groups.begin);
  forItems(
    [&groups](Index& place, Index first, Index last)
    {
      std::iota(groups.item.begin() + place, groups.item.begin() + place + (last - first), first);
      place += last - first;
    });
  return groups;
}

inline Groups GroupItems(const Array<Index>& group, Id numberOfGroups, int threads = 1)
{
  return GroupItems(group.data(), static_cast<Id>(group.size()), numberOfGroups, threads);
}

} // namespace gridfem

#endif
