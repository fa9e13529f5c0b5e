// Blocks of vectors in single precision, which are used for tolerances of at least 1e-7, against
// blocks in double precision.
#include "Meshes.h"
#include "SpectrumChecks.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

constexpr double Single = 1e-7;
constexpr double Double = 0.99e-7;

TEST(SpectrumPrecision, PairsAreThoseOfDoublePrecision)
{
  for (const TriangleMesh& mesh :
    { GeodesicSphere(32), Torus(64, 32, 1.0, 0.4), TrefoilTube(120, 16, 0.12) })
  {
    const Discretization on = DiscretizeExactly(mesh, 5);
    ASSERT_GT(on.space.Finest().numberOfFunctions, 1200); // otherwise it would be solved densely
    const Spectrum single = Solve(on, 60, Single);
    const Spectrum wide = Solve(on, 60, Double);
    EXPECT_TRUE(single.converged);
    EXPECT_TRUE(single.singlePrecision);
    CheckPairs(on, single);
    EXPECT_NEAR(single.iterations, wide.iterations, 1);
    for (int j = 1; j < 60; ++j)
    {
      // Both stop at errors of 1e-7.
      EXPECT_NEAR(single.eigenvalues[j] / wide.eigenvalues[j], 1.0, 2e-7) << "mode " << j;
    }
  }
}

TEST(SpectrumPrecision, NoPairIsMissedInWindows)
{
  const Discretization on = DiscretizeExactly(TrefoilTube(120, 16, 0.12), 4);
  ASSERT_GT(on.space.Finest().numberOfFunctions, 700);
  const Spectrum spectrum = Solve(on, 170, Single, 1);
  EXPECT_TRUE(spectrum.converged);
  CheckPairs(on, spectrum);
  const std::vector<double> reference = DenseReference(on, 170);
  for (int j = 1; j < 170; ++j)
  {
    EXPECT_NEAR(spectrum.eigenvalues[j] / reference[j], 1.0, 2e-7) << "mode " << j;
  }
  const Spectrum again = Solve(on, 170, Single, 2);
  EXPECT_EQ(spectrum.eigenvalues, again.eigenvalues);
  EXPECT_TRUE(spectrum.vectors == again.vectors);
  EXPECT_EQ(spectrum.residuals, again.residuals);
}

/// Rounding the vectors disturbs the lowest values most, and more on deeper grids.
TEST(SpectrumPrecision, LowValuesOfDeepGridsKeepTheirDigits)
{
  const Discretization on = DiscretizeExactly(Torus(64, 32, 1.0, 0.05), 8);
  const Spectrum single = Solve(on, 6, Single);
  const Spectrum wide = Solve(on, 6, 1e-10);
  EXPECT_TRUE(single.converged);
  CheckPairs(on, single);
  for (int j = 1; j < 6; ++j)
  {
    // The measure of the residual is an estimate.
    EXPECT_NEAR(single.eigenvalues[j] / wide.eigenvalues[j], 1.0, 2.0 * Single) << "mode " << j;
  }
}

/// A function that almost vanishes on a sliver has no mass left after rounding.
TEST(SpectrumPrecision, WhatItLosesIsComputedInDoublePrecision)
{
  TriangleMesh sliver;
  sliver.points = { { 0, 0, 0 }, { 1, 1, 1 }, { 0.5, 0.5, 0.5 + 1e-9 } };
  sliver.triangles = { { 0, 1, 2 } };
  const Discretization on = DiscretizeExactly(sliver, 4);
  const Spectrum single = Solve(on, 100, Single);
  const Spectrum wide = Solve(on, 100, Double);
  EXPECT_GT(single.eigenvalues.size(), 40u); // 49 have a mass
  EXPECT_EQ(single.eigenvalues, wide.eigenvalues);
  EXPECT_TRUE(std::is_sorted(single.eigenvalues.begin(), single.eigenvalues.end()));
  EXPECT_TRUE(single.vectors.allFinite());
}

} // namespace
} // namespace gridfem
