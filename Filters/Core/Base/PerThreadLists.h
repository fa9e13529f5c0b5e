// Collects lists of unknown length made by the blocks of a parallel loop and joins them in the
// order of the blocks. Each thread appends to one array, because many small arrays would stay in
// its heap.
#ifndef GridFEM_PerThreadLists_h
#define GridFEM_PerThreadLists_h

#include "Base/Array.h"
#include "Base/Parallel.h"

#include <algorithm>
#include <vector>

namespace gridfem
{

template<class T>
class PerThreadLists
{
public:
  PerThreadLists(Id blocks, int threads) : lists_(NumberOfThreads(threads)), blocks_(blocks) {}

  /// Calls fill(list), which appends the block's items to the list of its thread. To be called once
  /// per block, from the body of ParallelBlocks.
  template<class Fill>
  void Make(Id block, int thread, Fill&& fill)
  {
    Array<T>& list = lists_[thread].items;
    const auto begin = static_cast<Id>(list.size());
    fill(list);
    blocks_[block] = { thread, begin, static_cast<Id>(list.size()) - begin };
  }

  /// Appends the lists of all blocks to `items`.
  void AppendTo(Array<T>& items, int threads) const
  {
    std::vector<Id> first(blocks_.size());
    std::transform(
      blocks_.begin(), blocks_.end(), first.begin(), [](const Block& block) { return block.size; });
    const auto before = static_cast<Id>(items.size());
    items.resize(before + ExclusiveScan(first));
    ParallelBlocks(static_cast<Id>(blocks_.size()), threads,
      [&](Id b)
      {
        const Block& block = blocks_[b];
        std::copy_n(lists_[block.thread].items.begin() + block.begin, block.size,
          items.begin() + before + first[b]);
      });
  }

private:
  struct Block
  {
    int thread = 0;
    Id begin = 0;
    Id size = 0;
  };

  /// The list of one thread. Threads write to their lists all the time; the alignment keeps two
  /// lists from sharing a cache line.
  struct alignas(CacheLine) List
  {
    Array<T> items;
  };

  std::vector<List> lists_;
  std::vector<Block> blocks_;
};

/// Appends items made in parallel, in order. fill(begin, end, list) appends the items of one range;
/// consecutive ranges cover [0, count).
template<class T, class Fill>
void AppendRanges(
  Id count, int threads, Array<T>& items, Fill&& fill, const Progress& progress = {})
{
  const Id blocks = (count + DefaultBlockSize - 1) / DefaultBlockSize;
  PerThreadLists<T> lists(blocks, threads);
  ParallelBlocks(
    blocks, threads,
    [&](Id block, int thread)
    {
      lists.Make(block, thread,
        [&](Array<T>& list)
        { fill(block * DefaultBlockSize, std::min(count, (block + 1) * DefaultBlockSize), list); });
    },
    progress);
  lists.AppendTo(items, threads);
}

} // namespace gridfem

#endif
