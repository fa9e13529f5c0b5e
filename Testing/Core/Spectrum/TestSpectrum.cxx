// The nested eigensolver, against exact spectra and against a dense solver.
#include "Meshes.h"
#include "SpectrumChecks.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

TEST(Spectrum, SmallSpaceEqualsDenseReference)
{
  const Discretization on = DiscretizeExactly(Torus(48, 24, 1.0, 0.4), 3);
  ASSERT_LE(on.space.Finest().numberOfFunctions, 600);
  const Spectrum spectrum = Solve(on, 60, 1e-10);
  EXPECT_TRUE(spectrum.converged);
  CheckPairs(on, spectrum);
  EXPECT_EQ(spectrum.eigenvalues[0], 0.0);
  const std::vector<double> reference = DenseReference(on, 60);
  for (int j = 1; j < 60; ++j)
  {
    EXPECT_NEAR(spectrum.eigenvalues[j] / reference[j], 1.0, 1e-8) << "mode " << j;
  }
}

TEST(Spectrum, NestedIterationEqualsDenseReference)
{
  const Discretization on = DiscretizeExactly(TrefoilTube(120, 16, 0.12), 4);
  ASSERT_GT(on.space.Finest().numberOfFunctions, 600);
  const Spectrum spectrum = Solve(on, 30, 1e-11);
  EXPECT_TRUE(spectrum.converged);
  EXPECT_GT(spectrum.iterations, 0);
  CheckPairs(on, spectrum);
  const std::vector<double> reference = DenseReference(on, 30);
  for (int j = 1; j < 30; ++j)
  {
    EXPECT_NEAR(spectrum.eigenvalues[j] / reference[j], 1.0, 1e-8) << "mode " << j;
  }
}

TEST(Spectrum, ManyModesComeInWindows)
{
  // Two windows. The second has few vectors to start from, because the coarser level is small. The
  // dense solver shows that no pair is missed.
  const Discretization on = DiscretizeExactly(TrefoilTube(120, 16, 0.12), 4);
  ASSERT_GT(on.space.Finest().numberOfFunctions, 700);
  const Spectrum spectrum = Solve(on, 170, 1e-8, 1);
  EXPECT_TRUE(spectrum.converged);
  CheckPairs(on, spectrum);
  const std::vector<double> reference = DenseReference(on, 170);
  for (int j = 1; j < 170; ++j)
  {
    EXPECT_NEAR(spectrum.eigenvalues[j] / reference[j], 1.0, 1e-7) << "mode " << j;
  }
  const Spectrum again = Solve(on, 170, 1e-8, 2);
  EXPECT_EQ(spectrum.eigenvalues, again.eigenvalues);
  EXPECT_TRUE(spectrum.vectors == again.vectors);
}

TEST(Spectrum, UnitSphere)
{
  const TriangleMesh mesh = GeodesicSphere(96);
  const std::vector<double> exact = SphereValues(100);
  double errors[3];
  for (const int depth : { 4, 5, 6 })
  {
    const Discretization on = DiscretizeExactly(mesh, depth);
    const Spectrum spectrum = Solve(on, 100, 1e-6); // far below the discretization error
    EXPECT_TRUE(spectrum.converged);
    CheckPairs(on, spectrum);
    errors[depth - 4] = LargestError(WorldValues(on, spectrum), exact);
  }
  EXPECT_LT(errors[1], 0.015);
  EXPECT_GT(errors[0] / errors[1], 3.0); // second order gives a factor of four
  EXPECT_GT(errors[1] / errors[2], 3.0); // the facets' own error is a thirtieth of the last
}

TEST(Spectrum, FlatSquare)
{
  const TriangleMesh mesh = FlatRectangle(7, 7);
  std::vector<double> exact;
  for (int m = 0; m < 8; ++m)
  {
    for (int n = 0; n < 8; ++n)
    {
      exact.push_back(Pi * Pi * (m * m + n * n));
    }
  }
  std::sort(exact.begin(), exact.end());
  exact.resize(30);
  // Bilinear elements are (π k h)² / 12 too high. The worst case is k = 5 and h = 1/32: 2 %.
  const Discretization flat = DiscretizeExactly(mesh, 5);
  const Spectrum spectrum = Solve(flat, 30);
  EXPECT_TRUE(spectrum.converged);
  CheckPairs(flat, spectrum);
  EXPECT_LT(LargestError(WorldValues(flat, spectrum), exact), 0.021);
  // Away from the grid's planes and diagonals, the eight functions of a cell act like four.
  const Discretization tilted = DiscretizeExactly(Transform(mesh, { 1, 2, 3 }, 0.7), 5);
  EXPECT_LT(LargestError(WorldValues(tilted, Solve(tilted, 30)), exact), 0.021);
}

