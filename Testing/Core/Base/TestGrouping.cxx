// Compares grouping with lists made one item after the other.
#include "Base/Grouping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

using namespace gridfem;

namespace
{

std::vector<std::vector<Index>> ListsOf(const Array<Index>& group, Id groups)
{
  std::vector<std::vector<Index>> lists(groups);
  for (std::size_t item = 0; item < group.size(); ++item)
  {
    lists[group[item]].push_back(static_cast<Index>(item));
  }
  return lists;
}

void ExpectGroups(const Array<Index>& group, Id groups)
{
  const auto lists = ListsOf(group, groups);
  for (const int threads : { 1, 2, 3, 7 })
  {
    SCOPED_TRACE(std::to_string(groups) + " groups, " + std::to_string(threads) + " threads");
    const Groups found = GroupItems(group, groups, threads);
    ASSERT_EQ(static_cast<Id>(found.begin.size()), groups + 1);
    ASSERT_EQ(found.begin[groups], static_cast<Index>(group.size()));
    for (Id g = 0; g < groups; ++g)
    {
      const Index* const items = found.item.data();
      ASSERT_EQ(std::vector<Index>(items + found.begin[g], items + found.begin[g + 1]), lists[g]);
    }
  }
}

} // namespace

/// Enough items for several ranges.
constexpr Id Many = 4 * ItemsPerRange + 3;

TEST(Grouping, KeepsTheOrderOfItemsInAnyOrderOfGroups)
{
  std::mt19937 random(1);
  for (const Id groups : { Id{ 1 }, Id{ 5 }, Id{ 1000 }, Many, 3 * Many })
  {
    Array<Index> group(Many);
    for (Index& g : group)
    {
      g = static_cast<Index>(random() % groups);
    }
    ExpectGroups(group, groups);
    std::sort(group.begin(), group.end());
    ExpectGroups(group, groups);
  }
}

TEST(Grouping, TakesRunsThatCrossTheBordersOfRanges)
{
  Array<Index> group(Many);
  for (Id item = 0; item < Many; ++item)
  {
    group[item] = static_cast<Index>(item / 1000 * 7 % 50);
  }
  ExpectGroups(group, 50);
}

TEST(Grouping, OfFewItemsOrNone)
{
  ExpectGroups({}, 0);
  ExpectGroups({}, 4);
  ExpectGroups({ 2 }, 4);
  ExpectGroups({ 3, 0, 3, 0 }, 4);
}
