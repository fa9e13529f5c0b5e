// Estimated errors of eigenvalues, and the depth for a wanted error.
#include "Meshes.h"
#include "Spectrum/ModeMatch.h"
#include "Spectrum/SpectrumAccuracy.h"
#include "SpectrumChecks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

TEST(Spectrum, EstimatedErrorsAreTheTrueOnesWithinAFactorOfTwo)
{
  const TriangleMesh mesh = GeodesicSphere(96);
  const std::vector<double> exact = SphereValues(100);
  const Discretization on = DiscretizeExactly(mesh, 5);
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

/// Differences that fall by four are errors of second order. Differences that fall by two are
/// errors of first order.
TEST(Spectrum, ErrorsFollowFromTheRateOfThreeLevels)
{
  const double none = std::nan("");
  ValuesOnLevels values;
  values.finest.resize(6);
  values.next.resize(6);
  values.afterNext.resize(6);
  values.finest << 10.0, 10.0, 10.0, 10.0, 10.0, 10.0;
  values.next << 10.3, 10.3, 10.3, none, 10.3, 10.0;
  values.afterNext << 11.5, 10.9, 10.4, none, none, 10.0;
  const EigenvalueErrors errors = EstimateErrors(values, std::vector<double>(6, 0.0));
  EXPECT_NEAR(errors.relative[0], 0.01, 1e-12); // true value 9.9
  EXPECT_NEAR(errors.relative[1], 0.03, 1e-12); // true value 9.7
  EXPECT_GT(errors.relative[2], 0.05);          // hardly falls
  EXPECT_EQ(errors.relative[3], 1.0);
  EXPECT_GE(errors.relative[4], 0.01);
  EXPECT_EQ(errors.relative[5], 0.0);
  EXPECT_EQ(errors.isTrusted, (std::vector<char>{ 1, 1, 0, 0, 0, 1 }));
}

/// A level where the value is far off tells no rate, although the differences fall.
TEST(Spectrum, LargeChangesAreNotTrusted)
{
  for (const double step : { 0.02, 0.06, 0.12, 0.3 })
  {
    ValuesOnLevels values;
    values.finest = Eigen::VectorXd::Constant(2, 10.0);
    values.next = values.finest * (1.0 + step);
    values.afterNext.resize(2);
    values.afterNext << 10.0 * (1.0 + 3.0 * step), 10.0 * (1.0 + 5.0 * step); // ratios 2 and 4
    const EigenvalueErrors errors = EstimateErrors(values, { 0.0, 0.0 });
    EXPECT_NEAR(errors.relative[0], step, 1e-12);
    EXPECT_NEAR(errors.relative[1], step / 3.0, 1e-12);
    EXPECT_EQ(errors.isTrusted, (std::vector<char>{ step < 0.15, step < 0.075 })) << step;
  }
}

/// Orthonormal modes in another order, mixed within a pair, and one that is not there.
TEST(Spectrum, ModesAreMatchedByTheirFunctions)
{
  const Discretization on = DiscretizeExactly(GeodesicSphere(16), 4);
  const Spectrum spectrum = Solve(on, 9);
  SpectralProblem<double> problem;
  problem.mass = MassMatrix(on.space, on.system);
  SparseMatrix identity;
  identity.rows = problem.mass.rows;
  identity.columns = problem.mass.rows;
  Array<Id> begin(identity.rows + 1);
  Array<Index> column(identity.rows);
  std::iota(begin.begin(), begin.end(), 0);
  std::iota(column.begin(), column.end(), 0);
  identity.rowBegin = std::move(begin);
  identity.column = std::move(column);
  identity.value = Array<double>(identity.rows, 1.0);
  MultiVector coarser(spectrum.vectors.rows(), 4);
  coarser.col(0) = spectrum.vectors.col(5);
  coarser.col(1) = std::sqrt(0.5) * (spectrum.vectors.col(2) - spectrum.vectors.col(1));
  coarser.col(2) = std::sqrt(0.5) * (spectrum.vectors.col(2) + spectrum.vectors.col(1));
  coarser.col(3) = spectrum.vectors.col(3);
  Eigen::MatrixXd numbers(4, 2);
  numbers << 50, 1, 21, 2, 22, 2, 30, std::nan("");
  const Eigen::MatrixXd found =
    MatchNumbers<double>(problem, spectrum.vectors, identity, coarser, numbers);
  EXPECT_NEAR(found(1, 0), 21.5, 1e-6); // the mean of the pair
  EXPECT_NEAR(found(2, 0), 21.5, 1e-6);
  EXPECT_NEAR(found(2, 1), 2.0, 1e-6);
  EXPECT_NEAR(found(3, 0), 30.0, 1e-6);
  EXPECT_TRUE(std::isnan(found(3, 1)));
  EXPECT_NEAR(found(5, 0), 50.0, 1e-6);
  EXPECT_TRUE(std::isnan(found(4, 0)));
  EXPECT_TRUE(std::isnan(found(6, 1)));
}

/// Solves on a turned plate of two faces, and compares the errors with their estimates.
/// @param exact  values of the modes that are equal and opposite on the faces
void ExpectFoundOrNotTrusted(const TriangleMesh& flat, const TriangleMesh& turned,
  const std::vector<double> (&exact)[2], int depth)
{
  const Discretization on = DiscretizeExactly(turned, depth);
  const Spectrum spectrum = Solve(on, 10);
  const std::vector<double> values = WorldValues(on, spectrum);
  const MultiVector atPoints =
    ViewOf(on.space, on.system, &turned).ValuesAtPoints(spectrum.vectors);
  const auto isBottom = [&](Id point) { return flat.points[point][2] == 0.0; };
  std::size_t seen[2] = { 0, 0 };
  for (int k = 0; k < 10; ++k)
  {
    double product = 0.0; // of the values on both faces
    for (Id low = 0; low < atPoints.rows(); ++low)
    {
      for (Id high = 0; high < atPoints.rows() && isBottom(low); ++high)
      {
        const bool isAbove =
          !isBottom(high) && (flat.points[high] - flat.points[low]).norm() < 2e-3;
        product += isAbove ? atPoints(low, k) * atPoints(high, k) : 0.0;
      }
    }
    const int kind = product > 0.0 ? 0 : 1;
    const double error = values[k] / Larger(exact[kind][seen[kind]], 1e-9) - 1.0;
    ++seen[kind];
    if (spectrum.isErrorTrusted[k])
    {
      EXPECT_LE(error, 2.0 * spectrum.estimatedErrors[k] + 0.01) << "mode " << k << " at " << depth;
    }
    // Differences of a thousandth are near the tolerance of the coarser levels.
    EXPECT_TRUE(depth < 6 || spectrum.isErrorTrusted[k] || spectrum.estimatedErrors[k] < 2e-3) << k;
  }
  EXPECT_GT(seen[1], 1u);
}

/// A plate of two faces at a distance far below a cell, joined at the rim. Modes that are opposite
/// on the faces vanish at the rim, and their errors fall by two to three per level. They are the
/// modes of a rectangle that is held at its border. The others are the modes of a free rectangle.
TEST(Spectrum, ErrorsOfAThinPlateAreFoundOrNotTrusted)
{
  constexpr int Cuts = 24;
  constexpr double Width = 0.7;
  const TriangleMesh flat = Box(Cuts, { 0, 0, 0 }, { 1, Width, 1e-3 });
  std::vector<double> exact[2];
  for (int i = 0; i < 6; ++i)
  {
    for (int j = 0; j < 6; ++j)
    {
      const double value = Pi * Pi * (i * i + j * j / (Width * Width));
      exact[0].push_back(value);
      exact[1].insert(exact[1].end(), i > 0 && j > 0 ? 1 : 0, value);
    }
  }
  std::sort(exact[0].begin(), exact[0].end());
  std::sort(exact[1].begin(), exact[1].end());
  // At depth 5 the second turn has differences that fall by five, and errors 2.7 times as large as
  // the estimates.
  for (const TriangleMesh& turned : { Transform(flat, { 3, 1, 2 }, 0.6),
         Transform(flat, { -0.221482, -0.543001, 0.809997 }, 1.875296) })
  {
    for (const int depth : { 4, 5, 6 })
    {
      ExpectFoundOrNotTrusted(flat, turned, exact, depth);
    }
  }
}

TEST(Spectrum, TheDepthFollowsFromTheWantedAccuracy)
{
  const TriangleMesh mesh = GeodesicSphere(64);
  const std::vector<double> exact = SphereValues(36);
  for (const double accuracy : { 0.05, 0.004 })
  {
    int depth = FirstDepthForAccuracy(9500, 36, accuracy); // functions of a sphere at depth 5
    Discretization on = DiscretizeExactly(mesh, depth);
    Spectrum spectrum = Solve(on, 36);
    for (int next; (next = DepthForAccuracy(spectrum.estimatedErrors, depth, accuracy)) != depth;)
    {
      depth = next;
      on = DiscretizeExactly(mesh, depth);
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
