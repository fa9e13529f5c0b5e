// Limits the memory of the test's process, on Linux.
#ifndef GridFEM_Testing_MemoryLimit_h
#define GridFEM_Testing_MemoryLimit_h

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace gridfem::testing
{

/// While this object lives, the address space of the process can grow only by `room` bytes.
class MemoryLimit
{
public:
  explicit MemoryLimit(double room)
  {
    double pages = 0.0;
    EXPECT_EQ(getrlimit(RLIMIT_AS, &former_), 0);
    EXPECT_TRUE(std::ifstream("/proc/self/statm") >> pages);
    rlimit limit = former_;
    limit.rlim_cur = static_cast<rlim_t>(pages * double(getpagesize()) + room);
    EXPECT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &former_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
  rlimit former_{};
};

} // namespace gridfem::testing

#endif
