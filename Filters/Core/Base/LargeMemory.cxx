#include "Base/LargeMemory.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <new>

namespace gridfem
{

#ifdef __linux__

namespace
{

constexpr std::size_t LargePage = std::size_t{ 1 } << 21;

std::size_t RoundUp(std::size_t size, std::size_t unit)
{
  return (size + unit - 1) / unit * unit;
}

} // namespace

void PreferLargePages(void* begin, std::size_t bytes) noexcept
{
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = RoundUp(address, LargePage);
  const std::uintptr_t last = (address + bytes) / LargePage * LargePage;
  if (last > first)
  {
    madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
  }
}

#else

void PreferLargePages(void*, std::size_t) noexcept
{
}

#endif

// Address sanitizers watch the heap alone.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

namespace
{

std::size_t RoundUpToPages(std::size_t bytes)
{
  return RoundUp(bytes, static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
}

/// New memory that begins with a large page.
char* MapMemory(std::size_t bytes)
{
  // More than is wanted, so that a part of it begins there; the rest is given back.
  const std::size_t mapped = bytes + LargePage;
  void* const begin =
    mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (begin == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::size_t before = RoundUp(address, LargePage) - address;
  char* const memory = static_cast<char*>(begin) + before;
  if (before > 0)
  {
    munmap(begin, before);
  }
  if (before < LargePage)
  {
    munmap(memory + bytes, LargePage - before);
  }
  PreferLargePages(memory, bytes);
  return memory;
}

/// Moves the last large pages of a block, at most so many; what is behind them goes back. Mappings
/// begin with a large page, so that none of these pages lies in two.
/// @param bytes  of the block; gets what is left of it
/// @return bytes moved
std::size_t MoveLastPages(char* block, std::size_t& bytes, char* to, std::size_t most) noexcept
{
  const auto address = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = RoundUp(address, LargePage);
  const std::uintptr_t last = (address + bytes) / LargePage * LargePage;
  if (last <= first || most == 0)
  {
    return 0;
  }
  const std::size_t pages = std::min(most, (last - first) / LargePage);
  const std::size_t begin = last - address - pages * LargePage;
  std::size_t moved = 0;
  while (moved < pages * LargePage && mremap(block + begin + moved, LargePage, LargePage,
                                        MREMAP_MAYMOVE | MREMAP_FIXED, to + moved) != MAP_FAILED)
  {
    moved += LargePage;
  }
  if (moved < pages * LargePage)
  {
    // The system may have removed what was there.
    mmap(to + moved, LargePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1,
      0);
  }
  if (begin + moved < bytes)
  {
    munmap(block + begin + moved, bytes - begin - moved);
  }
  bytes = begin;
  return moved;
}

/// Blocks that were freed while somebody wants to use them again. Sizes are whole pages.
class FreeBlocks
{
public:
  void Keep()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++users_;
  }

  void Drop() noexcept
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--users_ == 0)
    {
      this->Return(std::numeric_limits<std::size_t>::max());
    }
  }

  /// A part of the smallest block that is large enough; null if none is.
  char* Take(std::size_t bytes)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto best = blocks_.end();
    for (auto block = blocks_.begin(); block != blocks_.end(); ++block)
    {
      if (block->second >= bytes && (best == blocks_.end() || block->second < best->second))
      {
        best = block;
      }
    }
    if (best == blocks_.end())
    {
      return nullptr;
    }
    best->second -= bytes;
    char* const memory = best->first + best->second;
    if (best->second == 0)
    {
      blocks_.erase(best);
    }
    return memory;
  }

  /// Puts large pages of kept blocks in the place of those of `memory`, which begins with one and
  /// has not been touched: as many as there are. Then more than `bytes` fewer are kept.
  void MovePages(char* memory, std::size_t bytes) noexcept
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::size_t moved = 0;
    for (auto block = blocks_.begin(); block != blocks_.end() && moved + LargePage <= bytes;)
    {
      moved +=
        MoveLastPages(block->first, block->second, memory + moved, (bytes - moved) / LargePage);
      block = block->second == 0 ? blocks_.erase(block) : std::next(block);
    }
    this->Return(Generously * bytes - moved);
  }

  void Give(char* memory, std::size_t bytes) noexcept
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (users_ == 0 || !this->Insert(memory, bytes))
    {
      munmap(memory, bytes);
    }
  }

private:
  /// Blocks also hold what arrays had reserved and not used, which was no memory yet.
  static constexpr std::size_t Generously = 2;

  /// Joins neighbours. Returns false where there is no memory for the entry itself.
  bool Insert(char* memory, std::size_t bytes) noexcept
  try
  {
    const auto block = blocks_.emplace(memory, bytes).first;
    const auto next = std::next(block);
    if (next != blocks_.end() && memory + bytes == next->first)
    {
      block->second += next->second;
      blocks_.erase(next);
    }
    if (block != blocks_.begin())
    {
      const auto before = std::prev(block);
      if (before->first + before->second == memory)
      {
        before->second += block->second;
        blocks_.erase(block);
      }
    }
    return true;
  }
  catch (const std::bad_alloc&)
  {
    return false;
  }

  /// Gives that much, or all there is, back to the system.
  void Return(std::size_t bytes) noexcept
  {
    while (bytes > 0 && !blocks_.empty())
    {
      const auto block = blocks_.begin();
      const std::size_t part = std::min(bytes, block->second);
      block->second -= part;
      bytes -= part;
      munmap(block->first + block->second, part);
      if (block->second == 0)
      {
        blocks_.erase(block);
      }
    }
  }

  std::mutex mutex_;
  int users_ = 0;
  std::map<char*, std::size_t> blocks_; // bytes by first address
};

/// Never destroyed: arrays of static lifetime may outlive it.
FreeBlocks& KeptBlocks()
{
  static FreeBlocks& blocks = *new FreeBlocks;
  return blocks;
}

} // namespace

MemoryReuse::MemoryReuse()
{
  KeptBlocks().Keep();
}

MemoryReuse::~MemoryReuse()
{
  KeptBlocks().Drop();
}

void* AllocateLargeMemory(std::size_t bytes)
{
  const std::size_t size = RoundUpToPages(bytes);
  if (char* const kept = KeptBlocks().Take(size))
  {
    return kept;
  }
  char* const memory = MapMemory(size);
  KeptBlocks().MovePages(memory, size);
  return memory;
}

void FreeLargeMemory(void* memory, std::size_t bytes) noexcept
{
  KeptBlocks().Give(static_cast<char*>(memory), RoundUpToPages(bytes));
}

void AdoptLargeMemory(void* begin, std::size_t bytes) noexcept
{
  PreferLargePages(begin, bytes);
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::size_t before = RoundUp(address, LargePage) - address;
  if (before < bytes)
  {
    KeptBlocks().MovePages(static_cast<char*>(begin) + before, bytes - before);
  }
}

#else

void AdoptLargeMemory(void*, std::size_t) noexcept
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

} // namespace gridfem
