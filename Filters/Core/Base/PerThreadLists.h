// Lists of unknown length that the blocks of a parallel loop make, joined in the order of the
// blocks. Every thread appends to one array: many small ones would stay in its heap.
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

  /// fill(list) appends what the block makes to the list of its thread. For the body of
  /// ParallelBlocks; every block once.
  template<class Fill>
  void Make(Id block, int thread, Fill&& fill)
  {
    Array<T>& list = lists_[thread].items;
    const auto begin = static_cast<Id>(list.size());
    fill(list);
    blocks_[block] = { thread, begin, static_cast<Id>(list.size()) - begin };
  }

  /// Appends the lists of all blocks.
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

  /// Of one thread, which writes to it all the time.
  struct alignas(CacheLine) List
  {
    Array<T> items;
  };

  std::vector<List> lists_;
  std::vector<Block> blocks_;
};

/// Appends to `items` what fill(begin, end, list) appends to a list for consecutive ranges that
/// cover [0, count), in their order.
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
