// A failure of one rank reaches the other ranks where they wait for it. Messages of another size
// than expected, or beyond the counts of MPI, are refused by all.
#include "Parallel/Communicator.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

using namespace gridfem;

TEST(Communicator, WhatOneRankThrowsAloneIsThrownWhereOthersWait)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const int failing = ranks.Size() - 1;
  const auto fail = [&](const auto& wait)
  {
    try
    {
      ranks.Guard(
        [&]
        {
          if (ranks.Rank() == failing)
          {
            throw std::runtime_error("nothing is left");
          }
          wait();
        });
      ADD_FAILURE() << "nothing was thrown";
    }
    catch (const RankFailure& failure)
    {
      EXPECT_EQ(failure.rank, failing);
      EXPECT_STREQ(failure.what(), "nothing is left");
    }
  };
  double value = 0.0;
  fail([] {}); // at the end
  fail([&] { ranks.Sum(&value, 1); });
  fail([&] { ranks.Maximum(&value, 1); });
  fail([&] { ranks.ShareOf(1); });
  fail([&] { ranks.Gather(std::vector<Id>(3)); });
  fail([&] { ranks.Exchange(std::vector<std::vector<Id>>(ranks.Size())); });
  fail([&] { ranks.SumOfMachine(1.0); });
  fail([&] { ranks.Together([] {}); });
}

TEST(Communicator, AnotherNumberOfItemsThanExpectedIsRefusedByAll)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const int odd = ranks.Size() - 1;
  std::vector<std::vector<int>> messages(ranks.Size(), std::vector<int>(5, ranks.Rank()));
  const std::vector<Id> five(ranks.Size(), 5);
  EXPECT_EQ(ranks.Exchange(messages, five).at(odd), std::vector<int>(5, odd));
  for (const std::size_t other : { std::size_t{ 0 }, std::size_t{ 4 }, std::size_t{ 6 } })
  {
    if (ranks.Rank() == odd)
    {
      messages.front().resize(other);
    }
    try
    {
      ranks.Exchange(messages, five);
      ADD_FAILURE() << other << " items were taken for five";
    }
    catch (const RankFailure& failure)
    {
      EXPECT_EQ(failure.rank, 0); // which gets that message
      EXPECT_EQ(std::string(failure.what()), "Rank " + std::to_string(odd) + " has sent " +
                                               std::to_string(other) +
                                               " items, but 5 are expected.");
    }
  }
  EXPECT_EQ(ranks.Exchange(messages).size(), static_cast<std::size_t>(ranks.Size()));
}

TEST(Communicator, PlacesOutsideAListAreRefused)
{
  EXPECT_NO_THROW(RequirePlace(0, 1));
  EXPECT_NO_THROW(RequirePlace(6, 7));
  EXPECT_THROW(RequirePlace(7, 7), std::out_of_range);
  EXPECT_THROW(RequirePlace(-1, 7), std::out_of_range);
  EXPECT_THROW(RequirePlace(0, 0), std::out_of_range);
}

TEST(Communicator, CountsBeyond32BitsAreRefusedNotCut)
{
  const Communicator ranks(MPI_COMM_WORLD);
  constexpr Id Most = std::numeric_limits<int>::max();
  for (const Id count : { Most + 1, 2 * Most + 2, 2 * Most + 3 }) // cut: negative, none and one
  {
    double doubles = 7.0; // nothing may be read behind it
    float floats = 7.0F;
    EXPECT_THROW(ranks.Sum(&doubles, count), InvalidInput) << count;
    EXPECT_THROW(ranks.Sum(&floats, count), InvalidInput) << count;
    EXPECT_THROW(ranks.Minimum(&doubles, count), InvalidInput) << count;
    EXPECT_THROW(ranks.Maximum(&doubles, count), InvalidInput) << count;
    EXPECT_EQ(doubles, 7.0);
    EXPECT_EQ(floats, 7.0F);
  }
}
