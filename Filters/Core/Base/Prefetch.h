// Asks for memory that is needed soon: wishes, without any effect but on time.
// A function that does nothing else has to be EIGEN_ALWAYS_INLINE: the compiler takes it for one
// without effect, and does not call it at all.
#ifndef GridFEM_Prefetch_h
#define GridFEM_Prefetch_h

#include <Eigen/Core>

#include <cstddef>

namespace gridfem
{

constexpr std::size_t LineSize = 64;

/// As many lines of the cache, from that of an address on.
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

/// All of an object that begins with a line.
template<class Object>
EIGEN_ALWAYS_INLINE void FetchAll(const Object& object)
{
  Fetch<(sizeof(Object) + LineSize - 1) / LineSize>(&object);
}

} // namespace gridfem

#endif
