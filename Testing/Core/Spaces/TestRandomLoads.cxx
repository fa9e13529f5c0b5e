// Random loads have the covariance of a matrix, on both kinds of space.
#include "Spaces/RandomLoads.h"

#include "Base/NormalNumbers.h"
#include "EitherSpace.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int Samples = 4000;

std::shared_ptr<const FiniteElementSpace> Build(bool isOnHats, int threads = 0)
{
  return BuildEither(
    Transform(Torus(12, 8, 1.0, 0.4), { 1, 2, 3 }, 0.4), isOnHats, 3, 1e-2, threads);
}

} // namespace

/// Mean, variance, fourth moment and correlation of neighbors, each within five standard errors.
TEST(RandomLoads, NumbersAreNormal)
{
  constexpr int Pairs = 50000;
  const double error = 5.0 / std::sqrt(2.0 * Pairs);
  for (const std::uint64_t seed : { 0U, 1U, 77U })
  {
    for (const std::uint64_t series : { 0U, 1U, 12U })
    {
      const NormalNumbers numbers(seed, series);
      const NormalNumbers next(seed, series + 1);
      double moment[3] = {};
      double product[2] = {};
      for (int k = 0; k < Pairs; ++k)
      {
        const std::array<double, 2> pair = numbers.Pair(k);
        for (const double x : pair)
        {
          moment[0] += x / (2.0 * Pairs);
          moment[1] += x * x / (2.0 * Pairs);
          moment[2] += std::pow(x, 4) / (2.0 * Pairs);
        }
        product[0] += pair[0] * pair[1] / Pairs;
        product[1] += pair[0] * next.Pair(k)[0] / Pairs;
      }
      EXPECT_NEAR(moment[0], 0.0, error);
      EXPECT_NEAR(moment[1], 1.0, std::sqrt(2.0) * error);
      EXPECT_NEAR(moment[2], 3.0, std::sqrt(96.0) * error);
      EXPECT_NEAR(product[0], 0.0, std::sqrt(2.0) * error);
      EXPECT_NEAR(product[1], 0.0, std::sqrt(2.0) * error);
    }
  }
}

/// The variance of xᵀw is xᵀ A x, for smooth and rough x.
TEST(RandomLoads, HaveTheCovarianceOfTheMatrix)
{
  for (const bool isOnHats : { false, true })
  {
    const auto space = Build(isOnHats);
    MultiVector x = RandomValues(space->NumberOfFunctions(0), 4);
    x.col(0).setOnes();
    x.col(1).setZero();
    x(7, 1) = 1.0; // the diagonal
    for (const auto& [a, b] : { std::pair(1.0, 0.0), std::pair(0.3, 1.0), std::pair(0.0, 1.0) })
    {
      const SparseMatrix A = space->Matrix(0, a, b);
      MultiVector Ax;
      Multiply(A, x, Ax);
      const MultiVector loads = RandomLoads(*space, a, b, 5, 0, Samples);
      ASSERT_EQ(loads.cols(), Samples);
      for (Id c = 0; c < x.cols(); ++c)
      {
        const Eigen::VectorXd sums = loads.transpose() * x.col(c);
        const double exact = std::max(0.0, x.col(c).dot(Ax.col(c))); // rounding may be negative
        const double size = (a + b) * x.col(c).squaredNorm();
        EXPECT_NEAR(
          sums.squaredNorm() / Samples, exact, 5.0 * std::sqrt(2.0 / Samples) * exact + 1e-9 * size)
          << isOnHats << a << b << c;
        EXPECT_NEAR(sums.mean(), 0.0, 5.0 * std::sqrt(exact / Samples) + 1e-6 * std::sqrt(size));
      }
    }
  }
}

TEST(RandomLoads, DependOnSeedAndNumberOfTheSampleAlone)
{
  for (const bool isOnHats : { false, true })
  {
    const auto space = Build(isOnHats);
    const MultiVector all = RandomLoads(*space, 1.0, 0.5, 9, 0, 11, 1);
    EXPECT_EQ(all, RandomLoads(*space, 1.0, 0.5, 9, 0, 11, 3));
    const MultiVector some = RandomLoads(*space, 1.0, 0.5, 9, 3, 5, 2);
    EXPECT_LT((some - all.middleCols(3, 5)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);
    const MultiVector other = RandomLoads(*space, 1.0, 0.5, 10, 0, 11);
    EXPECT_GT((other - all).norm(), all.norm());
  }
}

/// Another order of triangles and points gives the same sample, up to rounding. Pivots below 1e-12
/// of their diagonal count as 0, so rounding can change a root by 1e-6. Another first corner of a
/// triangle would be another quadrature.
TEST(RandomLoads, DoNotDependOnTheOrderOfTheMesh)
{
  const TriangleMesh mesh = Transform(Torus(12, 8, 1.0, 0.4), { 1, 2, 3 }, 0.4);
  const auto last = static_cast<Id>(mesh.points.size()) - 1;
  TriangleMesh other = mesh;
  std::reverse(other.points.begin(), other.points.end());
  std::reverse(other.triangles.begin(), other.triangles.end());
  for (auto& triangle : other.triangles)
  {
    triangle = { last - triangle[0], last - triangle[1], last - triangle[2] };
  }
  for (const bool isOnHats : { false, true })
  {
    MultiVector loads[2];
    for (const int k : { 0, 1 })
    {
      const auto space = BuildEither(k == 0 ? mesh : other, isOnHats, 3, 1e-2);
      loads[k] = RandomLoads(*space, 0.3, 1.0, 4, 0, 3);
    }
    ASSERT_EQ(loads[0].rows(), loads[1].rows());
    const double largest = loads[0].cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    EXPECT_LT((loads[0] - loads[1]).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-6 * largest)
      << isOnHats;
  }
}
