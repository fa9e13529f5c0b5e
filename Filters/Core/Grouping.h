// Lists of items per group, from the group of every item: pieces of a patch, children of a parent.
#ifndef GridFEM_Grouping_h
#define GridFEM_Grouping_h

#include "Parallel.h"

#include <vector>

namespace gridfem
{

/// Items of group g are item[begin[g] .. begin[g + 1]), ascending.
struct Groups
{
  std::vector<Id> begin;
  std::vector<Id> item;
};

/// @param group  of every item, in [0, numberOfGroups)
/// Counting sort: cost O(items + groups).
inline Groups GroupItems(const std::vector<Id>& group, Id numberOfGroups)
{
  Groups groups{ std::vector<Id>(numberOfGroups + 1, 0), std::vector<Id>(group.size()) };
  for (const Id g : group)
  {
    ++groups.begin[g];
  }
  ExclusiveScan(groups.begin);
  std::vector<Id> next(groups.begin.begin(), groups.begin.end() - 1);
  for (Id item = 0; item < static_cast<Id>(group.size()); ++item)
  {
    groups.item[next[group[item]]++] = item;
  }
  return groups;
}

} // namespace gridfem

#endif
