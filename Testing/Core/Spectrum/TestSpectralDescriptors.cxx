// Signatures, distances and filters on exact modes: the spherical harmonics up to degree 2 at the
// points of the unit sphere. Their squares add up to (2l + 1) / 4π, and their products to Legendre
// polynomials. Every result is therefore known in closed form.
#include "Base/Errors.h"
#include "Largest.h"
#include "Meshes.h"
#include "Spectrum/SpectralDescriptors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

constexpr double Pi = 3.14159265358979323846;

/// Rounding of a sum of nine terms.
constexpr double Rounding = 1e-13;

PointModes SphericalHarmonics(const TriangleMesh& sphere)
{
  PointModes modes;
  modes.eigenvalues = { 0, 2, 2, 2, 6, 6, 6, 6, 6 };
  modes.area = 4 * Pi;
  modes.values.resize(sphere.points.size(), 9);
  for (std::size_t k = 0; k < sphere.points.size(); ++k)
  {
    const double x = sphere.points[k][0];
    const double y = sphere.points[k][1];
    const double z = sphere.points[k][2];
    modes.values.row(k) << 1, std::sqrt(3) * x, std::sqrt(3) * y, std::sqrt(3) * z,
      std::sqrt(15) * x * y, std::sqrt(15) * y * z, std::sqrt(15) * x * z,
      std::sqrt(15) / 2 * (x * x - y * y), std::sqrt(5) / 2 * (3 * z * z - 1);
  }
  modes.values /= std::sqrt(4 * Pi);
  return modes;
}

/// The modes on a sphere of another radius.
PointModes Scaled(PointModes modes, double radius)
{
  for (double& value : modes.eigenvalues)
  {
    value /= radius * radius;
  }
  modes.values /= radius;
  modes.area *= radius * radius;
  return modes;
}

class ModeSums : public ::testing::Test
{
protected:
  TriangleMesh mesh = GeodesicSphere(6);
  PointModes modes = SphericalHarmonics(mesh);
};

TEST_F(ModeSums, HeatKernelOfASphereIsItsSeries)
{
  const std::vector<double> times = { 0.0, 0.1, 1.0, 100.0 };
  const MultiVector signature = HeatKernelSignature(modes, times);
  ASSERT_EQ(signature.rows(), Id(mesh.points.size()));
  for (std::size_t j = 0; j < times.size(); ++j)
  {
    const double series = 1 + 3 * std::exp(-2 * times[j]) + 5 * std::exp(-6 * times[j]);
    EXPECT_LT(
      (signature.col(j).array() - series).abs().maxCoeff<Eigen::PropagateNaN>(), Rounding * 9);
  }
}

TEST_F(ModeSums, TimesSpanTheSpectrum)
{
  const std::vector<double> times = HeatTimes(modes, 5);
  EXPECT_NEAR(std::exp(-6 * times.front()), 1e-4, 1e-15); // 4 ln 10
  EXPECT_NEAR(std::exp(-2 * times.back()), 1e-4, 1e-15);
  for (int j = 1; j + 1 < 5; ++j)
  {
    EXPECT_NEAR(times[j] * times[j], times[j - 1] * times[j + 1], Rounding);
  }
  EXPECT_EQ(HeatTimes(modes, 1).size(), 1u);
}

TEST_F(ModeSums, WaveKernelOfASphereIsOne)
{
  // Complete multiplets have constant sums of squares, for any weights.
  for (const int count : { 1, 7 })
  {
    const MultiVector signature = WaveKernelSignature(modes, WaveEnergies(modes, count));
    ASSERT_EQ(signature.cols(), count);
    EXPECT_LT((signature.array() - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), Rounding * 9);
  }
  const WaveBands bands = WaveEnergies(modes, 9);
  EXPECT_NEAR(bands.energies.front() - 2 * bands.width, std::log(2), Rounding);
  EXPECT_NEAR(bands.energies.back() + 2 * bands.width, std::log(6), Rounding);
}

TEST_F(ModeSums, WaveKernelIsTheWeightedMeanOfSquares)
{
  // Modes that belong to no sphere: all eigenvalues differ, and the values have no constant sums.
  // The sums are written out here, with a width of seven of 128 steps from the lowest to the
  // highest.
  modes.eigenvalues = { 0, 1, 1.5, 2.5, 4, 5, 7, 8, 12 };
  const double width = 7.0 / 128.0 * std::log(12.0);
  const WaveBands bands = WaveEnergies(modes, 4);
  const MultiVector signature = WaveKernelSignature(modes, bands);
  double spread = 0.0;
  for (int band = 0; band < 4; ++band)
  {
    const double energy = 2 * width + band / 3.0 * (std::log(12.0) - 4 * width);
    ASSERT_NEAR(bands.energies[band], energy, Rounding);
    for (Id point = 0; point < signature.rows(); ++point)
    {
      double above = 0.0;
      double below = 0.0;
      for (int k = 1; k < 9; ++k)
      {
        const double weight =
          std::exp(-std::pow((energy - std::log(modes.eigenvalues[k])) / width, 2) / 2);
        above += weight * 4 * Pi * std::pow(modes.values(point, k), 2);
        below += weight;
      }
      ASSERT_NEAR(signature(point, band), above / below, 1e-11);
      spread = Larger(spread, std::abs(above / below - 1.0));
    }
  }
  EXPECT_GT(spread, 0.5); // otherwise a signature of ones would pass
}

