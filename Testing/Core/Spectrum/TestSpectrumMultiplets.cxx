// Equal eigenvalues: symmetric surfaces, equal components, and lists that end among them.
#include "Meshes.h"
#include "SpectrumChecks.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

Spectrum SolveWhole(const Discretization& on, int modes)
{
  SpectrumOptions options;
  options.numberOfModes = modes;
  options.completeMultiplets = true;
  return ComputeSpectrum(ViewOf(on.space, on.system), options);
}

TEST(Spectrum, ComponentsThatPartOnTheFinestLevelKeepTheirPairs)
{
  // The gap is wide enough for the finest cells. Coarser plain functions reach over it. A function
  // that is nearly constant on both boxes there is none of the finer pairs.
  const TriangleMesh boxes =
    testing::Join(Box(6, { 0, 0, 0 }, { 1, 1, 0.3 }), Box(6, { 0, 0, 0.41 }, { 1, 1, 0.71 }));
  const Discretization plain = DiscretizeExactly(boxes, 5, false);
  const Discretization aware = DiscretizeExactly(boxes, 5, true);
  ASSERT_EQ(plain.space.numberOfComponents, 2);
  const std::vector<Index> coarse = FunctionComponents(plain.space.levels[2]);
  ASSERT_EQ(*std::max_element(coarse.begin(), coarse.end()), 0);
  ASSERT_EQ(plain.space.Finest().numberOfFunctions, aware.space.Finest().numberOfFunctions);
  for (const double tolerance : { 1e-6, 1e-10 }) // vectors in single and in double precision
  {
    const Spectrum spectrum = Solve(plain, 24, tolerance);
    const Spectrum expected = Solve(aware, 24, tolerance);
    EXPECT_TRUE(spectrum.converged);
    CheckPairs(plain, spectrum);
    for (int j = 2; j < 24; ++j) // the finest spaces are the same
    {
      EXPECT_NEAR(spectrum.eigenvalues[j] / expected.eigenvalues[j], 1.0, 2.0 * tolerance);
    }
  }
}

TEST(Spectrum, AxisAlignedCubeHasItsMultiplicities)
{
  // On grid planes, half of the functions of a cell vanish on the surface, so M is singular.
  const Discretization on = DiscretizeExactly(Box(4), 4);
  const Spectrum spectrum = Solve(on, 20, 1e-10);
  EXPECT_TRUE(spectrum.converged);
  CheckPairs(on, spectrum);
  const std::vector<double>& values = spectrum.eigenvalues;
  // The symmetry group of the cube has representations of dimension 1, 2 and 3.
  const std::vector<int> first = { 0, 1, 4, 7, 9 };
  for (std::size_t group = 1; group + 1 < first.size(); ++group)
  {
    for (int j = first[group]; j < first[group + 1]; ++j)
    {
      EXPECT_NEAR(values[j] / values[first[group]], 1.0, 1e-7) << "mode " << j;
    }
    EXPECT_GT(values[first[group + 1]] / values[first[group]], 1.01);
  }
}

TEST(Spectrum, EqualSpheresShareEveryEigenvalue)
{
  TriangleMesh mesh = GeodesicSphere(16);
  for (const double x : { 4.0, 8.0 })
  {
    mesh = Join(mesh, Transform(GeodesicSphere(16), { 0, 0, 1 }, 0.0, 1.0, { x, 0, 0 }));
  }
  for (const bool connectivityAware : { true, false })
  {
    const Discretization on = DiscretizeExactly(mesh, 5, connectivityAware);
    ASSERT_EQ(on.space.numberOfComponents, 3);
    const Spectrum spectrum = Solve(on, 48);
    EXPECT_TRUE(spectrum.converged);
    CheckPairs(on, spectrum);
    EXPECT_EQ(std::count(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end(), 0.0), 3);
    // Twelve cells across a sphere: the fourth level of the sphere (l = 3) is 3 % off.
    EXPECT_LT(LargestError(WorldValues(on, spectrum), SphereValues(48, 3)), 0.06);
  }
}

