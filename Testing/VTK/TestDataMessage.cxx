// A message between ranks gives back what was put in, or is refused.
#include "Pieces/DataMessage.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>

using namespace gridfem;

TEST(DataMessage, GivesBackWhatWasPutIn)
{
  DataMessage message;
  message.Put(true);
  message.Put(-7.25);
  message.Put(false);
  message.Put(std::int64_t{ 1 } << 40);
  message.PutText("names");
  DataMessage taken(message.Release());
  EXPECT_TRUE(taken.Take<bool>());
  EXPECT_EQ(taken.Take<double>(), -7.25);
  EXPECT_FALSE(taken.Take<bool>());
  EXPECT_EQ(taken.Take<std::int64_t>(), std::int64_t{ 1 } << 40);
  EXPECT_EQ(taken.TakeText(), "names");
  EXPECT_THROW(taken.Take<bool>(), std::runtime_error);
}

/// To load another byte as a bool is undefined: both branches of a condition could run.
TEST(DataMessage, OnlyTwoBytesAreABool)
{
  for (int byte = 0; byte < 256; ++byte)
  {
    DataMessage message(Bytes{ static_cast<char>(byte) });
    if (byte < 2)
    {
      EXPECT_EQ(message.Take<bool>(), byte == 1);
      continue;
    }
    try
    {
      message.Take<bool>();
      ADD_FAILURE() << byte;
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_NE(std::string(error.what()).find("has " + std::to_string(byte)), std::string::npos);
    }
  }
}
