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

/// While one exists, large memory that is freed stays for the next requests, because the system
/// takes a fifth of a set-up to clear new pages. A request that no block of it is large enough for
/// gets large pages of several, and some more go back, so that the peak does not grow. The last one
/// to go returns what is left.
class MemoryReuse
{
public:
  MemoryReuse();
  ~MemoryReuse();
  MemoryReuse(const MemoryReuse&) = delete;
  MemoryReuse& operator=(const MemoryReuse&) = delete;
};

/// Puts what is kept for reuse in the place of private memory, of a vector for example, that has
/// not been touched yet, as far as there is, and gives at least as much as is missing back to the
/// system. Contents become undefined; the pages do not return to what is kept.
void AdoptLargeMemory(void* begin, std::size_t bytes) noexcept;

/// Asks for large pages where memory of any origin that has not been touched yet spans some of
/// them. A wish: the system may ignore it, and only Linux is asked. Contents do not change.
void PreferLargePages(void* begin, std::size_t bytes) noexcept;

} // namespace gridfem

#endif
