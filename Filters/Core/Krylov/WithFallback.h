// An approximate inverse in single precision, and one in double precision as its fallback.
// Conjugate gradients begin anew with the fallback; LOBPCG goes on with it.
#ifndef GridFEM_WithFallback_h
#define GridFEM_WithFallback_h

#include <functional>

namespace gridfem
{

/// Inverse is a Preconditioner or a BlockPreconditioner.
template<class Inverse>
struct WithFallback
{
  Inverse first;
  /// Makes the inverse in double precision. Takes the memory and time of a new hierarchy and is
  /// called at most once in an iteration. Empty: `first` is in double precision already.
  std::function<Inverse()> makeDouble;
};

} // namespace gridfem

#endif
