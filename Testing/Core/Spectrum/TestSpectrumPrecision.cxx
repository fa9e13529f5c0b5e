// Blocks of vectors in single precision, which are used for tolerances of at least 1e-7, against
// blocks in double precision.
#include "Meshes.h"
#include "SpectrumChecks.h"

#include "Equations/LevelProblem.h"
#include "Spectrum/CollectSpectrum.h"

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

/// Gives pairs in reverse order, with a vector without mass among them. Double precision drops this
/// vector, single precision puts it last.
template<class Real>
void ExpectNumbersOfPairsToFollow()
{
  constexpr bool IsSingle = std::is_same_v<Real, float>;
  const Discretization on = DiscretizeExactly(GeodesicSphere(12), 4);
  const GridSpace space = ViewOf(on.space, on.system);
  const Spectrum given = Solve(on, 8, Double);
  SparseMatrix mass = space.Matrix(0, 1.0, 0.0);
  const Constants constants = ConstantsOnLevel(space, 0, mass, 1);
  const auto problem = ProblemOnLevel<Real>(space, 0, constants, std::move(mass), 1);
  EigenPairs<Real> pairs;
  pairs.vectors.Reserve(given.vectors.rows(), 8);
  pairs.vectors.Show(8);
  Eigen::MatrixXd numbers(8, 2);
  BlockReport report;
  for (Id k = 0; k < 8; ++k)
  {
    const Id mode = k < 3 ? 7 - k : 8 - k; // 7, 6, 5, the vector without mass, 4, 3, 2, 1
    const double value = k == 3 ? -1.0 : given.eigenvalues[mode];
    pairs.vectors.View().col(k) =
      ((k == 3 ? 0.0 : 1.0) * given.vectors.col(mode)).template cast<Real>();
    numbers.row(k) << value, 1.0 + value;
    report.residuals.push_back(1e-3 * value);
  }
  const Spectrum spectrum = CollectSpectrum(constants, 1, pairs, report, 1e-6, problem, numbers);
  ASSERT_EQ(static_cast<Id>(spectrum.eigenvalues.size()), numbers.rows() + 1);
  ASSERT_EQ(numbers.rows(), IsSingle ? 8 : 7);
  for (Id k = 0; k < 7; ++k)
  {
    EXPECT_NEAR(numbers(k, 0), spectrum.eigenvalues[k + 1], 1e-5 * spectrum.eigenvalues[k + 1]);
    EXPECT_EQ(numbers(k, 1), 1.0 + numbers(k, 0));
    EXPECT_EQ(spectrum.residuals[k + 1], 1e-3 * numbers(k, 0));
  }
  EXPECT_EQ(numbers.bottomRows(numbers.rows() - 7).sum(), IsSingle ? -1.0 : 0.0);
}

TEST(SpectrumPrecision, NumbersOfPairsFollowTheEigenvalues)
{
  ExpectNumbersOfPairsToFollow<float>();
  ExpectNumbersOfPairsToFollow<double>();
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
