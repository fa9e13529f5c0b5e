// Tests arrays below and above the size at which they start to use large memory.
#include "Base/Array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <vector>

#ifdef __linux__
#include <unistd.h>
#endif

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

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

namespace
{

constexpr std::size_t Block = 4 * LargeMemorySize;

/// Bytes of the process that are resident in memory.
double ResidentBytes()
{
  std::ifstream file("/proc/self/statm");
  double size = 0.0;
  double resident = 0.0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

char* AllocateAndTouch(std::size_t bytes)
{
  auto* const memory = static_cast<char*>(AllocateLargeMemory(bytes));
  std::memset(memory, 1, bytes);
  return memory;
}

} // namespace

TEST(LargeMemory, IsUsedAgainInPartsAndAsAWhole)
{
  const MemoryReuse reuse;
  char* const whole = AllocateAndTouch(Block);
  FreeLargeMemory(whole, Block);
  char* const half = AllocateAndTouch(Block / 2);
  char* const other = AllocateAndTouch(Block / 2);
  EXPECT_EQ(std::min(half, other), whole);
  EXPECT_EQ(std::max(half, other), whole + Block / 2);
  FreeLargeMemory(half, Block / 2);
  FreeLargeMemory(other, Block / 2);
  char* const again = AllocateAndTouch(Block);
  EXPECT_EQ(again, whole);
  FreeLargeMemory(again, Block);
}

TEST(LargeMemory, ThatIsKeptGoesBackWithTheLastReuse)
{
  const double before = ResidentBytes();
  {
    const MemoryReuse outer;
    {
      const MemoryReuse inner;
      FreeLargeMemory(AllocateAndTouch(8 * Block), 8 * Block);
    }
    EXPECT_GT(ResidentBytes(), before + 7.0 * Block);
  }
  EXPECT_LT(ResidentBytes(), before + Block);
}

TEST(LargeMemory, ThatIsKeptMakesRoomForARequestItDoesNotFit)
{
  const MemoryReuse reuse;
  FreeLargeMemory(AllocateAndTouch(8 * Block), 8 * Block);
  const double before = ResidentBytes();
  char* const larger = AllocateAndTouch(9 * Block);
  EXPECT_LT(ResidentBytes(), before + 2.0 * Block);
  FreeLargeMemory(larger, 9 * Block);
}

TEST(LargeMemory, ThatIsKeptGoesBackWhenAskedFor)
{
  const MemoryReuse reuse;
  const double before = ResidentBytes();
  FreeLargeMemory(AllocateAndTouch(8 * Block), 8 * Block);
  EXPECT_GT(ResidentBytes(), before + 7.0 * Block);
  ReturnLargeMemory(6 * Block);
  EXPECT_LT(ResidentBytes(), before + 3.0 * Block);
}

// Regression test: once, partial pages were returned. The rest of a block began inside a page, and
// returning it took the beginning of the next block, which was in use.
TEST(LargeMemory, GoesBackInWholePages)
{
  const MemoryReuse reuse;
  char* const whole = AllocateAndTouch(Block);
  FreeLargeMemory(whole, Block);
  char* const used = AllocateAndTouch(Block / 2); // the end of `whole`
  ASSERT_EQ(used, whole + Block / 2);
  ReturnLargeMemory(12345);
  char* const other = AllocateAndTouch(LargeMemorySize);
  EXPECT_EQ(
    reinterpret_cast<std::uintptr_t>(other) % static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), 0u);
  FreeLargeMemory(other, LargeMemorySize);
  ReturnLargeMemory(Block);
  EXPECT_EQ(std::count(used, used + Block / 2, char{ 1 }), std::ptrdiff_t(Block / 2));
  FreeLargeMemory(used, Block / 2);
}

TEST(LargeMemory, IsSharedByThreads)
{
  const MemoryReuse reuse;
  int wrong = 0;
#pragma omp parallel for num_threads(4) schedule(dynamic, 1) reduction(+ : wrong)
  for (int k = 0; k < 200; ++k)
  {
    const std::size_t size = LargeMemorySize + 5000 * (k % 17);
    auto* const memory = static_cast<char*>(AllocateLargeMemory(size));
    std::memset(memory, k, size);
    wrong +=
      std::count(memory, memory + size, static_cast<char>(k)) == std::ptrdiff_t(size) ? 0 : 1;
    FreeLargeMemory(memory, size);
  }
  EXPECT_EQ(wrong, 0);
}

#endif
