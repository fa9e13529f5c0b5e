#include "Base/LargeMemory.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>
#include <new>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace gridfem
{

// Address sanitizers watch the heap alone.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

namespace
{

constexpr std::size_t Page = std::size_t{ 1 } << 16; // a multiple of any system's
constexpr std::size_t LargePage = std::size_t{ 1 } << 21;

std::size_t RoundUp(std::size_t size, std::size_t unit)
{
  return (size + unit - 1) / unit * unit;
}

/// New memory that begins with a large page: more is asked for, and the rest given back.
char* MapMemory(std::size_t bytes)
{
  void* const all =
    mmap(nullptr, bytes + LargePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  const auto address = reinterpret_cast<std::uintptr_t>(all);
  const std::size_t before = RoundUp(address, LargePage) - address;
  char* const memory = static_cast<char*>(all) + before;
  if (before > 0)
  {
    munmap(all, before);
  }
  if (before < LargePage)
  {
    munmap(memory + bytes, LargePage - before);
  }
  PreferLargePages(memory, bytes);
  return memory;
}

/// Blocks that were freed while somebody wants to use them again.
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

  /// The end of the smallest block that is large enough. Null, and as much is returned, if none is.
  char* Take(std::size_t bytes) noexcept
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto best = blocks_.end();
    for (auto block = blocks_.begin(); block != blocks_.end(); ++block)
    {
      if (block->bytes >= bytes && (best == blocks_.end() || block->bytes < best->bytes))
      {
        best = block;
      }
    }
    if (best == blocks_.end())
    {
      this->Return(bytes);
      return nullptr;
    }
    best->bytes -= bytes;
    char* const memory = best->begin + best->bytes;
    if (best->bytes == 0)
    {
      blocks_.erase(best);
    }
    return memory;
  }

  void ReturnSome(std::size_t bytes) noexcept
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    this->Return(RoundUp(bytes, Page)); // parts of pages would take those of the next block along
  }

  void Give(char* memory, std::size_t bytes) noexcept
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (users_ == 0 || !this->Insert({ memory, bytes }))
    {
      munmap(memory, bytes);
    }
  }

private:
  struct Block
  {
    char* begin;
    std::size_t bytes;
  };

  /// Joins what lies side by side. False where there is no memory for the entry itself.
  bool Insert(Block block) noexcept
  try
  {
    for (std::size_t k = 0; k < blocks_.size();)
    {
      const Block& other = blocks_[k];
      const bool isBefore = other.begin + other.bytes == block.begin;
      if (isBefore || block.begin + block.bytes == other.begin)
      {
        block = { isBefore ? other.begin : block.begin, block.bytes + other.bytes };
        blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(k));
      }
      else
      {
        ++k;
      }
    }
    blocks_.push_back(block);
    return true;
  }
  catch (const std::bad_alloc&)
  {
    return false;
  }

  /// Gives that much, a multiple of Page, or all there is, back to the system.
  void Return(std::size_t bytes) noexcept
  {
    while (bytes > 0 && !blocks_.empty())
    {
      Block& block = blocks_.back();
      const std::size_t part = std::min(bytes, block.bytes);
      block.bytes -= part;
      bytes -= part;
      munmap(block.begin + block.bytes, part);
      if (block.bytes == 0)
      {
        blocks_.pop_back();
      }
    }
  }

  std::mutex mutex_;
  int users_ = 0;
  std::vector<Block> blocks_;
};

/// Never destroyed: arrays of static lifetime may outlive it.
FreeBlocks& KeptBlocks()
{
  static FreeBlocks& blocks = *new FreeBlocks;
  return blocks;
}

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
  KeptBlocks().Keep();
}

MemoryReuse::~MemoryReuse()
{
  KeptBlocks().Drop();
}

void* AllocateLargeMemory(std::size_t bytes)
{
  const std::size_t size = RoundUp(bytes, Page);
  char* const kept = KeptBlocks().Take(size);
  return kept ? kept : MapMemory(size);
}

void FreeLargeMemory(void* memory, std::size_t bytes) noexcept
{
  KeptBlocks().Give(static_cast<char*>(memory), RoundUp(bytes, Page));
}

void ReturnLargeMemory(std::size_t bytes) noexcept
{
  KeptBlocks().ReturnSome(bytes);
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
