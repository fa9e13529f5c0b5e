// Lists of items per group, from the group of every item: pieces of a patch, children of a parent.
#ifndef GridFEM_Grouping_h
#define GridFEM_Grouping_h

#include "Base/Array.h"
#include "Base/Parallel.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gridfem
{

/// Turns the number of items per range and group, counts[range * groups + group], into the places
/// where they begin: group after group, in each range after range. `begin`, one longer than there
/// are groups, gets where each group begins.
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

/// Items of group g are item[begin[g] .. begin[g + 1]), ascending.
struct Groups
{
  Array<Index> begin;
  Array<Index> item;
};

/// Fewer are sorted before a sleeping thread has begun.
constexpr Id ItemsPerRange = 16 * DefaultBlockSize;

/// Counting sort, ranges of items in parallel. Cost O(items + groups).
/// @param group  of every one of `items` items, in [0, numberOfGroups)
inline Groups GroupItems(const Index* group, Id items, Id numberOfGroups, int threads = 1)
{
  // Each range has a counter per group: no more of them than four times the items.
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
        // Neighbours often are of one group: run by run, as each has to wait for the one before.
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
