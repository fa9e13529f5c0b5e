// Memory for large arrays. It goes back to the system as soon as it is free, so that the peak of a
// run is what its arrays need; and it comes in large pages where the system has them, because the
// first touch of many small ones is a good part of a set-up.
#ifndef GridFEM_LargeMemory_h
#define GridFEM_LargeMemory_h

#include <cstddef>

namespace gridfem
{

/// From this size on (bytes) arrays take large memory; below it the usual heap is faster.
constexpr std::size_t LargeMemorySize = std::size_t{ 1 } << 20;

/// @return memory without values, aligned to a page. Throws std::bad_alloc.
void* AllocateLargeMemory(std::size_t bytes);

/// @param bytes  as at AllocateLargeMemory
void FreeLargeMemory(void* memory, std::size_t bytes) noexcept;

} // namespace gridfem

#endif
