// Checks of a hierarchy's copy with factors in double precision.
#ifndef GridFEM_Testing_PrecisionChecks_h
#define GridFEM_Testing_PrecisionChecks_h

#include "SampledHierarchy.h"

#include <gtest/gtest.h>

namespace gridfem::testing
{

/// @param mixed  a hierarchy with factors in single precision
/// @param built  the same hierarchy, built in double precision
inline void ExpectCopyInDoublePrecision(const Multigrid& mixed, const Multigrid& built)
{
  const MultiVector b = RandomValues(built.Matrix().rows, 1);
  const Multigrid copy = mixed.InDoublePrecision();
  MultiVector expected;
  MultiVector copied;
  MultiVector x;
  built.Precondition(b, expected);
  copy.Precondition(b, copied);
  mixed.Precondition(b, x);
  EXPECT_EQ(copied, expected);
  EXPECT_NE(x, expected); // so it was not in double precision before
  EXPECT_FALSE(copy.HasSingleFactors());
}

} // namespace gridfem::testing

#endif
