#include "LargeMemory.h"

#include <new>

// Address sanitizers watch the heap alone.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define GRIDFEM_MAPS_MEMORY
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace gridfem
{

#ifdef GRIDFEM_MAPS_MEMORY

namespace
{

constexpr std::size_t LargePage = std::size_t{ 1 } << 21;

void* Map(std::size_t bytes)
{
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  return memory;
}

} // namespace

void* AllocateLargeMemory(std::size_t bytes)
{
  if (bytes < LargePage)
  {
    return Map(bytes);
  }
  // More than is wanted, so that a part of it begins with a large page; the rest is given back.
  char* const mapped = static_cast<char*>(Map(bytes + LargePage));
  const std::size_t before =
    (LargePage - reinterpret_cast<std::uintptr_t>(mapped) % LargePage) % LargePage;
  char* const memory = mapped + before;
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t kept = (bytes + page - 1) / page * page;
  if (before > 0)
  {
    munmap(mapped, before);
  }
  if (before + kept < bytes + LargePage)
  {
    munmap(memory + kept, bytes + LargePage - before - kept);
  }
  madvise(memory, kept, MADV_HUGEPAGE); // a wish; nothing is lost when it is refused
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
