// Memory for large arrays: few large pages where the system has them, because a block that is
// touched for the first time costs a call into the system for every page.
#ifndef GridFEM_LargeMemory_h
#define GridFEM_LargeMemory_h

#include <cstddef>

namespace gridfem
{

/// From this size on (bytes) arrays take large memory; below it the usual heap is faster.
constexpr std::size_t LargeMemorySize = std::size_t{ 1 } << 20;

/// Memory without values, aligned to a page, that goes back to the system as soon as it is free:
/// the peak of a run then is what its arrays need. Throws std::bad_alloc.
void* AllocateLargeMemory(std::size_t bytes);

/// @param bytes  as at AllocateLargeMemory
void FreeLargeMemory(void* memory, std::size_t bytes) noexcept;

/// Asks for large pages where memory of any origin that has not been touched yet spans some of
/// them. A wish: the system may ignore it, and only Linux is asked. Contents do not change.
void PreferLargePages(void* begin, std::size_t bytes) noexcept;

} // namespace gridfem

#endif