TEST_F(ModeSums, DistancesOnASphereAreTheirSeries)
{
  const double t = 0.2;
  const Id source = 11;
  const std::vector<double> biharmonic = BiharmonicDistance(modes, { source });
  const std::vector<double> diffusion = DiffusionDistance(modes, { source }, t);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    const double c = mesh.points[k].dot(mesh.points[source]);
    const double first = 2 * (1 - c);
    const double second = 2 * (1 - (3 * c * c - 1) / 2);
    EXPECT_NEAR(std::pow(biharmonic[k], 2), (3 * first / 4 + 5 * second / 36) / (4 * Pi), Rounding);
    EXPECT_NEAR(std::pow(diffusion[k], 2),
      3 * first * std::exp(-4 * t) + 5 * second * std::exp(-12 * t), 10 * Rounding);
  }
  EXPECT_EQ(biharmonic[source], 0.0);
  EXPECT_EQ(diffusion[source], 0.0);
}

TEST_F(ModeSums, DistancesAreSymmetricAndToTheNearestSource)
{
  const auto one = BiharmonicDistance(modes, { 3 });
  const auto other = BiharmonicDistance(modes, { 40 });
  const auto both = BiharmonicDistance(modes, { 40, 3 });
  EXPECT_EQ(one[40], other[3]);
  for (std::size_t k = 0; k < both.size(); ++k)
  {
    EXPECT_EQ(both[k], std::min(one[k], other[k]));
    EXPECT_LE(one[k], one[40] + other[k] + Rounding); // triangle inequality
  }
}

