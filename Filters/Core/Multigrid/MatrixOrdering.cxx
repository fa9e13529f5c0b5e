#include "Multigrid/MatrixOrdering.h"

#include "Base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gridfem
{
namespace
{

/// Unknowns of a block: small enough for many blocks per thread, large enough that few unknowns are
/// at a border.
constexpr Index UnknownsPerBlock = 512;

/// Weight of a coupling with an unknown that is already in another group. Groups overlap where
/// couplings are strong, but not everywhere. Half as many groups need the same number of
/// iterations.
constexpr double WeightOfGrouped = 0.7;

/// The unknowns of one block.
struct Range
{
  Index begin;
  Index end;
  bool Contains(Index i) const { return begin <= i && i < end; }
};

Id NumberOfBlocks(const SparseMatrix& A)
{
  return (Id(A.rows) + UnknownsPerBlock - 1) / UnknownsPerBlock;
}

Range BlockOf(const SparseMatrix& A, Id block)
{
  const auto begin = static_cast<Index>(block * UnknownsPerBlock);
  return { begin, static_cast<Index>(std::min<Id>(A.rows, Id(begin) + UnknownsPerBlock)) };
}

/// The blocks that have a group with unknown i: block[begin[i] .. begin[i + 1]), ascending.
struct BlocksOfUnknowns
{
  std::vector<Index> begin;
  std::vector<Index> block;
};

template<class Visit>
void ForMembers(const UnknownGroups& groups, Visit&& visit)
{
  for (const Index member : groups.unknown)
  {
    if (member >= 0)
    {
      visit(member);
    }
  }
}

BlocksOfUnknowns FindBlocks(Index unknowns, const std::vector<UnknownGroups>& groups)
{
  std::vector<Index> last(unknowns, -1); // the last block that has counted or listed the unknown
  BlocksOfUnknowns blocks;
  blocks.begin.assign(Id(unknowns) + 1, 0);
  const auto forPairs = [&](const auto& visit)
  {
    std::fill(last.begin(), last.end(), -1);
    for (Index block = 0; block < static_cast<Index>(groups.size()); ++block)
    {
      ForMembers(groups[block],
        [&](Index member)
        {
          if (last[member] != block)
          {
            last[member] = block;
            visit(member, block);
          }
        });
    }
  };
  forPairs([&](Index member, Index) { ++blocks.begin[member]; });
  blocks.block.resize(ExclusiveScan(blocks.begin));
  std::vector<Index> next = blocks.begin;
  forPairs([&](Index member, Index block) { blocks.block[next[member]++] = block; });
  return blocks;
}

/// Gives every block the lowest color that no earlier coupled block has.
std::vector<int> ColorBlocks(const SparseMatrix& A, const std::vector<UnknownGroups>& groups)
{
  const BlocksOfUnknowns blocks = FindBlocks(A.rows, groups);
  std::vector<int> color(groups.size(), -1);
  std::vector<char> isTaken;
  for (std::size_t block = 0; block < groups.size(); ++block)
  {
    isTaken.assign(isTaken.size(), 0);
    ForMembers(groups[block],
      [&](Index member)
      {
        for (Id k = A.rowBegin[member]; k < A.rowBegin[member + 1]; ++k)
        {
          const Index j = A.column[k];
          for (Index other = blocks.begin[j]; other < blocks.begin[j + 1]; ++other)
          {
            if (color[blocks.block[other]] >= 0)
            {
              isTaken[color[blocks.block[other]]] = 1;
            }
          }
        }
      });
    const auto free = std::find(isTaken.begin(), isTaken.end(), 0);
    color[block] = static_cast<int>(free - isTaken.begin());
    if (free == isTaken.end())
    {
      isTaken.push_back(0);
    }
  }
  return color;
}

/// Sorts the groups of all blocks by color. Blocks without a group are left out.
PatchOrder SortByColor(const SparseMatrix& A, const std::vector<UnknownGroups>& groups, int size)
{
  const std::vector<int> color = ColorBlocks(A, groups);
  const int colors = color.empty() ? 0 : 1 + *std::max_element(color.begin(), color.end());
  PatchOrder order;
  order.dof.size = size;
  order.blockBegin.push_back(0);
  order.colorBegin.push_back(0);
  for (int c = 0; c < colors; ++c)
  {
    for (std::size_t block = 0; block < groups.size(); ++block)
    {
      if (color[block] == c && !groups[block].IsEmpty())
      {
        order.dof.Add(groups[block].unknown);
        order.blockBegin.push_back(order.dof.Count());
      }
    }
    order.colorBegin.push_back(static_cast<Id>(order.blockBegin.size()) - 1);
  }
  return order;
}

/// Grows groups from the unknowns of one block, each by the strongest coupling of its members.
class GroupGrower
{
public:
  GroupGrower(
    const SparseMatrix& A, const std::vector<double>& diagonal, const Range& range, int size)
    : A_(A), diagonal_(diagonal), range_(range), size_(size), isGrouped_(range.end - range.begin, 0)
  {
  }

  UnknownGroups Grow()
  {
    UnknownGroups groups(size_);
    std::vector<Index> group(size_);
    for (Index seed = range_.begin; seed < range_.end; ++seed)
    {
      if (this->IsGrouped(seed))
      {
        continue;
      }
      if (this->GrowFrom(seed, group))
      {
        groups.Add(group);
        for (const Index member : group)
        {
          if (range_.Contains(member))
          {
            isGrouped_[member - range_.begin] = 1;
          }
        }
      }
    }
    return groups;
  }

private:
  /// True only for unknowns of this block, because the result must not depend on the progress of
  /// other blocks.
  bool IsGrouped(Index i) const { return range_.Contains(i) && isGrouped_[i - range_.begin]; }

  /// Grows a group. It may include members of other groups and of other blocks, because lines must
  /// not end at block borders.
  /// @return  whether a coupling leads on from the seed
  bool GrowFrom(Index seed, std::vector<Index>& group) const
  {
    std::fill(group.begin(), group.end(), -1);
    group[0] = seed;
    int count = 1;
    for (; count < size_; ++count)
    {
      std::pair<double, Index> strongest{ 0.0, -1 };
      for (int k = 0; k < count; ++k)
      {
        this->FindStronger(group, group[k], strongest);
      }
      if (strongest.second < 0)
      {
        break;
      }
      group[count] = strongest.second;
    }
    return count > 1;
  }

  void FindStronger(
    const std::vector<Index>& group, Index member, std::pair<double, Index>& strongest) const
  {
    for (Id k = A_.rowBegin[member]; k < A_.rowBegin[member + 1]; ++k)
    {
      const Index other = A_.column[k];
      if (std::find(group.begin(), group.end(), other) != group.end())
      {
        continue;
      }
      const double coupling = -A_.value[k] / std::sqrt(diagonal_[member] * diagonal_[other]) *
                              (this->IsGrouped(other) ? WeightOfGrouped : 1.0);
      if (coupling > strongest.first)
      {
        strongest = { coupling, other };
      }
    }
  }

  const SparseMatrix& A_;
  const std::vector<double>& diagonal_;
  Range range_;
  int size_;
  std::vector<char> isGrouped_;
};

} // namespace

PatchOrder OrderInBlocks(const SparseMatrix& A)
{
  std::vector<UnknownGroups> groups(NumberOfBlocks(A), UnknownGroups(1));
  for (std::size_t block = 0; block < groups.size(); ++block)
  {
    const Range range = BlockOf(A, static_cast<Id>(block));
    groups[block].unknown.resize(range.end - range.begin);
    std::iota(groups[block].unknown.begin(), groups[block].unknown.end(), range.begin);
  }
  return SortByColor(A, groups, 1);
}

PatchOrder GroupByCoupling(const SparseMatrix& A, int threads, int size)
{
  const std::vector<double> diagonal = A.Diagonal();
  std::vector<UnknownGroups> groups(NumberOfBlocks(A));
  ParallelBlocks(static_cast<Id>(groups.size()), threads,
    [&](Id block) { groups[block] = GroupGrower(A, diagonal, BlockOf(A, block), size).Grow(); });
  return SortByColor(A, groups, size);
}

} // namespace gridfem