TEST(Spectrum, SpheresInEqualCellsShareEveryEigenvalueExactly)
{
  // Three spheres of radius 1 in a cube of side 8 with 32 cells a side. They are 12 cells apart, so
  // that all have the same position in the grid. Every eigenvalue is therefore triple.
  TriangleMesh mesh = GeodesicSphere(8);
  for (const double x : { 3.0, 6.0 })
  {
    mesh = Join(mesh, Transform(GeodesicSphere(8), { 0, 0, 1 }, 0.0, 1.0, { x, 0, 0 }));
  }
  const Discretization on = DiscretizeExactly(mesh, 5);
  const Spectrum spectrum = Solve(on, 75); // 3 (1 + 3 + 5 + 7 + 9): all of degree 4
  EXPECT_TRUE(spectrum.converged);
  EXPECT_FALSE(spectrum.cutsMultiplet);
  CheckPairs(on, spectrum);
  for (int j = 3; j < 75; j += 3)
  {
    EXPECT_NEAR(spectrum.eigenvalues[j + 2] / spectrum.eigenvalues[j], 1.0, 1e-7) << "mode " << j;
  }
}

TEST(Spectrum, AMultipletAtTheEndIsCompletedOrReported)
{
  const Discretization on = DiscretizeExactly(GeodesicSphere(24), 5);
  for (const int modes : { 2, 10, 15, 16 })
  {
    const int whole = modes == 2 ? 4 : 16; // 1 + 3, 1 + 3 + 5 + 7
    const Spectrum cut = Solve(on, modes);
    EXPECT_EQ(cut.eigenvalues.size(), std::size_t(modes));
    EXPECT_EQ(cut.cutsMultiplet, modes != whole) << modes;
    const Spectrum complete = SolveWhole(on, modes);
    EXPECT_EQ(complete.eigenvalues.size(), std::size_t(whole)) << modes;
    EXPECT_FALSE(complete.cutsMultiplet);
    EXPECT_TRUE(complete.converged);
    CheckPairs(on, complete);
  }
}

TEST(Spectrum, AMultipletLongerThanTheGuardsIsCompleted)
{
  // The first value of 8 equal cubes is 24-fold, more than the guards cover.
  const Discretization on = DiscretizeExactly(CubeArray(2, 2, 1.0), 4);
  ASSERT_EQ(on.space.numberOfComponents, 8);
  EXPECT_EQ(SolveWhole(on, 3).eigenvalues.size(), 3u); // constants are not completed
  EXPECT_EQ(SolveWhole(on, 3).numberOfConstants, 8);
  EXPECT_TRUE(Solve(on, 3).cutsMultiplet);
  EXPECT_FALSE(Solve(on, 8).cutsMultiplet);
  const Spectrum spectrum = SolveWhole(on, 9);
  EXPECT_EQ(spectrum.eigenvalues.size(), 32u);
  EXPECT_LT(spectrum.eigenvalues[31] / spectrum.eigenvalues[8], 1.01);
  CheckPairs(on, spectrum);
}

TEST(Spectrum, ManyComponentsHaveNoSmallLevel)
{
  // A cube has 4 cells a side and a period of 6 cells, so all have the same position in the grid.
  const Discretization on = DiscretizeExactly(CubeArray(3, 2, 0.5), 4);
  ASSERT_EQ(on.space.numberOfComponents, 27);
  ASSERT_GT(on.space.levels[on.system.elements.size() - 1].numberOfFunctions, 600);
  const Spectrum spectrum = Solve(on, 40);
  EXPECT_TRUE(spectrum.converged);
  CheckPairs(on, spectrum);
  EXPECT_EQ(std::count(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end(), 0.0), 27);
  // The first value of a cube is threefold. The first value of 27 cubes is 81-fold.
  EXPECT_NEAR(spectrum.eigenvalues.back() / spectrum.eigenvalues[27], 1.0, 1e-7);
}

TEST(Spectrum, OnlyZeroModesAskedFor)
{
  const Discretization on = DiscretizeExactly(CubeArray(2, 2, 1.0), 4);
  ASSERT_EQ(on.space.numberOfComponents, 8);
  for (const int modes : { 1, 5, 8 })
  {
    const Spectrum spectrum = Solve(on, modes);
    EXPECT_TRUE(spectrum.converged);
    CheckPairs(on, spectrum);
    EXPECT_EQ(spectrum.eigenvalues, std::vector<double>(modes, 0.0));
  }
}

} // namespace
} // namespace gridfem
