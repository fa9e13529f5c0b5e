// Tests the number of threads that loops use.
#include "Base/Parallel.h"

#include <gtest/gtest.h>

#include <omp.h>

namespace gridfem
{
namespace
{

TEST(Parallel, UsesNoMoreThanTwoThreadsPerProcessor)
{
  const int processors = omp_get_num_procs();
  EXPECT_EQ(NumberOfThreads(0), processors);
  EXPECT_EQ(NumberOfThreads(1), 1);
  EXPECT_EQ(NumberOfThreads(1 << 20), 2 * processors);
}

} // namespace
} // namespace gridfem
