// Checks of messages.
#ifndef GridFEM_Testing_ExpectOne_h
#define GridFEM_Testing_ExpectOne_h

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gridfem::testing
{

/// Expects a single text that contains all the parts.
template<class... Parts>
void ExpectOne(const std::vector<std::string>& texts, const Parts&... parts)
{
  const std::vector<std::string> wanted = { std::string(parts)... };
  ASSERT_EQ(texts.size(), 1u) << ::testing::PrintToString(wanted) << " in "
                              << ::testing::PrintToString(texts);
  for (const std::string& part : wanted)
  {
    EXPECT_NE(texts[0].find(part), std::string::npos) << part << " in " << texts[0];
  }
}

} // namespace gridfem::testing

#endif
