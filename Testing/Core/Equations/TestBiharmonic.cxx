// Biharmonic functions through many points, found by iteration, against functions found directly.
#include "Equations/HarmonicInterpolation.h"
#include "Largest.h"

#include "EitherSpace.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

double Smooth(const Vec3& p)
{
  return std::sin(2.0 * p[0]) + p[1] * p[2];
}

MultiVector ValuesAt(const TriangleMesh& mesh, const std::vector<Id>& points)
{
  MultiVector values(static_cast<Id>(points.size()), 2);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const double value = Smooth(mesh.points[points[k]]);
    values.row(static_cast<Id>(k)) << value, 1e3 - value;
  }
  return values;
}

ConstrainedSolution Interpolate(const FiniteElementSpace& space, const std::vector<Id>& points,
  const MultiVector& values, Id mostAtOnce, int threads = 0)
{
  InterpolationOptions options;
  options.smoothness = Smoothness::Biharmonic;
  options.mostAtOnce = mostAtOnce;
  options.multigrid.threads = threads;
  options.solve.tolerance = 1e-9;
  ConstrainedSolution solution =
    InterpolateHarmonically(space, space.RowsAtPoints(points), values, options);
  EXPECT_TRUE(solution.report.converged);
  return solution;
}

double LargestDifference(
  const FiniteElementSpace& space, const MultiVector& a, const MultiVector& b)
{
  return (space.ValuesAtPoints(a) - space.ValuesAtPoints(b))
    .cwiseAbs()
    .maxCoeff<Eigen::PropagateNaN>();
}

} // namespace

/// Dense points and points far apart, in several columns.
TEST(Biharmonic, ByIterationIsThatFoundAtOnce)
{
  const TriangleMesh sphere = GeodesicSphere(16);
  const TriangleMesh flat = Transform(FlatRectangle(30, 20, 3.0, 2.0), { 1, 2, 3 }, 0.5);
  for (const bool isOnHats : { false, true })
  {
    for (const TriangleMesh& mesh : { sphere, flat })
    {
      // Points denser than the functions would contradict each other.
      const auto space = BuildEither(mesh, isOnHats, isOnHats ? 4 : 5, 1e-2);
      std::vector<Id> points = EveryPoint(mesh, 60);
      for (Id i = 0; i < 12; ++i)
      {
        points.push_back(i + 1); // a cluster
      }
      const MultiVector values = ValuesAt(mesh, points);
      const ConstrainedSolution direct = Interpolate(*space, points, values, 1000);
      const ConstrainedSolution iterated = Interpolate(*space, points, values, 0);
      EXPECT_TRUE(iterated.isExact);
      // The multipliers are found to 1e-5; the range is about 2.
      EXPECT_LT(LargestDifference(*space, direct.coefficients, iterated.coefficients), 2e-5);
    }
  }
}

TEST(Biharmonic, MeetsManyValuesInStepsThatDoNotGrowWithTheirNumber)
{
  const TriangleMesh mesh = GeodesicSphere(20);
  for (const bool isOnHats : { false, true })
  {
    const auto space = BuildEither(mesh, isOnHats, 5, 1e-2);
    for (const Id stride : { 20, 6 })
    {
      const std::vector<Id> points = EveryPoint(mesh, stride);
      const ConstrainedSolution found = Interpolate(*space, points, ValuesAt(mesh, points), 0);
      EXPECT_TRUE(found.isExact);
      EXPECT_LT(found.relativeMisfit, 1e-6);
      EXPECT_LT(found.report.iterations, 45) << stride << " " << isOnHats;
      const MultiVector atPoints = space->ValuesAtPoints(found.coefficients);
      double largest = 0.0;
      for (Id i = 0; i < atPoints.rows(); ++i)
      {
        largest = Larger(largest, std::abs(atPoints(i, 0) - Smooth(mesh.points[i])));
      }
      EXPECT_LT(largest, stride > 10 ? 0.07 : 0.02) << stride; // of a range of 2.6: it is smooth
    }
  }
}

TEST(Biharmonic, EndsEarlierForALargerToleranceAndSaysWhichItWanted)
{
  const TriangleMesh mesh = GeodesicSphere(20);
  const auto space = BuildEither(mesh, true, 4, 1e-2);
  const std::vector<Id> points = EveryPoint(mesh, 6);
  const SparseMatrix rows = space->RowsAtPoints(points);
  InterpolationOptions options;
  options.smoothness = Smoothness::Biharmonic;
  options.mostAtOnce = 0;
  options.solve.tolerance = 1e-6;
  const auto fine = InterpolateHarmonically(*space, rows, ValuesAt(mesh, points), options);
  options.solve.tolerance = 1e-2;
  const auto coarse = InterpolateHarmonically(*space, rows, ValuesAt(mesh, points), options);
  EXPECT_TRUE(fine.report.converged);
  EXPECT_TRUE(coarse.report.converged);
  EXPECT_EQ(fine.wanted, 1e-5);
  EXPECT_EQ(coarse.wanted, 1e-2);
  EXPECT_LT(coarse.report.iterations, fine.report.iterations);
  EXPECT_LT(coarse.relativeMisfit, 1e-6);
}

