// Memory for large arrays. It uses few large pages where the system has them, because the first
// touch of every page costs a call into the system.
#ifndef GridFEM_LargeMemory_h
#define GridFEM_LargeMemory_h

#include <cstddef>

namespace gridfem
{

/// Arrays of at least this size (bytes) use large memory. Below it, the heap is faster.
constexpr std::size_t LargeMemorySize = std::size_t{ 1 } << 20;

/// Allocates uninitialized memory, aligned to a page. Freed memory returns to the system at once
/// (except under MemoryReuse), so the peak of a run is the size of its arrays. Any thread may call
/// it. Throws std::bad_alloc.
void* AllocateLargeMemory(std::size_t bytes);

/// @param bytes  the size passed to AllocateLargeMemory
void FreeLargeMemory(void* memory, std::size_t bytes) noexcept;

/// While an object of this class exists, freed large memory is kept for later requests. Without it,
/// the system spends a fifth of a set-up on clearing new pages. If no kept block is large enough
/// for a request, as many kept bytes return to the system, so the peak does not grow. The
/// destructor of the last object returns the rest.
class MemoryReuse
{
public:
  MemoryReuse();
  ~MemoryReuse();
  MemoryReuse(const MemoryReuse&) = delete;
  MemoryReuse& operator=(const MemoryReuse&) = delete;
};

/// Returns up to `bytes` bytes of the memory kept for reuse to the system. Called before memory is
/// allocated elsewhere.
void ReturnLargeMemory(std::size_t bytes) noexcept;

/// Returns freed heap memory of any size to the system, if the heap supports it (glibc).
void ReturnFreedMemory() noexcept;

/// Asks the system for large pages in untouched memory, wherever the range spans whole large pages.
/// This is only a hint, and only on Linux: the system may ignore it. Contents do not change.
void PreferLargePages(void* begin, std::size_t bytes) noexcept;

} // namespace gridfem

#endif
