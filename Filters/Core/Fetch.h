// Asks for memory that is needed soon: wishes, without any effect but on time.
// A function that does nothing else has to be EIGEN_ALWAYS_INLINE: the compiler takes it for one
// without effect, and does not call it at all.
#ifndef GridFEM_Fetch_h
#define GridFEM_Fetch_h

#include <Eigen/Core>

#include <cstddef>

namespace gridfem
{

/// The line of the cache that holds an address.
EIGEN_ALWAYS_INLINE void Fetch(const void* address)
{
#ifdef __GNUC__
  __builtin_prefetch(address);
#else
  static_cast<void>(address);
#endif
}

/// All of an object.
template<class Object>
EIGEN_ALWAYS_INLINE void FetchAll(const Object& object)
{
  constexpr std::size_t LineSize = 64;
  const char* const begin = reinterpret_cast<const char*>(&object);
  for (std::size_t byte = 0; byte < sizeof(Object); byte += LineSize)
  {
    Fetch(begin + byte);
  }
}

} // namespace gridfem

#endif