/// Two values at each of some points: the solution meets the mean of both, and sets the flag.
TEST(Biharmonic, MeetsValuesThatContradictEachOtherInTheMean)
{
  const TriangleMesh mesh = GeodesicSphere(12);
  const auto space = BuildEither(mesh, true, 4, 1e-2);
  std::vector<Id> points = EveryPoint(mesh, 8);
  const MultiVector mean = ValuesAt(mesh, points);
  const std::size_t count = points.size();
  points.insert(points.end(), points.begin(), points.begin() + 5);
  MultiVector values(static_cast<Id>(points.size()), 2);
  values.topRows(mean.rows()) = mean;
  values.bottomRows(5) = mean.topRows(5).array() + 0.1;
  values.topRows(5).array() -= 0.1;
  const ConstrainedSolution found = Interpolate(*space, points, values, 0);
  EXPECT_FALSE(found.isExact);
  EXPECT_NEAR(found.misfit, 0.1, 1e-3);
  points.resize(count);
  const ConstrainedSolution expected = Interpolate(*space, points, mean, 0);
  EXPECT_LT(LargestDifference(*space, found.coefficients, expected.coefficients), 1e-3);
}

/// With any limit of the iterations the values are met, or the report says that they may not be.
TEST(Biharmonic, HasConvergedOnlyWhereTheValuesAreMet)
{
  const TriangleMesh mesh = GeodesicSphere(12);
  for (const bool isOnHats : { false, true })
  {
    const auto space = BuildEither(mesh, isOnHats, isOnHats ? 4 : 5, 1e-2);
    const std::vector<Id> points = EveryPoint(mesh, 5);
    const MultiVector values = ValuesAt(mesh, points);
    const SparseMatrix rows = space->RowsAtPoints(points);
    for (const double tolerance : { 1e-1, 1e-2, 1e-6 })
    {
      for (const int limit : { 1, 3, 5, 8, 80 })
      {
        InterpolationOptions options;
        options.smoothness = Smoothness::Biharmonic;
        options.mostAtOnce = 0;
        options.solve.tolerance = tolerance;
        options.solve.maximumIterations = limit;
        const ConstrainedSolution found = InterpolateHarmonically(*space, rows, values, options);
        EXPECT_TRUE(limit > 1 || !found.report.converged) << tolerance;
        EXPECT_TRUE(limit < 80 || found.report.converged) << tolerance;
        if (found.report.converged)
        {
          EXPECT_LT(found.relativeMisfit, 1e-5) << tolerance << " " << limit;
        }
        else
        {
          EXPECT_EQ(found.report.end, SolveEnd::IterationLimit) << tolerance << " " << limit;
        }
      }
    }
  }
}

TEST(Biharmonic, IsNaNOnComponentsWithoutAPoint)
{
  const TriangleMesh sphere = GeodesicSphere(10);
  const TriangleMesh mesh = Join(sphere, Transform(sphere, { 1, 0, 0 }, 0.0, 1.0, { 5, 0, 0 }));
  for (const bool isOnHats : { false, true })
  {
    const auto space = BuildEither(mesh, isOnHats, 5, 1e-2);
    const std::vector<Id> points = EveryPoint(sphere, 4);
    const ConstrainedSolution found = Interpolate(*space, points, ValuesAt(mesh, points), 0);
    const MultiVector atPoints = space->ValuesAtPoints(found.coefficients);
    for (Id i = 0; i < atPoints.rows(); ++i)
    {
      ASSERT_EQ(std::isnan(atPoints(i, 0)), mesh.points[i][0] > 2.0) << i;
    }
  }
}

TEST(Biharmonic, IsTheSameBitForBitWithAnyNumberOfThreads)
{
  const TriangleMesh mesh = GeodesicSphere(12);
  for (const bool isOnHats : { false, true })
  {
    const auto space = BuildEither(mesh, isOnHats, 4, 1e-2);
    const std::vector<Id> points = EveryPoint(mesh, 5);
    const MultiVector values = ValuesAt(mesh, points);
    EXPECT_EQ(Interpolate(*space, points, values, 0, 1).coefficients,
      Interpolate(*space, points, values, 0, 3).coefficients);
  }
}
