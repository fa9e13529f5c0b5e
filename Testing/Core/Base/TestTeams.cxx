// Threads that the system does not give.
#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Base/Teams.h"

#include <gtest/gtest.h>

#include <atomic>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#endif

namespace gridfem
{
namespace
{

constexpr int Many = 64; // their stacks, of 8 MB each, are more than any that are kept

TEST(Teams, OneThreadIsAlwaysThere)
{
  EXPECT_NO_THROW(RequireTeam(1));
  EXPECT_TRUE(CanStart(0));
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// While it lives, the process can have that many more bytes of addresses.
class Limit
{
public:
  explicit Limit(rlim_t room)
  {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &former_);
    const rlimit limit{ pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + room,
      former_.rlim_max };
    setrlimit(RLIMIT_AS, &limit);
  }
  ~Limit() { setrlimit(RLIMIT_AS, &former_); }

private:
  rlimit former_{};
};

TEST(Teams, AreAnErrorWithoutMemoryAndCanBeHadLater)
{
  {
    const Limit limit(32 << 20);
    EXPECT_THROW(RequireTeam(Many), OutOfThreads); // OpenMP itself would end the process
    EXPECT_FALSE(CanStart(Many));
  }
  EXPECT_NO_THROW(RequireTeam(Many));
  std::atomic<int> runs{ 0 };
  ParallelBlocks(1000, 2, [&](Id) { ++runs; });
  EXPECT_EQ(runs, 1000);
}
#endif

} // namespace
} // namespace gridfem
