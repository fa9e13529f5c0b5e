// Prefetches memory that is needed soon. A prefetch is a hint and affects only time.
// A function that only prefetches must be EIGEN_ALWAYS_INLINE. Otherwise the compiler considers it
// free of effects and drops the call.
#ifndef GridFEM_Prefetch_h
#define GridFEM_Prefetch_h

#include <Eigen/Core>

#include <cstddef>

namespace gridfem
{

constexpr std::size_t LineSize = 64;

/// Prefetches `Lines` cache lines, beginning with the line that contains `address`.
template<std::size_t Lines = 1>
EIGEN_ALWAYS_INLINE void Fetch(const void* address)
{
#ifdef __GNUC__
  for (std::size_t line = 0; line < Lines; ++line)
  {
    __builtin_prefetch(static_cast<const char*>(address) + line * LineSize);
  }
#else
  static_cast<void>(address);
#endif
}

/// Prefetches a whole object that starts at the beginning of a cache line.
template<class Object>
EIGEN_ALWAYS_INLINE void FetchAll(const Object& object)
{
  Fetch<(sizeof(Object) + LineSize - 1) / LineSize>(&object);
}

} // namespace gridfem

#endif
