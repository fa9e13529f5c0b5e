// Tests the behavior when the system refuses threads.
#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Base/Teams.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>

#ifdef __linux__
#include "MemoryLimit.h"
#endif

namespace gridfem
{
namespace
{

constexpr int Many = 64; // their stacks of 8 MB each exceed the stacks that the system keeps

TEST(Teams, OneThreadIsAlwaysThere)
{
  EXPECT_NO_THROW(RequireTeam(1));
  EXPECT_TRUE(CanStart(0));
}

TEST(Teams, JobsSideBySideShareTheThreads)
{
  std::array<std::atomic<int>, 3> share{};
  std::atomic<int> runs{ 0 };
  SideBySide(3, 8,
    [&](int k)
    {
      share[k] = ThreadLimit();
      EXPECT_LE(NumberOfThreads(8), ThreadLimit());
      ++runs;
    });
  EXPECT_EQ(runs, 3);
  EXPECT_EQ(share[0], 3);
  EXPECT_EQ(share[1], 3);
  EXPECT_EQ(share[2], 2);
  EXPECT_EQ(ThreadLimit(), 0);
}

TEST(Teams, MoreJobsThanThreadsHaveOneEach)
{
  std::atomic<int> sum{ 0 };
  SideBySide(5, 2, [&](int) { sum += ThreadLimit(); });
  EXPECT_EQ(sum, 5);
}

TEST(Teams, AnExceptionOfAJobComesWhenAllHaveEnded)
{
  for (const int failing : { 0, 2 })
  {
    std::atomic<int> runs{ 0 };
    EXPECT_THROW(SideBySide(4, 4,
                   [&](int k)
                   {
                     ++runs;
                     if (k == failing)
                     {
                       throw InvalidInput("a job");
                     }
                   }),
      InvalidInput);
    EXPECT_EQ(runs, 4);
    EXPECT_EQ(ThreadLimit(), 0);
  }
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Teams, AreAnErrorWithoutMemoryAndCanBeHadLater)
{
  {
    const testing::MemoryLimit limit(32 << 20);
    EXPECT_THROW(RequireTeam(Many), OutOfThreads); // OpenMP itself would end the process
    EXPECT_FALSE(CanStart(Many));
  }
  EXPECT_NO_THROW(RequireTeam(Many));
  std::atomic<int> runs{ 0 };
  ParallelBlocks(1000, 2, [&](Id) { ++runs; });
  EXPECT_EQ(runs, 1000);
}

TEST(Teams, JobsSideBySideNeedNoThreads)
{
  std::atomic<int> runs{ 0 };
  {
    const testing::MemoryLimit limit(1 << 20);
    SideBySide(Many, Many, [&](int) { ++runs; });
  }
  EXPECT_EQ(runs, Many);
}
#endif

} // namespace
} // namespace gridfem
