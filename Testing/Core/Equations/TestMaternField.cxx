// Samples against the exact covariance: its modes on a sphere, and Matérn's function on a plane.
// Errors of estimates follow from the samples, so tolerances are multiples of standard errors.
#include "Equations/MaternField.h"

#include "Base/Errors.h"
#include "EitherSpace.h"
#include "Largest.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

const double Pi = std::acos(-1.0);

/// @param range  world units
MaternField FieldOn(
  const std::shared_ptr<const FiniteElementSpace>& space, double range, int smoothness)
{
  MaternOptions options;
  options.solve.tolerance = 1e-6;
  options.kappa = std::sqrt(8.0 * smoothness) / range * space->UnitLength();
  options.smoothness = smoothness;
  return MaternField(space, options);
}

/// Samples at the points, a column each.
MultiVector SamplesOf(
  const FiniteElementSpace& space, const MaternField& field, Id samples, std::uint64_t seed = 3)
{
  MultiVector all(space.PointsWithFunctions().size(), samples);
  for (Id first = 0; first < samples; first += 8)
  {
    const FieldSamples some = field.Sample(seed, first, std::min<Id>(8, samples - first));
    EXPECT_TRUE(some.report.converged);
    all.middleCols(first, some.coefficients.cols()) = space.ValuesAtPoints(some.coefficients);
  }
  return all;
}

/// Returns the correlation at the distance range * r.
double Matern(double r, int smoothness)
{
  const double x = std::sqrt(8.0 * smoothness) * r;
  return x == 0.0 ? 1.0
                  : std::pow(x, smoothness) * std::cyl_bessel_k(double(smoothness), x) /
                      (std::pow(2.0, smoothness - 1) * std::tgamma(smoothness));
}

/// The covariance on a sphere of radius 1 at the angle with this cosine, by its series.
double OnSphere(double cosine, double range, int smoothness)
{
  const double kappa2 = 8.0 * smoothness / (range * range);
  double sum = 0.0;
  double legendre = 1.0; // P_l, from P_0
  double before = 0.0;
  for (int l = 0; l < 2000; ++l)
  {
    sum += (2 * l + 1) * smoothness * std::pow(kappa2, smoothness) /
           std::pow(kappa2 + double(l) * (l + 1), smoothness + 1) * legendre;
    const double next = ((2 * l + 1) * cosine * legendre - l * before) / (l + 1);
    before = legendre;
    legendre = next;
  }
  return sum;
}

/// The covariances of all points with one point, without samples.
Eigen::VectorXd CovariancesWith(
  Id point, const std::shared_ptr<const FiniteElementSpace>& space, double range, int smoothness)
{
  const SparseMatrix row = space->RowsAtPoints({ point });
  MultiVector load = MultiVector::Zero(static_cast<Id>(space->NumberOfFunctions(0)), 1);
  for (Id k = row.rowBegin[0]; k < row.rowBegin[1]; ++k)
  {
    load(row.column[k], 0) = row.value[k];
  }
  const FieldSamples found = FieldOn(space, range, smoothness).Covariances(load);
  EXPECT_TRUE(found.report.converged);
  return space->ValuesAtPoints(found.coefficients).col(0);
}

/// The mean of independent numbers, and its standard error.
struct Estimate
{
  explicit Estimate(const Eigen::VectorXd& numbers)
    : mean(numbers.mean()),
      error(std::sqrt((numbers.array() - mean).square().sum()) / double(numbers.size()))
  {
  }
  double mean;
  double error;
};

} // namespace

