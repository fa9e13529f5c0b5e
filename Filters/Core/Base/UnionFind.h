// Disjoint sets that several threads may unite at the same time. The root of a set is its lowest
// member. Results therefore depend neither on the order of unions nor on the number of threads.
#ifndef GridFEM_UnionFind_h
#define GridFEM_UnionFind_h

#include "Base/Array.h"
#include "Base/Parallel.h"

#include <atomic>
#include <vector>

namespace gridfem
{

class UnionFind
{
public:
  explicit UnionFind(Id count, int threads = 1) : parent_(count)
  {
    ParallelRanges(count, threads,
      [&](Id begin, Id end)
      {
        for (Id x = begin; x < end; ++x)
        {
          parent_[x].store(static_cast<Index>(x), std::memory_order_relaxed);
        }
      });
  }

  /// Lowest member of the set that contains x. While other threads unite sets, it is the lowest
  /// member found so far.
  Index Find(Index x)
  {
    Index above = this->Parent(x);
    while (above != x)
    {
      // Shorten the path. A parent is only ever replaced by a lower member of the same set, so a
      // late store does no harm.
      const Index next = this->Parent(above);
      parent_[x].store(next, std::memory_order_relaxed);
      x = next;
      above = this->Parent(x);
    }
    return x;
  }

  void Unite(Index a, Index b)
  {
    while ((a = this->Find(a)) != (b = this->Find(b)))
    {
      Index high = std::max(a, b);
      if (parent_[high].compare_exchange_strong(high, std::min(a, b), std::memory_order_relaxed))
      {
        return;
      }
    }
  }

  bool IsRoot(Index x) const { return this->Parent(x) == x; }

  Id Size() const { return static_cast<Id>(parent_.size()); }

private:
  Index Parent(Index x) const { return parent_[x].load(std::memory_order_relaxed); }

  Array<std::atomic<Index>> parent_;
};

/// Numbers the sets 0, 1, ... in the order of their lowest members and returns the set number of
/// each member. `count` receives the number of sets.
inline Array<Index> NumberSets(UnionFind& sets, Index& count, int threads = 1)
{
  Array<Index> number(sets.Size());
  std::vector<Index> first((sets.Size() + DefaultBlockSize - 1) / DefaultBlockSize + 1, 0);
  const auto forMembers = [&](const auto& visit)
  {
    ParallelRanges(sets.Size(), threads,
      [&](Id begin, Id end)
      {
        for (auto x = static_cast<Index>(begin); x < end; ++x)
        {
          visit(x, first[begin / DefaultBlockSize]);
        }
      });
  };
  forMembers([&](Index x, Index& roots) { roots += sets.IsRoot(x) ? 1 : 0; });
  count = ExclusiveScan(first);
  forMembers(
    [&](Index x, Index& next)
    {
      if (sets.IsRoot(x))
      {
        number[x] = next++;
      }
    });
  forMembers(
    [&](Index x, Index&)
    {
      if (!sets.IsRoot(x))
      {
        number[x] = number[sets.Find(x)];
      }
    });
  return number;
}

} // namespace gridfem

#endif
