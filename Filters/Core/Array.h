// A vector whose resize leaves numbers without a value: they are about to be filled, and the
// threads that fill them should be the first to touch their memory.
#ifndef GridFEM_Array_h
#define GridFEM_Array_h

#include <memory>
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

  template<class U>
  void construct(U* place)
  {
    ::new (static_cast<void*>(place)) U;
  }
  template<class U, class... Args>
  void construct(U* place, Args&&... args)
  {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
};

template<class T>
using Array = std::vector<T, UninitializedAllocator<T>>;

} // namespace gridfem

#endif
