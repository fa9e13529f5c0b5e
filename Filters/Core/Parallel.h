// Parallel loops over fixed blocks: what a block computes never depends on the number of threads.
// Exceptions leave the loop on the calling thread; progress and abort are served from it.
#ifndef GridFEM_Parallel_h
#define GridFEM_Parallel_h

#include "Progress.h"
#include "Types.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <vector>

namespace gridfem
{

/// The number of threads to use when `wanted` are asked for; 0 asks for all processors.
inline int NumberOfThreads(int wanted)
{
  return wanted > 0 ? wanted : std::max(1, omp_get_num_procs());
}

/// Items per block where nothing else suggests a size.
constexpr Id DefaultBlockSize = 4096;

/// Runs body(block) for every block in [0, blocks), in any order, on `threads` threads (0: all).
/// The first exception of a body, or Aborted, is thrown again after the loop.
template<class Body>
void ParallelBlocks(Id blocks, int threads, Body&& body, const Progress& progress = {})
{
  threads = static_cast<int>(std::min<Id>(NumberOfThreads(threads), std::max<Id>(blocks, 1)));
  if (threads == 1)
  {
    for (Id block = 0; block < blocks; ++block)
    {
      progress.Check(double(block) / double(blocks));
      body(block);
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
        body(block);
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

/// Runs body(begin, end) for consecutive ranges of `size` items that cover [0, count).
template<class Body>
void ParallelRanges(
  Id count, int threads, Body&& body, Id size = DefaultBlockSize, const Progress& progress = {})
{
  ParallelBlocks((count + size - 1) / size, threads,
    [&](Id block) { body(block * size, std::min(count, (block + 1) * size)); }, progress);
}

/// Sum of body(begin, end) over fixed ranges, added in order: same bits for any number of threads.
/// Value needs +=; `zero` is the start and fixes the shape.
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

/// Replaces counts by their running sum, starting at 0; returns the total.
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

/// Appends what the blocks of a loop have made, in their order; frees it.
template<class Items>
void AppendParts(std::vector<Items> parts, int threads, Items& items)
{
  std::vector<Id> begin;
  begin.reserve(parts.size() + 1);
  Id total = static_cast<Id>(items.size());
  for (const Items& part : parts)
  {
    begin.push_back(total);
    total += static_cast<Id>(part.size());
  }
  items.resize(total);
  ParallelBlocks(static_cast<Id>(parts.size()), threads,
    [&](Id block)
    {
      const Items part = std::move(parts[block]);
      std::copy(part.begin(), part.end(), items.begin() + begin[block]);
    });
}

} // namespace gridfem

#endif
