// The nested eigensolver, against exact spectra and against a dense solver.
#include "Discretisation.h"
#include "Meshes.h"
#include "Spectrum.h"
#include "SpectrumAccuracy.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

constexpr double Pi = 3.14159265358979323846;

/// With a rule that is exact.
Discretisation DiscretiseExactly(const TriangleMesh& mesh, int depth, bool connectivityAware = true)
{
  return Discretise(mesh, depth, 6, connectivityAware);
}

Spectrum Solve(const Discretisation& on, int modes, double tolerance = 1e-8, int threads = 0)
{
  SpectrumOptions options;
  options.numberOfModes = modes;
  options.tolerance = tolerance;
  options.multigrid.threads = threads;
  return ComputeSpectrum(on.space, on.system, options);
}

/// Eigenvalues in world units.
std::vector<double> WorldValues(const Discretisation& on, const Spectrum& spectrum)
{
  std::vector<double> values = spectrum.eigenvalues;
  for (double& value : values)
  {
    value /= on.Spacing() * on.Spacing();
  }
  return values;
}

Eigen::MatrixXd Dense(const SparseMatrix& A)
{
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(A.rows, A.columns);
  for (Index i = 0; i < A.rows; ++i)
  {
    for (Id k = A.rowBegin[i]; k < A.rowBegin[i + 1]; ++k)
    {
      dense(i, A.column[k]) = A.value[k];
    }
  }
  return dense;
}

/// An independent dense solver: an orthonormal basis of the range of K = L + M by its spectral
/// decomposition, then the largest values of M in it.
std::vector<double> DenseReference(const Discretisation& on, int modes)
{
  const Eigen::MatrixXd M = Dense(MassMatrix(on.space, on.system));
  const Eigen::MatrixXd K = Dense(StiffnessMatrix(on.space, on.system)) + M;
  const Eigen::VectorXd scale =
    K.diagonal().unaryExpr([](double d) { return d > 0.0 ? 1.0 / std::sqrt(d) : 0.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> range(
    scale.asDiagonal() * K * scale.asDiagonal());
  const Eigen::VectorXd weight = range.eigenvalues().unaryExpr(
    [](double value) { return value > 1e-12 ? 1.0 / std::sqrt(value) : 0.0; });
  const Eigen::MatrixXd basis = scale.asDiagonal() * range.eigenvectors() * weight.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
    basis.transpose() * M * basis, Eigen::EigenvaluesOnly);
  std::vector<double> values;
  for (int j = 0; j < modes; ++j)
  {
    values.push_back(1.0 / solver.eigenvalues()[K.rows() - 1 - j] - 1.0);
  }
  return values;
}

/// What must hold for every spectrum: order, M-orthonormality, true residuals, the sign rule.
void CheckPairs(const Discretisation& on, const Spectrum& spectrum)
{
  const SparseMatrix mass = MassMatrix(on.space, on.system);
  const SparseMatrix stiffness = StiffnessMatrix(on.space, on.system);
  const Id count = static_cast<Id>(spectrum.eigenvalues.size());
  ASSERT_EQ(spectrum.vectors.cols(), count);
  ASSERT_EQ(spectrum.residuals.size(), spectrum.eigenvalues.size());
  EXPECT_TRUE(std::is_sorted(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end()));
  MultiVector massX;
  MultiVector stiffnessX;
  Multiply(mass, spectrum.vectors, massX);
  Multiply(stiffness, spectrum.vectors, stiffnessX);
  const Eigen::MatrixXd gram = spectrum.vectors.transpose() * massX;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(), 1e-9);
  for (Id j = 0; j < count; ++j)
  {
    const Eigen::VectorXd r = stiffnessX.col(j) - spectrum.eigenvalues[j] * massX.col(j);
    // |r|² <= |L + shift M| rᵀBr up to the quality of B, and the norm of L is below 10.
    const double bound = 10.0 * spectrum.residuals[j] * std::sqrt(spectrum.eigenvalues[j]);
    EXPECT_LT(r.norm(), bound + 1e-9) << "mode " << j;
    // Of two entries of about the same magnitude the first decides.
    EXPECT_GT(massX.col(j).maxCoeff(), (1.0 - 3e-6) * massX.col(j).cwiseAbs().maxCoeff());
  }
}

