// Estimated errors of eigenvalues, and the depth for a wanted error.
#include "Meshes.h"
#include "Problems/SpectrumAccuracy.h"
#include "SpectrumChecks.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

TEST(Spectrum, EstimatedErrorsAreTheTrueOnesWithinAFactorOfTwo)
{
  const TriangleMesh mesh = GeodesicSphere(96);
  const std::vector<double> exact = SphereValues(100);
  const Discretisation on = DiscretiseExactly(mesh, 5);
  const Spectrum spectrum = Solve(on, 100);
  const std::vector<double> values = WorldValues(on, spectrum);
  EXPECT_EQ(spectrum.estimatedErrors[0], 0.0);
  const double areaOfFacets = SurfaceArea(mesh) / (4 * Pi); // most of the facets' own error
  for (int j = 1; j < 100; ++j)
  {
    // A factor of two, because members of a multiplet may change places between the levels. The
    // facets' error beyond their area is 2e-4.
    const double error = values[j] * areaOfFacets / exact[j] - 1.0;
    EXPECT_LE(spectrum.estimatedErrors[j], 2.0 * error + 2e-4) << "mode " << j;
    EXPECT_GE(spectrum.estimatedErrors[j], 0.5 * error - 2e-4) << "mode " << j;
  }
}

TEST(Spectrum, TheDepthFollowsFromTheWantedAccuracy)
{
  const TriangleMesh mesh = GeodesicSphere(64);
  const std::vector<double> exact = SphereValues(36);
  for (const double accuracy : { 0.05, 0.004 })
  {
    int depth = FirstDepthForAccuracy(9500, 36, accuracy); // functions of a sphere at depth 5
    Discretisation on = DiscretiseExactly(mesh, depth);
    Spectrum spectrum = Solve(on, 36);
    for (int next; (next = DepthForAccuracy(spectrum.estimatedErrors, depth, accuracy)) != depth;)
    {
      depth = next;
      on = DiscretiseExactly(mesh, depth);
      spectrum = Solve(on, 36);
    }
    EXPECT_LE(LargestError(WorldValues(on, spectrum), exact), 1.2 * accuracy);
    EXPECT_LE(depth, 5); // 0.3 % at depth 5: no deeper than necessary
  }
}

TEST(Spectrum, DepthsForAccuracy)
{
  EXPECT_EQ(DepthForAccuracy({ 0.0, 0.01 }, 5, 0.01), 5);
  EXPECT_EQ(DepthForAccuracy({ 0.0, 0.011 }, 5, 0.01), 6);
  EXPECT_EQ(DepthForAccuracy({ 0.17, 0.0 }, 5, 0.01), 8); // 17 -> 4.25 -> 1.06 -> 0.27 %
  EXPECT_EQ(DepthForAccuracy({ 1.0 }, 5, 1e-9), MaximumDepth);
  EXPECT_THROW(DepthForAccuracy({ 1.0 }, 5, 0.0), InvalidInput);
  EXPECT_THROW(FirstDepthForAccuracy(1000, 10, 1.0), InvalidInput);
}

} // namespace
} // namespace gridfem
