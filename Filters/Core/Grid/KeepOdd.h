// Keeps what is paired with nothing.
#ifndef GridFEM_KeepOdd_h
#define GridFEM_KeepOdd_h

#include <algorithm>
#include <vector>

namespace gridfem
{

/// Sorts items. Keeps one copy of each item that occurs an odd number of times.
template<class Item>
void KeepOdd(std::vector<Item>& items)
{
  std::sort(items.begin(), items.end());
  std::size_t kept = 0;
  for (std::size_t first = 0, next = 0; first < items.size(); first = next)
  {
    const Item item = items[first];
    for (next = first + 1; next < items.size() && items[next] == item; ++next)
    {
    }
    if ((next - first) % 2 == 1)
    {
      items[kept++] = item;
    }
  }
  items.resize(kept);
}

} // namespace gridfem

#endif