/// The largest relative error of the modes behind the constants.
double LargestError(const std::vector<double>& values, const std::vector<double>& exact)
{
  double error = 0.0;
  for (std::size_t j = 0; j < values.size(); ++j)
  {
    error = std::max(error, exact[j] > 0.0 ? std::abs(values[j] / exact[j] - 1.0) : values[j]);
  }
  return error;
}

/// l (l + 1), each 2 l + 1 times, for `spheres` unit spheres.
std::vector<double> SphereValues(int modes, int spheres = 1)
{
  std::vector<double> values;
  for (int l = 0; static_cast<int>(values.size()) < modes; ++l)
  {
    values.insert(values.end(), (2 * l + 1) * spheres, l * (l + 1.0));
  }
  values.resize(modes);
  return values;
}

TEST(Spectrum, SmallSpaceEqualsDenseReference)
{
  const Discretisation on = DiscretiseExactly(Torus(48, 24, 1.0, 0.4), 3);
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
  const Discretisation on = DiscretiseExactly(TrefoilTube(120, 16, 0.12), 4);
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
  // Two windows, the second of which has few vectors to start from: the coarser level is small. The
  // dense solver shows that no pair is missed.
  const Discretisation on = DiscretiseExactly(TrefoilTube(120, 16, 0.12), 4);
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
  const TriangleMesh mesh = GeodesicSphere(48);
  const std::vector<double> exact = SphereValues(100);
  double errors[2];
  for (const int depth : { 4, 5 })
  {
    const Discretisation on = DiscretiseExactly(mesh, depth);
    const Spectrum spectrum = Solve(on, 100, 1e-6); // far below the discretisation error
    EXPECT_TRUE(spectrum.converged);
    CheckPairs(on, spectrum);
    errors[depth - 4] = LargestError(WorldValues(on, spectrum), exact);
  }
  EXPECT_LT(errors[1], 0.015);
  EXPECT_GT(errors[0] / errors[1], 3.0); // order two is a factor of four
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
  // Bilinear elements are (π k h)² / 12 too high; k = 5 and h = 1/32 are the worst: 2 %.
  const Discretisation flat = DiscretiseExactly(mesh, 5);
  const Spectrum spectrum = Solve(flat, 30);
  EXPECT_TRUE(spectrum.converged);
  CheckPairs(flat, spectrum);
  EXPECT_LT(LargestError(WorldValues(flat, spectrum), exact), 0.021);
  // Out of the grid's planes and diagonals the eight functions of a cell act like four.
  const Discretisation tilted = DiscretiseExactly(Transform(mesh, { 1, 2, 3 }, 0.7), 5);
  EXPECT_LT(LargestError(WorldValues(tilted, Solve(tilted, 30)), exact), 0.021);
}

TEST(Spectrum, AxisAlignedCubeHasItsMultiplicities)
{
  // On grid planes half of the functions of a cell are null on the surface: M is singular.
  const Discretisation on = DiscretiseExactly(Box(4), 4);
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
    const Discretisation on = DiscretiseExactly(mesh, 5, connectivityAware);
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
  // Three spheres of radius 1 in a cube of side 8 and 32 cells a side: 12 cells apart, so that all
  // lie equally in the grid and every eigenvalue comes in threes.
  TriangleMesh mesh = GeodesicSphere(8);
  for (const double x : { 3.0, 6.0 })
  {
    mesh = Join(mesh, Transform(GeodesicSphere(8), { 0, 0, 1 }, 0.0, 1.0, { x, 0, 0 }));
  }
  const Discretisation on = DiscretiseExactly(mesh, 5);
  const Spectrum spectrum = Solve(on, 75); // 3 (1 + 3 + 5 + 7 + 9): all of degree 4
  EXPECT_TRUE(spectrum.converged);
  EXPECT_FALSE(spectrum.cutsMultiplet);
  CheckPairs(on, spectrum);
  for (int j = 3; j < 75; j += 3)
  {
    EXPECT_NEAR(spectrum.eigenvalues[j + 2] / spectrum.eigenvalues[j], 1.0, 1e-7) << "mode " << j;
  }
}

