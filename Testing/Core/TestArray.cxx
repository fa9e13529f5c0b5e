// Arrays below and above the size from which they take large memory.
#include "Array.h"

#include <gtest/gtest.h>

#include <limits>
#include <new>
#include <numeric>

using namespace gridfem;

TEST(Array, KeepsItsValuesWhileItGrowsIntoLargeMemory)
{
  Array<int> array;
  const int count = static_cast<int>(3 * LargeMemorySize / sizeof(int));
  for (int i = 0; i < count; ++i)
  {
    array.push_back(i);
  }
  for (int i = 0; i < count; ++i)
  {
    ASSERT_EQ(array[i], i);
  }
}

TEST(Array, OfAnySizeAroundAPageCanBeFilledAndCopied)
{
  for (const std::size_t size : { LargeMemorySize - 1, LargeMemorySize, LargeMemorySize + 1,
         2 * LargeMemorySize - 1, 2 * LargeMemorySize, 2 * LargeMemorySize + 4097 })
  {
    Array<unsigned char> array(size);
    std::iota(array.begin(), array.end(), static_cast<unsigned char>(0));
    const Array<unsigned char> copy = array;
    EXPECT_EQ(copy, array);
    EXPECT_EQ(copy.back(), static_cast<unsigned char>(size - 1));
  }
}

TEST(Array, ReleaseGivesTheMemoryBack)
{
  Array<double> array(1000, 1.0);
  Release(array);
  EXPECT_TRUE(array.empty());
  EXPECT_EQ(array.capacity(), 0u);
}

TEST(LargeMemory, ThatDoesNotExistIsRefused)
{
  EXPECT_THROW(AllocateLargeMemory(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}
