// Tests means over components: their values, and that the number of threads changes no bit.
#include "Algebra/ComponentMeans.h"
#include "SampledHierarchy.h"

#include <gtest/gtest.h>

namespace gridfem
{
namespace
{

using testing::RandomValues;

/// Functions of `components` components in turn. The last component has no area.
struct Functions
{
  std::vector<Index> component;
  std::vector<double> integral;
  Index components;

  Functions(Index count, Index numberOfComponents) : components(numberOfComponents)
  {
    const MultiVector random = RandomValues(count, 1, 7);
    for (Index i = 0; i < count; ++i)
    {
      component.push_back((i * 7) % components);
      integral.push_back(component.back() + 1 == components ? 0.0 : 1.5 + random(i, 0));
    }
  }

  ComponentMeans Means(int threads) const { return { component, integral, components, threads }; }
};

/// Enough functions for two threads, and columns in chunks of all sizes.
class Means : public ::testing::TestWithParam<int>
{
protected:
  const Functions few{ 60000, 3 };
  const Functions many{ 60000, 20000 };
};

TEST_P(Means, ThreadsDoNotChangeABit)
{
  for (const Functions& functions : { few, many })
  {
    const MultiVector x = RandomValues(60000, GetParam());
    const auto removed = [&](int threads)
    {
      const ComponentMeans means = functions.Means(threads);
      MultiVector y = x;
      means.AddConstants(-means.OfFunction(y), y);
      means.SubtractIntegrals(means.OfIntegrals(y), y);
      return y;
    };
    const MultiVector one = removed(1);
    EXPECT_EQ(one, removed(2));
    EXPECT_EQ(one, removed(3));
  }
}

TEST_P(Means, OfConstantsAreTheConstants)
{
  for (const Functions& functions : { few, many })
  {
    const ComponentMeans means = functions.Means(2);
    MultiVector constants = RandomValues(functions.components, GetParam());
    MultiVector x = MultiVector::Zero(60000, GetParam());
    means.AddConstants(constants, x);
    constants.bottomRows(1).setZero(); // no area, no mean
    // Each value is a sum of up to 20,000 numbers.
    EXPECT_LT((means.OfFunction(x) - constants).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);
    MultiVector load = MultiVector::Zero(60000, GetParam());
    means.SubtractIntegrals(-constants, load);
    EXPECT_LT(
      (means.OfIntegrals(load) - constants).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Columns, Means, ::testing::Values(2, 3, 13));

} // namespace
} // namespace gridfem