Spectrum SolveWhole(const Discretisation& on, int modes)
{
  SpectrumOptions options;
  options.numberOfModes = modes;
  options.completeMultiplets = true;
  return ComputeSpectrum(on.space, on.system, options);
}

TEST(Spectrum, AMultipletAtTheEndIsCompletedOrReported)
{
  const Discretisation on = DiscretiseExactly(GeodesicSphere(24), 5);
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
  // The first value of 8 equal cubes is 24-fold, more than guards reach; so are the zeros.
  const Discretisation on = DiscretiseExactly(CubeArray(2, 2, 1.0), 4);
  ASSERT_EQ(on.space.numberOfComponents, 8);
  EXPECT_EQ(SolveWhole(on, 3).eigenvalues.size(), 8u);
  EXPECT_TRUE(Solve(on, 3).cutsMultiplet);
  EXPECT_FALSE(Solve(on, 8).cutsMultiplet);
  const Spectrum spectrum = SolveWhole(on, 9);
  EXPECT_EQ(spectrum.eigenvalues.size(), 32u);
  EXPECT_LT(spectrum.eigenvalues[31] / spectrum.eigenvalues[8], 1.01);
  CheckPairs(on, spectrum);
}

TEST(Spectrum, EstimatedErrorsAreTheTrueOnesWithinAFactorOfTwo)
{
  const TriangleMesh mesh = GeodesicSphere(96);
  const std::vector<double> exact = SphereValues(100);
  const Discretisation on = DiscretiseExactly(mesh, 5);
  const Spectrum spectrum = Solve(on, 100);
  const std::vector<double> values = WorldValues(on, spectrum);
  EXPECT_EQ(spectrum.estimatedErrors[0], 0.0);
  const double areaOfFacets = SurfaceArea(mesh) / (4 * Pi); // most of their own error
  for (int j = 1; j < 100; ++j)
  {
    // A factor of two: members of a multiplet may change places between the levels. The facets'
    // error beyond their area is 2e-4.
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
    EXPECT_LE(depth, 5); // 0.3 % at depth 5: no deeper than needed
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

TEST(Spectrum, ManyComponentsHaveNoSmallLevel)
{
  // A cube has 4 cells a side and a period of 6: all lie equally in the grid.
  const Discretisation on = DiscretiseExactly(CubeArray(3, 2, 0.5), 4);
  ASSERT_EQ(on.space.numberOfComponents, 27);
  ASSERT_GT(on.space.levels[on.system.elements.size() - 1].numberOfFunctions, 600);
  const Spectrum spectrum = Solve(on, 40);
  EXPECT_TRUE(spectrum.converged);
  CheckPairs(on, spectrum);
  EXPECT_EQ(std::count(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end(), 0.0), 27);
  // The first value of a cube is threefold, that of 27 cubes 81-fold.
  EXPECT_NEAR(spectrum.eigenvalues.back() / spectrum.eigenvalues[27], 1.0, 1e-7);
}

TEST(Spectrum, ComponentsWithoutAreaHaveNoModes)
{
  // A triangle of collinear points, one of equal points, and an oblique line whose pieces have an
  // area of rounding, far from the sphere.
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
    const Discretisation on = DiscretiseExactly(mesh, depth);
    const Spectrum spectrum = Solve(on, 16);
    EXPECT_TRUE(spectrum.converged);
    CheckPairs(on, spectrum);
    EXPECT_EQ(std::count(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end(), 0.0), 1);
    EXPECT_TRUE(spectrum.vectors.allFinite());
    // Twelve cells across a sphere (depth 5) or three (depth 3).
    EXPECT_LT(LargestError(WorldValues(on, spectrum), SphereValues(16)), depth == 3 ? 0.7 : 0.05);
  }
}

TEST(Spectrum, OnlyZeroModesAskedFor)
{
  const Discretisation on = DiscretiseExactly(CubeArray(2, 2, 1.0), 4);
  ASSERT_EQ(on.space.numberOfComponents, 8);
  for (const int modes : { 1, 5, 8 })
  {
    const Spectrum spectrum = Solve(on, modes);
    EXPECT_TRUE(spectrum.converged);
    CheckPairs(on, spectrum);
    EXPECT_EQ(spectrum.eigenvalues, std::vector<double>(modes, 0.0));
  }
}

TEST(Spectrum, MoreModesThanExist)
{
  // A flat square in a grid plane, 4 x 4 cells: 25 functions of the plane, the rest is null.
  const Discretisation on = DiscretiseExactly(FlatRectangle(4, 4), 2);
  const Spectrum spectrum = Solve(on, 100);
  EXPECT_TRUE(spectrum.truncated);
  EXPECT_TRUE(spectrum.converged);
  EXPECT_EQ(spectrum.eigenvalues.size(), 25u);
  CheckPairs(on, spectrum);
  EXPECT_FALSE(Solve(on, 25).truncated);
}

TEST(Spectrum, RepeatsBitForBitOnAnyNumberOfThreads)
{
  const Discretisation on = DiscretiseExactly(TrefoilTube(120, 16, 0.12), 4);
  const Spectrum one = Solve(on, 20, 1e-8, 1);
  for (const int threads : { 1, 2, 3 })
  {
    const Spectrum again = Solve(on, 20, 1e-8, threads);
    EXPECT_EQ(one.eigenvalues, again.eigenvalues);
    EXPECT_TRUE(one.vectors == again.vectors);
    EXPECT_EQ(one.residuals, again.residuals);
  }
}

TEST(Spectrum, ScalesWithTheInverseSquareOfLength)
{
  const TriangleMesh mesh = Torus(48, 24, 1.0, 0.4);
  const Discretisation small = DiscretiseExactly(mesh, 4);
  const Discretisation large =
    DiscretiseExactly(Transform(mesh, { 0, 0, 1 }, 0.0, 1024.0), 4); // exact in binary
  const std::vector<double> a = WorldValues(small, Solve(small, 20));
  const std::vector<double> b = WorldValues(large, Solve(large, 20));
  for (std::size_t j = 1; j < a.size(); ++j)
  {
    EXPECT_NEAR(b[j] * 1024.0 * 1024.0 / a[j], 1.0, 1e-8); // the tolerance of the solve
  }
}

TEST(Spectrum, ReportsWhatHasNotConverged)
{
  const Discretisation on = DiscretiseExactly(GeodesicSphere(16), 4);
  SpectrumOptions options;
  options.numberOfModes = 20;
  options.tolerance = 1e-12;
  options.maximumIterations = 1;
  const Spectrum spectrum = ComputeSpectrum(on.space, on.system, options);
  EXPECT_FALSE(spectrum.converged);
  EXPECT_LT(spectrum.numberOfConverged, 20);
  EXPECT_EQ(spectrum.iterations, 1);
  CheckPairs(on, spectrum);
}

TEST(Spectrum, ReportsProgressAndStopsWhenAsked)
{
  const Discretisation on = DiscretiseExactly(GeodesicSphere(16), 4);
  SpectrumOptions options;
  options.numberOfModes = 20;
  std::vector<double> reports;
  ComputeSpectrum(on.space, on.system, options,
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
    ComputeSpectrum(
      on.space, on.system, options, Progress([fraction](double done) { return done < fraction; }));
  };
  EXPECT_THROW(stopAt(0.0), Aborted);
  EXPECT_THROW(stopAt(0.5), Aborted);
}

TEST(Spectrum, RefusesOptionsOutOfRange)
{
  const Discretisation on = DiscretiseExactly(Box(2), 2);
  EXPECT_THROW(Solve(on, 0), InvalidInput);
  EXPECT_THROW(Solve(on, 3, 0.0), InvalidInput);
  EXPECT_THROW(Solve(on, 3, 1.0), InvalidInput);
}

} // namespace
} // namespace gridfem
