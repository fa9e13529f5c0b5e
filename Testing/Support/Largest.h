// The larger of two errors, for comparisons that must see NaN.
#ifndef GridFEM_Testing_Largest_h
#define GridFEM_Testing_Largest_h

#include <cmath>

namespace gridfem::testing
{

/// The larger number; NaN if one of them is NaN. std::max(a, NaN) is a, so a result of NaN would
/// have no error.
inline double Larger(double a, double b)
{
  return std::isnan(a) || a >= b ? a : b;
}

} // namespace gridfem::testing

#endif
