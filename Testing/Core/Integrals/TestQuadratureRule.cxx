// Tests that rules are exact on every monomial of their degree, with positive weights at inner
// points.
#include "Integrals/QuadratureRule.h"
#include "Largest.h"

#include "Base/Errors.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;

namespace
{

/// Returns ∫ λ0^i λ1^j λ2^k over a triangle, divided by its area: 2 i! j! k! / (i + j + k + 2)!
double ExactMoment(int i, int j, int k)
{
  return 2.0 * std::tgamma(i + 1.0) * std::tgamma(j + 1.0) * std::tgamma(k + 1.0) /
         std::tgamma(i + j + k + 3.0);
}

double Moment(const QuadratureRule& rule, int i, int j, int k)
{
  double sum = 0.0;
  for (const auto& point : rule.points)
  {
    sum += point.weight * std::pow(point.barycentric[0], i) * std::pow(point.barycentric[1], j) *
           std::pow(point.barycentric[2], k);
  }
  return sum;
}

class TriangleRules : public ::testing::TestWithParam<int>
{
};

} // namespace

TEST_P(TriangleRules, AreExactOnAllMonomialsOfTheirDegree)
{
  const QuadratureRule& rule = TriangleRule(GetParam());
  ASSERT_EQ(rule.degree, GetParam());
  for (int i = 0; i <= rule.degree; ++i)
  {
    for (int j = 0; i + j <= rule.degree; ++j)
    {
      for (int k = 0; i + j + k <= rule.degree; ++k)
      {
        // At most 33 positive terms have a sum of at most 1, so rounding stays below 1e-14.
        EXPECT_NEAR(Moment(rule, i, j, k), ExactMoment(i, j, k), 1e-14) << i << j << k;
      }
    }
  }
}

TEST_P(TriangleRules, AreNotExactBeyondTheirDegree)
{
  // The degree is exact and no higher, so that the test above cannot pass by accident.
  const QuadratureRule& rule = TriangleRule(GetParam());
  double worst = 0.0;
  for (int i = 0; i <= rule.degree + 1; ++i)
  {
    const double error =
      Moment(rule, i, rule.degree + 1 - i, 0) - ExactMoment(i, rule.degree + 1 - i, 0);
    worst = gridfem::testing::Larger(worst, std::abs(error));
  }
  EXPECT_GT(worst, 1e-9);
}

TEST_P(TriangleRules, HavePositiveWeightsAtInnerPoints)
{
  for (const auto& point : TriangleRule(GetParam()).points)
  {
    EXPECT_GT(point.weight, 0.0);
    double sum = 0.0;
    for (const double lambda : point.barycentric)
    {
      EXPECT_GT(lambda, 0.0);
      sum += lambda;
    }
    EXPECT_NEAR(sum, 1.0, 4e-16); // three additions of numbers below 1
  }
}

INSTANTIATE_TEST_SUITE_P(AllDegrees, TriangleRules, ::testing::Values(2, 4, 6, 10, 12));

TEST(TriangleRule, HasTheKnownNumbersOfPoints)
{
  EXPECT_EQ(TriangleRule(2).points.size(), 3u);
  EXPECT_EQ(TriangleRule(4).points.size(), 6u);
  EXPECT_EQ(TriangleRule(6).points.size(), 12u);
  EXPECT_EQ(TriangleRule(10).points.size(), 25u);
  EXPECT_EQ(TriangleRule(12).points.size(), 33u);
}

TEST(TriangleRule, OfDegreeTwoIsTheThesisOne)
{
  for (const auto& point : TriangleRule(2).points)
  {
    EXPECT_DOUBLE_EQ(
      *std::max_element(point.barycentric.begin(), point.barycentric.end()), 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(point.weight, 1.0 / 3.0);
  }
}

TEST(TriangleRule, RefusesOtherDegrees)
{
  EXPECT_THROW(TriangleRule(3), InvalidInput);
  EXPECT_THROW(TriangleRule(0), InvalidInput);
  EXPECT_THROW(TriangleRule(-2), InvalidInput);
}
