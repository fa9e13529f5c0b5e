// Lists of items per group, from the group of every item: pieces of a patch, children of a parent.
#ifndef GridFEM_Grouping_h
#define GridFEM_Grouping_h

#include "Array.h"
#include "Parallel.h"

#include <vector>

namespace gridfem
{

/// Items of group g are item[begin[g] .. begin[g + 1]), ascending.
struct Groups
{
  Array<Index> begin;
  Array<Index> item;
};

/// Counting sort. Each thread reads all items and serves a range of groups: with the few threads
/// that memory can feed, reading is the smaller part. Cost O(items + groups / threads).
/// @param group  of every one of `items` items, in [0, numberOfGroups)
inline Groups GroupItems(const Index* group, Id items, Id numberOfGroups, int threads = 1)
{
  Groups groups{ Array<Index>(numberOfGroups + 1, 0), Array<Index>(items) };
  const Id ranges = NumberOfThreads(threads);
  const auto forItems = [&](const auto& visit)
  {
    ParallelBlocks(ranges, threads,
      [&](Id range)
      {
        const Id low = range * numberOfGroups / ranges;
        const Id high = (range + 1) * numberOfGroups / ranges;
        for (Index item = 0; item < items; ++item)
        {
          if (group[item] >= low && group[item] < high)
          {
            visit(group[item], item);
          }
        }
      });
  };
  forItems([&](Index g, Index) { ++groups.begin[g]; });
  ExclusiveScan(groups.begin);
  Array<Index> next(groups.begin.begin(), groups.begin.end() - 1);
  forItems([&](Index g, Index item) { groups.item[next[g]++] = item; });
  return groups;
}

inline Groups GroupItems(const Array<Index>& group, Id numberOfGroups, int threads = 1)
{
  return GroupItems(group.data(), static_cast<Id>(group.size()), numberOfGroups, threads);
}

} // namespace gridfem

#endif