/// On a sphere of radius 1, the part of degree l has the variance
/// 4π ν κ^(2ν) / (κ² + l (l + 1))^(ν + 1) along each harmonic of norm 1.
TEST(MaternField, HasTheVarianceOfEachDegreeOnASphere)
{
  constexpr Id Samples = 200;
  constexpr double Range = 1.0;
  const TriangleMesh mesh = Transform(GeodesicSphere(12), { 1, 2, 3 }, 0.4);
  const MultiVector p = PointCoordinates(mesh);
  const double areaOfPoint = 4.0 * Pi / double(p.rows());
  const MultiVector harmonics[] = { MultiVector::Ones(p.rows(), 1), p,
    (MultiVector(p.rows(), 3) << p.col(0).cwiseProduct(p.col(1)), p.col(1).cwiseProduct(p.col(2)),
      p.col(2).cwiseProduct(p.col(0)))
      .finished() };
  for (const bool isOnHats : { false, true })
  {
    const std::shared_ptr<const FiniteElementSpace> space = BuildEither(mesh, isOnHats, 5, 1e-2);
    for (const int smoothness : { 1, 2, 3 })
    {
      const double kappa2 = 8.0 * smoothness / (Range * Range);
      const MultiVector samples = SamplesOf(*space, FieldOn(space, Range, smoothness), Samples);
      for (const int degree : { 0, 1, 2 })
      {
        const MultiVector& harmonic = harmonics[degree];
        const Eigen::RowVectorXd norms = harmonic.colwise().norm() * std::sqrt(areaOfPoint);
        const Eigen::MatrixXd parts =
          areaOfPoint * samples.transpose() * harmonic * norms.cwiseInverse().asDiagonal();
        const double exact = 4.0 * Pi * smoothness * std::pow(kappa2, smoothness) /
                             std::pow(kappa2 + degree * (degree + 1), smoothness + 1);
        const double count = double(parts.size());
        EXPECT_NEAR(parts.squaredNorm() / count / exact, 1.0, 4.0 * std::sqrt(2.0 / count) + 0.02)
          << isOnHats << smoothness << degree;
      }
    }
  }
}

/// On components of several sizes, the means of samples have the exact standard deviations.
TEST(MaternField, KnowsTheDeviationOfTheMeanOnEachComponent)
{
  constexpr Id Samples = 200;
  constexpr double Range = 1.5;
  const TriangleMesh sphere = GeodesicSphere(6);
  const auto half = static_cast<Id>(sphere.points.size());
  const TriangleMesh mesh =
    Join(sphere, Transform(sphere, { 1, 2, 3 }, 0.4, 0.25, { 3.0, 0.5, 0.2 }));
  for (const bool isOnHats : { false, true })
  {
    const std::shared_ptr<const FiniteElementSpace> space = BuildEither(mesh, isOnHats, 5, 1e-2);
    for (const int smoothness : { 1, 2, 3 })
    {
      const MaternField field = FieldOn(space, Range, smoothness);
      const std::vector<double> found = field.DeviationsOfMeans();
      const MultiVector samples = SamplesOf(*space, field, Samples);
      ASSERT_EQ(found.size(), 2u);
      for (const bool isSmall : { false, true })
      {
        const double area = SurfaceArea(sphere) * (isSmall ? 0.0625 : 1.0);
        const double exact = Range * std::sqrt(0.5 * Pi / area); // the same for each smoothness
        const double same =
          std::min(std::abs(found[0] / exact - 1.0), std::abs(found[1] / exact - 1.0));
        EXPECT_LT(same, 1e-6) << isOnHats << smoothness << isSmall;
        const Eigen::RowVectorXd means =
          samples.middleRows(isSmall ? half : 0, half).colwise().mean();
        EXPECT_NEAR(std::sqrt(means.squaredNorm() / Samples) / exact, 1.0,
          4.0 / std::sqrt(2.0 * Samples) + 0.01);
      }
    }
  }
}

/// Covariances with a point, at all points up to two ranges away, to 2 % of the variance.
TEST(MaternField, HasTheExactCovariancesOnAPlaneAndASphere)
{
  constexpr double Range = 0.2;
  const TriangleMesh plane = Transform(FlatRectangle(96, 96), { 1, 2, 3 }, 0.3);
  constexpr Id Middle = 48 * 97 + 48;
  const TriangleMesh sphere = Transform(GeodesicSphere(48), { 1, 2, 3 }, 0.4);
  for (const bool isOnHats : { false, true })
  {
    const std::shared_ptr<const FiniteElementSpace> ofPlane = BuildEither(plane, isOnHats, 7, 1e-2);
    const std::shared_ptr<const FiniteElementSpace> ofSphere =
      BuildEither(sphere, isOnHats, 7, 1e-2);
    for (const int smoothness : { 1, 2, 3 })
    {
      const Eigen::VectorXd onPlane = CovariancesWith(Middle, ofPlane, Range, smoothness);
      const Eigen::VectorXd onSphere = CovariancesWith(7, ofSphere, 2.5 * Range, smoothness);
      double error = 0.0;
      for (Id k = 0; k < onPlane.size(); ++k)
      {
        const double r = (plane.points[k] - plane.points[Middle]).norm() / Range;
        error = Larger(error, r < 2.0 ? std::abs(onPlane[k] - Matern(r, smoothness)) : 0.0);
      }
      EXPECT_LT(error, 0.02) << "plane " << isOnHats << smoothness;
      error = 0.0;
      for (Id k = 0; k < onSphere.size(); ++k)
      {
        const double cosine = std::min(sphere.points[k].dot(sphere.points[7]), 1.0);
        const double exact = OnSphere(cosine, 2.5 * Range, smoothness);
        error = Larger(error, std::abs(onSphere[k] - exact));
      }
      EXPECT_LT(error, 0.02) << "sphere " << isOnHats << smoothness;
    }
  }
}

