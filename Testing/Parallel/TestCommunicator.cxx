// A failure of one rank reaches the other ranks where they wait for it.
#include "Parallel/Communicator.h"

#include <gtest/gtest.h>

#include <stdexcept>

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
