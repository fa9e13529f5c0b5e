// Array: a std::vector whose resize() leaves numbers uninitialized. The numbers are about to be
// written anyway, and the threads that write them should be the first to touch their memory.
#ifndef GridFEM_Array_h
#define GridFEM_Array_h

#include "Base/LargeMemory.h"

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace gridfem
{

template<class T>
struct UninitializedAllocator : std::allocator<T>
{
  template<class U>
  struct rebind
  {
    using other = UninitializedAllocator<U>;
  };

  UninitializedAllocator() = default;
  template<class U>
  UninitializedAllocator(const UninitializedAllocator<U>&)
  {
  }

  T* allocate(std::size_t count)
  {
    const bool isLarge = count >= LargeMemorySize / sizeof(T);
    return isLarge ? static_cast<T*>(AllocateLargeMemory(count * sizeof(T)))
                   : std::allocator<T>::allocate(count);
  }
  void deallocate(T* items, std::size_t count) noexcept
  {
    if (count >= LargeMemorySize / sizeof(T))
    {
      FreeLargeMemory(items, count * sizeof(T));
    }
    else
    {
      std::allocator<T>::deallocate(items, count);
    }
  }

  template<class U>
  void construct(U* place)
  {
    ::new (static_cast<void*>(place)) U;
  }
  /// Constructs aggregates, too, so that emplace_back writes them in place. Copying an object whose
  /// parts were just written would stall until the parts are in the cache.
  template<class U, class... Args>
  void construct(U* place, Args&&... args)
  {
    if constexpr (std::is_constructible_v<U, Args...>)
    {
      ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
    else
    {
      ::new (static_cast<void*>(place)) U{ std::forward<Args>(args)... };
    }
  }
};

template<class T>
using Array = std::vector<T, UninitializedAllocator<T>>;

/// Empties the array and frees its memory. `array = {}` would keep the memory.
template<class T>
void Release(Array<T>& array)
{
  array = Array<T>();
}

} // namespace gridfem

#endif