TEST(Spectrum, ComponentsWithoutAreaHaveNoModes)
{
  // A triangle of collinear points, one of equal points, and an oblique line whose pieces have an
  // area of rounding, all far from the sphere.
  TriangleMesh mesh = GeodesicSphere(16);
  const Index first = static_cast<Index>(mesh.points.size());
  for (const double x : { 0.0, 0.1, 0.2, 0.3 })
  {
    mesh.points.push_back({ 1.9 + x, 1.9, 1.9 });
  }
  mesh.triangles.push_back({ first, first + 1, first + 2 });
  mesh.triangles.push_back({ first + 3, first + 3, first + 3 });
  mesh.points.push_back({ -1.7, 1.31, 1.9 });
  mesh.triangles.push_back({ first + 4, first + 4, first });
  for (const int depth : { 3, 5 }) // dense, and nested
  {
    const Discretization on = DiscretizeExactly(mesh, depth);
    const Spectrum spectrum = Solve(on, 16);
    EXPECT_TRUE(spectrum.converged);
    CheckPairs(on, spectrum);
    EXPECT_EQ(std::count(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end(), 0.0), 1);
    EXPECT_TRUE(spectrum.vectors.allFinite());
    // Twelve cells across a sphere (depth 5) or three (depth 3).
    EXPECT_LT(LargestError(WorldValues(on, spectrum), SphereValues(16)), depth == 3 ? 0.7 : 0.05);
  }
}

TEST(Spectrum, MoreModesThanExist)
{
  // A flat square in a grid plane, 4 x 4 cells, has 25 functions of the plane. The others vanish on
  // it.
  const Discretization on = DiscretizeExactly(FlatRectangle(4, 4), 2);
  const Spectrum spectrum = Solve(on, 100);
  EXPECT_TRUE(spectrum.truncated);
  EXPECT_TRUE(spectrum.converged);
  EXPECT_EQ(spectrum.eigenvalues.size(), 25u);
  CheckPairs(on, spectrum);
  EXPECT_FALSE(Solve(on, 25).truncated);
}

