#include "LargePages.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstdint>

namespace gridfem
{

void PreferLargePages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes)
{
#ifdef __linux__
  constexpr std::uintptr_t PageSize = std::uintptr_t(1) << 21;
  const std::uintptr_t address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + PageSize - 1) / PageSize * PageSize;
  const std::uintptr_t last = (address + bytes) / PageSize * PageSize;
  if (last > first)
  {
    madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
  }
#endif
}

} // namespace gridfem
