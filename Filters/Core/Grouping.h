// Lists of items per group, from the group of every item: pieces of a patch, children of a parent.
#ifndef GridFEM_Grouping_h
#define GridFEM_Grouping_h

#include "Array.h"
#include "Parallel.h"

#include <algorithm>
#include <utility>

namespace gridfem
{

/// Items of group g are item[begin[g] .. begin[g + 1]), ascending.
struct Groups
{
  Array<Index> begin;
  Array<Index> item;
};

/// Counting sort, ranges of items in parallel. Cost O(items + groups).
/// @param group  of every one of `items` items, in [0, numberOfGroups)
inline Groups GroupItems(const Index* group, Id items, Id numberOfGroups, int threads = 1)
{
  // Each range has a counter per group: no more of them than four times the items.
  const Id ranges = std::clamp<Id>(4 * items / (numberOfGroups + 1), 1, NumberOfThreads(threads));
  Array<Index> next(ranges * numberOfGroups);
  const auto forItems = [&](const auto& visit)
  {
    ParallelBlocks(ranges, threads,
      [&](Id range)
      {
        Index* const ofGroup = next.data() + range * numberOfGroups;
        const auto end = static_cast<Index>((range + 1) * items / ranges);
        for (auto item = static_cast<Index>(range * items / ranges); item < end; ++item)
        {
          visit(ofGroup[group[item]], item);
        }
      });
  };
  ParallelBlocks(ranges, threads,
    [&](Id range)
    { std::fill_n(next.begin() + range * numberOfGroups, numberOfGroups, Index{ 0 }); });
  forItems([](Index& count, Index) { ++count; });
  Groups groups{ Array<Index>(numberOfGroups + 1), Array<Index>(items) };
  Index total = 0;
  for (Id g = 0; g < numberOfGroups; ++g)
  {
    groups.begin[g] = total;
    for (Id range = 0; range < ranges; ++range)
    {
      total += std::exchange(next[range * numberOfGroups + g], total);
    }
  }
  groups.begin[numberOfGroups] = total;
  forItems([&groups](Index& place, Index item) { groups.item[place++] = item; });
  return groups;
}

inline Groups GroupItems(const Array<Index>& group, Id numberOfGroups, int threads = 1)
{
  return GroupItems(group.data(), static_cast<Id>(group.size()), numberOfGroups, threads);
}

} // namespace gridfem

#endif
