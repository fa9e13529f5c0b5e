// Memory for large arrays: few large pages where the system has them, because a block that is
// touched for the first time costs a call into the system for every page.
#ifndef GridFEM_LargeMemory_h
#define GridFEM_LargeMemory_h

#include <cstddef>

namespace gridfem
{

/// From this size on (bytes) arrays take large memory; below it the usual heap is faster.
constexpr std::size_t LargeMemorySize = std::size_t{ 1 } << 20;

/// Memory without values, aligned to a page, that goes back to the system as soon as it is free
/// (but see MemoryReuse): the peak of a run then is what its arrays need. Any thread. Throws
/// std::bad_alloc.
void* AllocateLargeMemory(std::size_t bytes);

/// @param bytes  as at AllocateLargeMemory
void FreeLargeMemory(void* memory, std::size_t bytes) noexcept;

/// While one exists, large memory that is freed stays for the next requests: the system takes a
/// fifth of a set-up to clear new pages. For a request that no free block is large enough for, as
/// much goes back, so that the peak does not grow. The last one to go returns what is left.
class MemoryReuse
{
public:
  MemoryReuse();
  ~MemoryReuse();
  MemoryReuse(const MemoryReuse&) = delete;
  MemoryReuse& operator=(const MemoryReuse&) = delete;
};

/// Gives up to so many of the bytes that are kept for reuse back to the system, before memory of
/// another origin is taken.
void ReturnLargeMemory(std::size_t bytes) noexcept;

/// Gives memory of any size that has been freed back to the system, where the heap can (glibc).
void ReturnFreedMemory() noexcept;

/// Asks for large pages where memory of any origin that has not been touched yet spans some of
/// them. A wish: the system may ignore it, and only Linux is asked. Contents do not change.
void PreferLargePages(void* begin, std::size_t bytes) noexcept;

} // namespace gridfem

#endif
