// Compares the seams of two surfaces.
#ifndef GridFEM_Testing_SameSeams_h
#define GridFEM_Testing_SameSeams_h

#include "Grid/Seams.h"

#include <gtest/gtest.h>

namespace gridfem::testing
{

inline void ExpectSameSeams(const Seams& found, const Seams& expected)
{
  ASSERT_EQ(found.moves.size(), expected.moves.size());
  for (std::size_t k = 0; k < expected.moves.size(); ++k)
  {
    EXPECT_EQ(found.moves[k].from, expected.moves[k].from);
    EXPECT_EQ(found.moves[k].to, expected.moves[k].to);
  }
  ASSERT_EQ(found.divisions.size(), expected.divisions.size());
  for (std::size_t k = 0; k < expected.divisions.size(); ++k)
  {
    EXPECT_EQ(found.divisions[k].ends, expected.divisions[k].ends);
    EXPECT_EQ(found.divisions[k].nodes, expected.divisions[k].nodes);
  }
}

} // namespace gridfem::testing

#endif
