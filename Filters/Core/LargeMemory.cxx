#include "LargeMemory.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <cstdint>

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

void* AllocateLargeMemory(std::size_t bytes)
{
  // More than is wanted, so that a part of it begins with a large page; the rest is given back.
  const std::size_t kept = RoundUp(bytes, static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
  const std::size_t mapped = kept + LargePage;
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
    munmap(memory + kept, LargePage - before);
  }
  PreferLargePages(memory, kept);
  return memory;
}

void FreeLargeMemory(void* memory, std::size_t bytes) noexcept
{
  munmap(memory, bytes);
}

#else

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