TEST_F(ModeSums, ScalesWithTheMesh)
{
  const double s = 4.0; // exact in binary
  const PointModes scaled = Scaled(modes, s);
  const auto equal = [](const MultiVector& a, const MultiVector& b)
  { return (a - b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() < 100 * Rounding; };
  EXPECT_TRUE(equal(HeatKernelSignature(modes, HeatTimes(modes, 4)),
    HeatKernelSignature(scaled, HeatTimes(scaled, 4))));
  EXPECT_NEAR(HeatTimes(scaled, 4)[2], s * s * HeatTimes(modes, 4)[2], 100 * Rounding);
  EXPECT_TRUE(equal(WaveKernelSignature(modes, WaveEnergies(modes, 4)),
    WaveKernelSignature(scaled, WaveEnergies(scaled, 4))));
  EXPECT_NEAR(
    BiharmonicDistance(scaled, { 0 })[9], s * BiharmonicDistance(modes, { 0 })[9], 100 * Rounding);
  EXPECT_NEAR(DiffusionDistance(scaled, { 0 }, 0.1 * s * s)[9],
    DiffusionDistance(modes, { 0 }, 0.1)[9], 100 * Rounding);
}

TEST_F(ModeSums, ComponentsWithoutASourceAreInfinitelyFar)
{
  // The second half of the points is a component of its own, with two constants instead of one.
  const Id half = modes.values.rows() / 2;
  MultiVector values(modes.values.rows(), 10);
  values.rightCols(9) = modes.values;
  values.col(0).setZero();
  values.col(0).head(half).setConstant(1.0);
  values.col(1) = 1.0 - values.col(0).array();
  modes.values = values;
  modes.eigenvalues.insert(modes.eigenvalues.begin(), 0.0);
  const auto biharmonic = BiharmonicDistance(modes, { 2 });
  const auto diffusion = DiffusionDistance(modes, { 2 }, 0.1);
  for (Id k = 0; k < values.rows(); ++k)
  {
    EXPECT_EQ(std::isnan(biharmonic[k]), k >= half);
    EXPECT_TRUE(std::isfinite(diffusion[k]));
    EXPECT_GE(diffusion[k], k >= half ? std::sqrt(2 * modes.area) : 0.0);
  }
}

TEST_F(ModeSums, EveryModeIsItsOwnShare)
{
  const MultiVector shares = ExpandInModes(mesh, modes, modes.values).shares;
  EXPECT_LT((shares - MultiVector::Identity(9, 9)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    10 * Rounding);
  const MultiVector low = SumOfModes(modes, shares, 0, 5);
  for (Id k = 0; k < 9; ++k)
  {
    const double left = k <= 5 ? 1.0 : 0.0;
    EXPECT_LT(
      (low.col(k) - left * modes.values.col(k)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);
  }
  EXPECT_EQ(SumOfModes(modes, shares, 3, 2).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 0.0);
}

/// A function of two modes of norm 1, and of a part of known norm that is orthogonal to all modes.
TEST_F(ModeSums, WhatRemainsIsTheNormOfThePartsThatFollow)
{
  const TriangleMesh sphere = GeodesicSphere(48);
  const PointModes harmonics = SphericalHarmonics(sphere);
  MultiVector g(sphere.points.size(), 1); // of the third degree
  for (std::size_t k = 0; k < sphere.points.size(); ++k)
  {
    const Vec3& p = sphere.points[k];
    g(k, 0) = p[0] * p[1] * p[2];
  }
  const MultiVector f = 3.0 * harmonics.values.col(2) + 4.0 * harmonics.values.col(7) + g;
  const MultiVector remaining = ExpandInModes(sphere, harmonics, f).remaining;
  const double ofG = std::sqrt(4.0 * M_PI / 105.0); // of x y z on the unit sphere
  const auto expected = [&](double a, double b) { return std::hypot(a, b, ofG); };
  EXPECT_NEAR(remaining(0, 0), expected(3.0, 4.0), 0.02);
  EXPECT_NEAR(remaining(1, 0), expected(3.0, 4.0), 0.02);
  EXPECT_NEAR(remaining(2, 0), expected(0.0, 4.0), 0.02);
  EXPECT_NEAR(remaining(6, 0), expected(0.0, 4.0), 0.02);
  EXPECT_NEAR(remaining(8, 0), ofG, 0.02 * ofG);
}

TEST_F(ModeSums, TheShareOfTheConstantIsTheMeanOverTheSurface)
{
  // Unequal triangles: a mean over points would be different. The values of x² at the points are
  // interpolated linearly, so the mean over a strip is the mean of its ends.
  TriangleMesh strip = FlatRectangle(4, 1);
  double exact = 0.0;
  const double ends[5] = { 0.0, 0.1, 0.15, 0.7, 1.0 };
  for (Vec3& point : strip.points)
  {
    point[0] = ends[static_cast<int>(std::lround(4 * point[0]))];
  }
  for (int k = 0; k < 4; ++k)
  {
    exact += (ends[k + 1] - ends[k]) * (std::pow(ends[k], 2) + std::pow(ends[k + 1], 2)) / 2;
  }
  PointModes constant;
  constant.eigenvalues = { 0.0 };
  constant.area = 1.0;
  constant.values = MultiVector::Ones(strip.points.size(), 1);
  MultiVector f(strip.points.size(), 1);
  for (std::size_t k = 0; k < strip.points.size(); ++k)
  {
    f(k, 0) = std::pow(strip.points[k][0], 2);
  }
  EXPECT_NEAR(ExpandInModes(strip, constant, f).shares(0, 0), exact, Rounding);
}

TEST_F(ModeSums, SameBitsForAnyNumberOfThreads)
{
  const TriangleMesh sphere = GeodesicSphere(40); // more than one block of triangles
  const PointModes many = SphericalHarmonics(sphere);
  MultiVector f(sphere.points.size(), 2);
  for (std::size_t k = 0; k < sphere.points.size(); ++k)
  {
    f.row(k) << std::exp(sphere.points[k][0]), sphere.points[k][1];
  }
  EXPECT_TRUE(ExpandInModes(sphere, many, f, 1).shares == ExpandInModes(sphere, many, f, 3).shares);
  EXPECT_TRUE(HeatKernelSignature(many, { 0.1 }, 1) == HeatKernelSignature(many, { 0.1 }, 3));
  EXPECT_EQ(BiharmonicDistance(many, { 5 }, 1), BiharmonicDistance(many, { 5 }, 3));
}

TEST_F(ModeSums, RefusesWhatDoesNotFit)
{
  EXPECT_THROW(BiharmonicDistance(modes, {}), InvalidInput);
  EXPECT_THROW(BiharmonicDistance(modes, { Id(mesh.points.size()) }), InvalidInput);
  EXPECT_THROW(DiffusionDistance(modes, { -1 }, 0.1), InvalidInput);
  EXPECT_THROW(DiffusionDistance(modes, { 1 }, -0.1), InvalidInput);
  EXPECT_THROW(HeatTimes(modes, 0), InvalidInput);
  EXPECT_THROW(ExpandInModes(Box(1), modes, modes.values), InvalidInput);
  PointModes wrong = modes;
  wrong.eigenvalues[3] = std::nan("");
  EXPECT_THROW(HeatKernelSignature(wrong, { 0.1 }), InvalidInput);
  wrong.eigenvalues.assign(9, 0.0); // only constants
  EXPECT_THROW(WaveEnergies(wrong, 3), InvalidInput);
}

TEST_F(ModeSums, ModesThatThePointsCannotTellApartAreRefused)
{
  const TriangleMesh octahedron = GeodesicSphere(1); // six points, nine modes
  EXPECT_THROW(ExpandInModes(octahedron, SphericalHarmonics(octahedron), MultiVector::Zero(6, 1)),
    InvalidInput);
}

} // namespace
} // namespace gridfem
