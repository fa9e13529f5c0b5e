#include "Base/LargeMemory.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace gridfem
{

// Address sanitizers watch only the heap.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

namespace
{

constexpr std::size_t Page = std::size_t{ 1 } << 16; // a multiple of the page size of every system
constexpr std::size_t LargePage = std::size_t{ 1 } << 21;

std::size_t RoundUp(std::size_t size, std::size_t unit)
{
  return (size + unit - 1) / unit * unit;
}

/// Freed memory that is kept while a MemoryReuse exists.
struct FreeBlocks
{
  std::mutex mutex;
  int users = 0;
  std::map<char*, std::size_t> bytes; // no two blocks are adjacent

  /// Returns `wanted` bytes, a multiple of Page, to the system, or all of them if there are fewer.
  void Return(std::size_t wanted) noexcept
  {
    while (wanted > 0 && !bytes.empty())
    {
      const auto block = std::prev(bytes.end());
      const std::size_t part = std::min(wanted, block->second);
      block->second -= part;
      wanted -= part;
      munmap(block->first + block->second, part);
      if (block->second == 0)
      {
        bytes.erase(block);
      }
    }
  }

  /// Cuts `size` bytes off the end of the smallest block that is large enough. If there is none,
  /// returns as many bytes to the system and gives null.
  char* Take(std::size_t size) noexcept
  {
    auto best = bytes.end();
    for (auto block = bytes.begin(); block != bytes.end(); ++block)
    {
      const bool isSmaller = best == bytes.end() || block->second < best->second;
      best = block->second >= size && isSmaller ? block : best;
    }
    if (best == bytes.end())
    {
      this->Return(size);
      return nullptr;
    }
    best->second -= size;
    char* const memory = best->first + best->second;
    if (best->second == 0)
    {
      bytes.erase(best);
    }
    return memory;
  }

  void Insert(char* memory, std::size_t size)
  {
    const auto block = bytes.emplace(memory, size).first;
    const auto next = std::next(block);
    if (next != bytes.end() && memory + size == next->first)
    {
      block->second += next->second;
      bytes.erase(next);
    }
    if (block != bytes.begin())
    {
      const auto before = std::prev(block);
      if (before->first + before->second == memory)
      {
        before->second += block->second;
        bytes.erase(block);
      }
    }
  }
};

/// Never destroyed, because arrays of static lifetime may outlive it.
FreeBlocks& Kept()
{
  static FreeBlocks& blocks = *new FreeBlocks;
  return blocks;
}

using Lock = std::lock_guard<std::mutex>;

} // namespace

void PreferLargePages(void* begin, std::size_t bytes) noexcept
{
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = RoundUp(address, LargePage);
  const std::uintptr_t last = (address + bytes) / LargePage * LargePage;
  if (last > first)
  {
    madvise(static_cast<char*>(begin) + (first - address), last - first, MADV_HUGEPAGE);
  }
}

MemoryReuse::MemoryReuse()
{
  const Lock lock(Kept().mutex);
  ++Kept().users;
}

MemoryReuse::~MemoryReuse()
{
  const Lock lock(Kept().mutex);
  if (--Kept().users == 0)
  {
    Kept().Return(std::numeric_limits<std::size_t>::max());
  }
}

void* AllocateLargeMemory(std::size_t bytes)
{
  const std::size_t size = RoundUp(bytes, Page);
  {
    const Lock lock(Kept().mutex);
    if (char* const kept = Kept().Take(size))
    {
      return kept;
    }
  }
  // To start at a large page, map more than needed and unmap the rest.
  void* const all =
    mmap(nullptr, size + LargePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  const auto address = reinterpret_cast<std::uintptr_t>(all);
  const std::size_t before = RoundUp(address, LargePage) - address;
  char* const memory = static_cast<char*>(all) + before;
  munmap(all, before); // fails without effect if `before` is 0
  munmap(memory + size, LargePage - before);
  PreferLargePages(memory, size);
  return memory;
}

void FreeLargeMemory(void* memory, std::size_t bytes) noexcept
{
  const std::size_t size = RoundUp(bytes, Page);
  const Lock lock(Kept().mutex);
  try
  {
    if (Kept().users > 0)
    {
      Kept().Insert(static_cast<char*>(memory), size);
      return;
    }
  }
  catch (const std::bad_alloc&)
  {
  }
  munmap(memory, size);
}

void ReturnLargeMemory(std::size_t bytes) noexcept
{
  const Lock lock(Kept().mutex);
  Kept().Return(RoundUp(bytes, Page)); // munmap frees whole pages, so a partial page would cut into
                                       // the next block
}

#else

void ReturnLargeMemory(std::size_t) noexcept
{
}

void PreferLargePages(void*, std::size_t) noexcept
{
}

MemoryReuse::MemoryReuse() = default;
MemoryReuse::~MemoryReuse() = default;

void* AllocateLargeMemory(std::size_t bytes)
{
  return ::operator new(bytes);
}

void FreeLargeMemory(void* memory, std::size_t) noexcept
{
  ::operator delete(memory);
}

#endif

void ReturnFreedMemory() noexcept
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

} // namespace gridfem
