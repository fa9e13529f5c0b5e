// Compares sorting by keys with the standard library.
#include "Base/RadixSort.h"

#include <gtest/gtest.h>

#include <random>

using namespace gridfem;

namespace
{

Array<SortEntry> Sort(const std::vector<std::uint64_t>& keys, int bits, int threads)
{
  return SortByKey(
    static_cast<Id>(keys.size()), bits, threads,
    [&](Id begin, Id end, const auto& add)
    {
      for (Id k = begin; k < end; ++k)
      {
        add(keys[k], k);
      }
    },
    1000);
}

void ExpectStableOrder(const std::vector<std::uint64_t>& keys, int bits)
{
  std::vector<Id> expected(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    expected[k] = static_cast<Id>(k);
  }
  std::stable_sort(expected.begin(), expected.end(), [&](Id a, Id b) { return keys[a] < keys[b]; });
  for (const int threads : { 1, 3 })
  {
    const Array<SortEntry> sorted = Sort(keys, bits, threads);
    ASSERT_EQ(sorted.size(), keys.size());
    for (std::size_t k = 0; k < sorted.size(); ++k)
    {
      ASSERT_EQ(sorted[k].item, expected[k]) << bits << " bits, place " << k;
      ASSERT_EQ(sorted[k].key, keys[expected[k]]);
    }
  }
}

} // namespace

TEST(RadixSort, AgreesWithTheStandardLibrary)
{
  std::mt19937_64 random(3);
  for (const int bits : { 1, 5, 12, 13, 24, 34, 45, 64 })
  {
    std::vector<std::uint64_t> keys(10000);
    for (std::uint64_t& key : keys)
    {
      key = random() >> (64 - bits);
    }
    ExpectStableOrder(keys, bits);
  }
}

TEST(RadixSort, KeepsTheOrderOfEqualKeysInOneLargeBucket)
{
  std::mt19937_64 random(4);
  std::vector<std::uint64_t> keys(20000);
  for (std::uint64_t& key : keys)
  {
    key = random() % 7;
  }
  ExpectStableOrder(keys, 42);
}

TEST(RadixSort, OfNothingIsNothing)
{
  EXPECT_TRUE(Sort({}, 24, 2).empty());
}

TEST(RadixSort, TakesWhatTheSourcesGive)
{
  const Array<SortEntry> sorted = SortByKey(10, 20, 2,
    [](Id begin, Id end, const auto& add)
    {
      for (Id source = begin; source < end; ++source)
      {
        for (Id copy = 0; copy < source % 3; ++copy)
        {
          add(static_cast<std::uint64_t>(100 - source), 10 * source + copy);
        }
      }
    });
  const std::vector<Id> expected = { 80, 81, 70, 50, 51, 40, 20, 21, 10 };
  ASSERT_EQ(sorted.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
  {
    EXPECT_EQ(sorted[k].item, expected[k]);
  }
}