/// The covariance at several distances, far from the boundary of a square.
TEST(MaternField, HasTheCovarianceOfMaternOnAPlane)
{
  constexpr Id Samples = 240;
  constexpr int N = 64;
  constexpr double Range = 0.125; // eight cells
  const TriangleMesh mesh = Transform(FlatRectangle(N, N), { 1, 2, 3 }, 0.3);
  for (const bool isOnHats : { false, true })
  {
    const std::shared_ptr<const FiniteElementSpace> space = BuildEither(mesh, isOnHats, 6, 1e-2);
    for (const int smoothness : { 1, 2, 3 })
    {
      const MultiVector samples = SamplesOf(*space, FieldOn(space, Range, smoothness), Samples);
      for (const int steps : { 0, 4, 8 })
      {
        // The mean over points and both axes, for each sample.
        Eigen::VectorXd products = Eigen::VectorXd::Zero(Samples);
        int count = 0;
        for (int j = N / 4; j < N - N / 4; ++j)
        {
          for (int i = N / 4; i < N - N / 4; ++i, count += 2)
          {
            const auto at = [&](int x, int y) { return samples.row(y * (N + 1) + x).array(); };
            products.array() += (at(i, j) * (at(i + steps, j) + at(i, j + steps))).transpose();
          }
        }
        const Estimate found(products / count);
        EXPECT_LT(found.error, 0.03);
        EXPECT_NEAR(
          found.mean, Matern(double(steps) / N / Range, smoothness), 4.0 * found.error + 0.02)
          << isOnHats << smoothness << " " << steps;
      }
    }
  }
}

/// Natural boundaries reflect the field, so the variance is twice as large on an edge.
TEST(MaternField, HasTwiceTheVarianceOnABoundary)
{
  constexpr Id Samples = 200;
  constexpr int N = 48;
  const std::shared_ptr<const FiniteElementSpace> space =
    BuildEither(FlatRectangle(N, N), true, 5, 1e-2);
  const MultiVector samples = SamplesOf(*space, FieldOn(space, 0.2, 2), Samples);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(Samples);
  for (int i = N / 4; i <= N - N / 4; ++i)
  {
    squares += samples.row(i).cwiseAbs2().transpose() / (N / 2 + 1);
  }
  const Estimate found(squares);
  EXPECT_LT(found.error, 0.15);
  EXPECT_NEAR(found.mean, 2.0, 4.0 * found.error + 0.04);
}

TEST(MaternField, GivesTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = GeodesicSphere(10);
  for (const bool isOnHats : { false, true })
  {
    for (const int smoothness : { 1, 2, 3 })
    {
      const auto sample = [&](int threads)
      {
        MaternOptions options;
        options.smoothness = smoothness;
        options.kappa = 0.3;
        options.multigrid.threads = threads;
        const MaternField field(BuildEither(mesh, isOnHats, 5, 1e-2, threads), options, threads);
        return field.Sample(1, 2, 3, threads).coefficients;
      };
      EXPECT_EQ(sample(1), sample(3)) << isOnHats << smoothness;
    }
  }
}

TEST(MaternField, RefusesOptionsOutOfRange)
{
  const std::shared_ptr<const FiniteElementSpace> space =
    BuildEither(GeodesicSphere(4), false, 3, 1e-2);
  for (const double kappa : { 0.0, -1.0, std::nan(""), double(INFINITY) })
  {
    MaternOptions options;
    options.kappa = kappa;
    EXPECT_THROW(MaternField(space, options), InvalidInput);
  }
  for (const int smoothness : { 0, 4 })
  {
    MaternOptions options;
    options.smoothness = smoothness;
    EXPECT_THROW(MaternField(space, options), InvalidInput);
  }
}
