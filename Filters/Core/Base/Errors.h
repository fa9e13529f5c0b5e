// The errors that Core throws. Numerical outcomes (not converged) are returned, never thrown.
#ifndef GridFEM_Errors_h
#define GridFEM_Errors_h

#include "Base/Types.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace gridfem
{

/// A precondition is broken. The message names the offending id or value and suggests a remedy.
struct InvalidInput : std::invalid_argument
{
  using std::invalid_argument::invalid_argument;
};

/// The progress callback asked to stop.
struct Aborted : std::runtime_error
{
  Aborted() : std::runtime_error("aborted") {}
};

/// The system cannot start more threads, or has no memory for them.
struct OutOfThreads : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Throws InvalidInput when `count` things cannot be numbered by Index.
inline void RequireIndices(double count, const char* what)
{
  if (count > std::numeric_limits<Index>::max())
  {
    throw InvalidInput("There are " + std::to_string(count) + " " + what +
                       ", more than 2^31 - 1. Choose a smaller depth or split the mesh.");
  }
}

} // namespace gridfem

#endif
