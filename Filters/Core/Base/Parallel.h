// Parallel loops over fixed blocks: the result of a block never depends on the number of threads.
// The calling thread rethrows exceptions, reports progress and handles aborts.
#ifndef GridFEM_Parallel_h
#define GridFEM_Parallel_h

#include "Base/Progress.h"
#include "Base/ShortWaits.h"
#include "Base/Teams.h"
#include "Base/Types.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <type_traits>
#include <vector>

namespace gridfem
{

/// The number of threads to use when `wanted` are requested; 0 requests all processors. At most two
/// threads per processor are used, because threads wait for each other at every barrier. With a
/// thousand threads on two processors, these waits took 80 times as long as the work. Throws
/// OutOfThreads when the threads cannot be started.
inline int NumberOfThreads(int wanted)
{
  const int processors = std::max(1, omp_get_num_procs());
  const int asked = wanted > 0 ? std::min(wanted, 2 * processors) : processors;
  const int threads = ThreadLimit() > 0 ? std::min(asked, ThreadLimit()) : asked;
  if (threads > 1 && !omp_in_parallel())
  {
    KeepWaitsShort();
    RequireTeam(threads);
  }
  return threads;
}

/// Default number of items per block.
constexpr Id DefaultBlockSize = 4096;

/// Patches per block. A patch has matrices and takes as long as many items of other kinds.
constexpr Id PatchesPerBlock = 256;

/// Runs body(block) or body(block, thread) for every block in [0, blocks), in any order. It uses
/// `threads` threads (0: all), numbered from 0. After the loop it rethrows the first exception of a
/// body, or Aborted.
template<class Body>
void ParallelBlocks(Id blocks, int threads, Body&& body, const Progress& progress = {})
{
  const auto run = [&](Id block, [[maybe_unused]] int thread)
  {
    if constexpr (std::is_invocable_v<Body, Id, int>)
    {
      body(block, thread);
    }
    else
    {
      body(block);
    }
  };
  threads = static_cast<int>(std::min<Id>(NumberOfThreads(threads), std::max<Id>(blocks, 1)));
  if (threads == 1)
  {
    for (Id block = 0; block < blocks; ++block)
    {
      progress.Check(double(block) / double(blocks));
      run(block, 0);
    }
    return;
  }
  std::atomic<bool> stop{ false };
  std::exception_ptr error;
#pragma omp parallel num_threads(threads)
  {
    const bool isCaller = omp_get_thread_num() == 0;
#pragma omp for schedule(dynamic, 1)
    for (Id block = 0; block < blocks; ++block)
    {
      if (stop.load(std::memory_order_relaxed))
      {
        continue;
      }
      try
      {
        if (isCaller)
        {
          progress.Check(double(block) / double(blocks));
        }
        run(block, omp_get_thread_num());
      }
      catch (...)
      {
#pragma omp critical(GridFEMParallelError)
        if (!error)
        {
          error = std::current_exception();
        }
        stop = true;
      }
    }
  }
  if (error)
  {
    std::rethrow_exception(error);
  }
}

/// Size in bytes of the memory that two threads cannot write to at the same time without waiting.
/// It is two cache lines, because processors fetch lines in pairs.
constexpr std::size_t CacheLine = 128;

/// Runs body(begin, end) for consecutive ranges of `size` items that cover [0, count).
template<class Body>
void ParallelRanges(
  Id count, int threads, Body&& body, Id size = DefaultBlockSize, const Progress& progress = {})
{
  ParallelBlocks((count + size - 1) / size, threads,
    [&](Id block) { body(block * size, std::min(count, (block + 1) * size)); }, progress);
}

/// Returns the sum of body(begin, end) over fixed ranges, added in order. The result has the same
/// bits for any number of threads. Value needs +=; `zero` is the initial value and fixes the shape.
template<class Value, class Body>
Value ParallelSum(Id count, int threads, Value zero, Body&& body, Id size = DefaultBlockSize)
{
  const Id blocks = (count + size - 1) / size;
  std::vector<Value> parts(blocks, zero);
  ParallelBlocks(blocks, threads,
    [&](Id block) { parts[block] = body(block * size, std::min(count, (block + 1) * size)); });
  for (const Value& part : parts)
  {
    zero += part;
  }
  return zero;
}

/// Replaces counts by their running sum, starting at 0, and returns the total.
template<class Counts>
auto ExclusiveScan(Counts& counts)
{
  typename Counts::value_type total = 0;
  for (auto& count : counts)
  {
    const auto next = total + count;
    count = total;
    total = next;
  }
  return total;
}

} // namespace gridfem

#endif
