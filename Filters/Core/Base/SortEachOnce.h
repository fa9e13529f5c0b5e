// Turns a list into a set.
#ifndef GridFEM_SortEachOnce_h
#define GridFEM_SortEachOnce_h

#include <algorithm>

namespace gridfem
{

/// Sorts a list, ascending, and keeps each item once.
template<class List>
void SortEachOnce(List& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

} // namespace gridfem

#endif
