// Tests when an iteration counts as too slow, and when as a standstill.
#include "Krylov/Stagnation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// The measures 1, q, q², ... of the start and of this number of iterations.
Stagnation AfterIterations(int iterations, double q, double tolerance, int maximumIterations)
{
  Stagnation stagnation(tolerance, maximumIterations);
  for (int i = 0; i <= iterations; ++i)
  {
    stagnation.Add(std::pow(q, i));
  }
  return stagnation;
}

TEST(Stagnation, IsTooSlowWhenThePaceDoesNotLeadToTheTolerance)
{
  // After n iterations the measure is qⁿ.
  for (const int maximum : { 30, 100, 1000 })
  {
    const double needed = std::pow(1e-6, 1.0 / maximum);
    const int patience =
      std::max(Stagnation::PaceWindow, std::min(Stagnation::Patience, maximum / 2));
    for (const int iterations : { patience, patience + 7 })
    {
      EXPECT_TRUE(AfterIterations(iterations, needed * 1.0001, 1e-6, maximum).IsTooSlow());
      EXPECT_FALSE(AfterIterations(iterations, needed * 0.9999, 1e-6, maximum).IsTooSlow());
    }
  }
}

TEST(Stagnation, TakesItsTime)
{
  EXPECT_FALSE(AfterIterations(Stagnation::PaceWindow - 1, 1.0, 1e-6, 30).IsTooSlow());
  EXPECT_TRUE(AfterIterations(Stagnation::PaceWindow, 1.0, 1e-6, 30).IsTooSlow());
  EXPECT_FALSE(AfterIterations(Stagnation::Patience - 1, 1.0, 1e-6, 1000).IsTooSlow());
  EXPECT_TRUE(AfterIterations(Stagnation::Patience, 1.0, 1e-6, 1000).IsTooSlow());
  EXPECT_FALSE(AfterIterations(Stagnation::StandstillWindow - 1, 1.0, 1e-6, 100).IsAtStandstill());
  EXPECT_TRUE(AfterIterations(Stagnation::StandstillWindow, 1.0, 1e-6, 100).IsAtStandstill());
}

TEST(Stagnation, SaysNothingWhenNoIterationsAreLeft)
{
  EXPECT_TRUE(AfterIterations(29, 1.0, 1e-6, 30).IsTooSlow());
  EXPECT_FALSE(AfterIterations(30, 1.0, 1e-6, 30).IsTooSlow());
}

TEST(Stagnation, LooksAtTheLastIterationsAlone)
{
  // One falls fast to 1e-4, then no further. The other does the opposite.
  Stagnation stalls(1e-6, 200);
  Stagnation accelerates(1e-6, 200);
  for (int i = 0; i <= 60; ++i)
  {
    stalls.Add(std::max(1e-4, std::pow(0.5, i)));
    accelerates.Add(std::min(1.0, std::pow(0.9, i - 30)));
  }
  EXPECT_TRUE(stalls.IsTooSlow());
  EXPECT_FALSE(accelerates.IsTooSlow());
  EXPECT_FALSE(stalls.IsAtStandstill());
}

TEST(Stagnation, CountsTheLowestMeasure)
{
  // It goes up and down by a factor of 100, like conjugate gradients, and falls to a tenth every
  // ten iterations.
  Stagnation wild(1e-6, 100);
  for (int i = 0; i <= 60; ++i)
  {
    wild.Add(std::pow(10.0, -i / 10.0) * (i % 3 == 0 ? 1.0 : 100.0));
  }
  EXPECT_FALSE(wild.IsTooSlow());
  EXPECT_FALSE(wild.IsAtStandstill());
}

TEST(Stagnation, NoNumberIsNoProgress)
{
  Stagnation broken(1e-6, 100);
  broken.Add(1.0);
  for (int i = 0; i < Stagnation::StandstillWindow; ++i)
  {
    broken.Add(NaN);
  }
  EXPECT_TRUE(broken.IsTooSlow());
  EXPECT_TRUE(broken.IsAtStandstill());
}

} // namespace
} // namespace gridfem
