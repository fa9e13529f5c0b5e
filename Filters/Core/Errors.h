// The errors that Core throws. Numerical outcomes (not converged) are returned, never thrown.
#ifndef GridFEM_Errors_h
#define GridFEM_Errors_h

#include <stdexcept>
#include <string>

namespace gridfem
{

/// A precondition is broken; the message names the offending id or value and what would help.
struct InvalidInput : std::invalid_argument
{
  using std::invalid_argument::invalid_argument;
};

/// The progress callback asked to stop.
struct Aborted : std::runtime_error
{
  Aborted() : std::runtime_error("aborted") {}
};

} // namespace gridfem

#endif