TEST(Spectrum, ReturnsNoMoreModesThanAskedAndAllWithAMass)
{
  const TriangleMesh mesh = { { { 0, 0, 0 }, { 1, .3, .2 }, { .1, 1, .7 } }, { { 0, 1, 2 } } };
  const Discretization on = Discretize(mesh, 2);
  for (const int modes : { 5, 20, 50, 64 })
  {
    const Spectrum spectrum = Solve(on, modes);
    const auto count = static_cast<int>(spectrum.eigenvalues.size());
    EXPECT_LE(count, modes);
    EXPECT_EQ(spectrum.truncated, count < modes);
    EXPECT_EQ(spectrum.vectors.cols(), count);
    EXPECT_EQ(spectrum.estimatedErrors.size(), spectrum.eigenvalues.size());
    const Eigen::MatrixXd mass = Dense(MassMatrix(on.space, on.system));
    const Eigen::MatrixXd products = spectrum.vectors.transpose() * mass * spectrum.vectors;
    EXPECT_LT((products.diagonal().array() - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-8)
      << modes;
  }
}

/// Fifty modes take two panels of columns, which three threads share.
TEST(Spectrum, RepeatsBitForBitOnAnyNumberOfThreads)
{
  for (const auto& [modes, depth, tolerance] : { std::tuple(20, 4, 1e-8), std::tuple(50, 5, 1e-6) })
  {
    const Discretization on = DiscretizeExactly(TrefoilTube(120, 16, 0.12), depth);
    const Spectrum one = Solve(on, modes, tolerance, 1);
    for (const int threads : { 1, 2, 3, 4 })
    {
      const Spectrum again = Solve(on, modes, tolerance, threads);
      EXPECT_EQ(one.eigenvalues, again.eigenvalues);
      EXPECT_TRUE(one.vectors == again.vectors);
      EXPECT_EQ(one.residuals, again.residuals);
    }
  }
}

TEST(Spectrum, ScalesWithTheInverseSquareOfLength)
{
  const TriangleMesh mesh = Torus(48, 24, 1.0, 0.4);
  const Discretization small = DiscretizeExactly(mesh, 4);
  const Discretization large =
    DiscretizeExactly(Transform(mesh, { 0, 0, 1 }, 0.0, 1024.0), 4); // exact in binary
  const std::vector<double> a = WorldValues(small, Solve(small, 20));
  const std::vector<double> b = WorldValues(large, Solve(large, 20));
  for (std::size_t j = 1; j < a.size(); ++j)
  {
    EXPECT_NEAR(b[j] * 1024.0 * 1024.0 / a[j], 1.0, 1e-8); // the tolerance of the solve
  }
}

TEST(Spectrum, HasEveryConstantOnceOnTrianglesMuchSmallerThanCells)
{
  // Three triangles, each 2 % of a cell long. Only a few functions can be told apart.
  TriangleMesh mesh;
  for (const Vec3& corner :
    { Vec3(0.97, -0.54, 0.33), Vec3(-0.71, -0.14, -0.04), Vec3(-0.2, -0.8, -0.8) })
  {
    const Id first = static_cast<Id>(mesh.points.size());
    mesh.points.insert(mesh.points.end(),
      { corner, corner + Vec3(-0.003, 0.0034, 0.0024), corner + Vec3(-0.0029, 0.0033, 0.0002) });
    mesh.triangles.push_back({ first, first + 1, first + 2 });
  }
  const Discretization on = DiscretizeExactly(mesh, 3);
  const Spectrum spectrum = Solve(on, 10, 1e-6);
  EXPECT_EQ(std::count_if(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end(),
              [](double value) { return value < 1e-6; }),
    3);
}

TEST(Spectrum, ReportsWhatHasNotConverged)
{
  const Discretization on = DiscretizeExactly(GeodesicSphere(16), 4);
  SpectrumOptions options;
  options.numberOfModes = 20;
  options.tolerance = 1e-12;
  options.maximumIterations = 1;
  const Spectrum spectrum = ComputeSpectrum(ViewOf(on.space, on.system), options);
  EXPECT_FALSE(spectrum.converged);
  EXPECT_LT(spectrum.numberOfConverged, 20);
  EXPECT_EQ(spectrum.iterations, 1);
  CheckPairs(on, spectrum);
}

TEST(Spectrum, ReportsProgressAndStopsWhenAsked)
{
  const Discretization on = DiscretizeExactly(GeodesicSphere(16), 4);
  SpectrumOptions options;
  options.numberOfModes = 20;
  std::vector<double> reports;
  ComputeSpectrum(ViewOf(on.space, on.system), options,
    Progress(
      [&](double fraction)
      {
        reports.push_back(fraction);
        return true;
      }));
  EXPECT_GT(reports.size(), 10u);
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_GE(reports.front(), 0.0);
  EXPECT_LE(reports.back(), 1.0);
  const auto stopAt = [&](double fraction)
  {
    ComputeSpectrum(ViewOf(on.space, on.system), options,
      Progress([fraction](double done) { return done < fraction; }));
  };
  EXPECT_THROW(stopAt(0.0), Aborted);
  EXPECT_THROW(stopAt(0.5), Aborted);
}

TEST(Spectrum, TenThousandModesReportFromTheStartAndStopAtOnce)
{
  const Discretization on = DiscretizeExactly(GeodesicSphere(16), 6);
  SpectrumOptions options;
  options.numberOfModes = 10000;
  ASSERT_GT(on.space.Finest().numberOfFunctions, options.numberOfModes);
  for (const int last : { 1, 20, 60 })
  {
    int reports = 0;
    EXPECT_THROW(ComputeSpectrum(ViewOf(on.space, on.system), options,
                   Progress([&](double) { return ++reports < last; })),
      Aborted);
    EXPECT_EQ(reports, last);
  }
}

TEST(Spectrum, RefusesOptionsOutOfRange)
{
  const Discretization on = DiscretizeExactly(Box(2), 2);
  EXPECT_THROW(Solve(on, 0), InvalidInput);
  EXPECT_THROW(Solve(on, 3, 0.0), InvalidInput);
  EXPECT_THROW(Solve(on, 3, 1.0), InvalidInput);
}

} // namespace
} // namespace gridfem
