// An approximate inverse in single precision and, where that turns out not to be enough, one in
// double: conjugate gradients begin anew with it, LOBPCG goes on with it.
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
  /// Takes memory and time like a new hierarchy, and is called at most once in an iteration. Empty:
  /// `first` is in double.
  std::function<Inverse()> makeDouble;
};

} // namespace gridfem

#endif
