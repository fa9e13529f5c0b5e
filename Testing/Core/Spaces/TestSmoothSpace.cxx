// Tests the quadratic B-splines of a grid: their levels, their smoothness, the order of their
// errors, and that few iterations solve with them.
#include "Spaces/SmoothSpace.h"

#include "Equations/Poisson.h"
#include "Integrals/CellBasis.h"
#include "Integrals/QuadratureSamples.h"
#include "Largest.h"
#include "Spaces.h"
#include "SpectrumChecks.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

SmoothSpace Build(const TriangleMesh& mesh, int depth, bool connectivityAware = true)
{
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.connectivityAware = connectivityAware;
  return BuildSmoothSpace(mesh, options);
}

/// Solves (λM + L) u = b for a random solution with λ = 100 / area. Returns the report.
SolveReport SolveRandom(const SmoothSpace& space)
{
  PoissonOptions options;
  double area = 0.0;
  for (const double integral : space.Integrals())
  {
    area += integral;
  }
  options.screeningWeight = 100.0 / area;
  options.solve.tolerance = 1e-8;
  const Multigrid multigrid =
    BuildMultigrid(space, options.screeningWeight, 1.0, options.multigrid);
  MultiVector load;
  Multiply(space.Matrix(0, 1.0, 1.0 / options.screeningWeight),
    RandomValues(space.NumberOfFunctions(0), 1), load);
  return SolvePoisson(space, multigrid, load, {}, options).report;
}

/// Returns eigenvalues in world units, to more digits than the space has.
std::vector<double> EigenvaluesOf(const SmoothSpace& space, int modes)
{
  SpectrumOptions options;
  options.numberOfModes = modes;
  options.tolerance = 1e-10;
  const Spectrum spectrum = ComputeSpectrum(space, options);
  EXPECT_TRUE(spectrum.converged);
  std::vector<double> world = spectrum.eigenvalues;
  for (double& value : world)
  {
    value /= space.UnitLength() * space.UnitLength();
  }
  return world;
}

/// Returns the eigenvalues π² (i² / a² + j² / b²) of a rectangle with free sides.
std::vector<double> RectangleValues(double a, double b, int count)
{
  std::vector<double> values;
  for (int i = 0; i < 20; ++i)
  {
    for (int j = 0; j < 20; ++j)
    {
      values.push_back(Pi * Pi * (i * i / (a * a) + j * j / (b * b)));
    }
  }
  std::sort(values.begin(), values.end());
  values.resize(count);
  return values;
}

} // namespace

/// The gradients of trilinear functions jump at the faces of cells, which shows as kinks.
TEST(SmoothSpace, HasContinuousGradients)
{
  const TriangleMesh mesh = Transform(FlatRectangle(3, 3), { 1, 2, 3 }, 0.5);
  const SmoothSpace space = Build(mesh, 3);
  const GridFunctions& grid = space.Grid();
  const auto largestJump = [&grid](const auto& level)
  {
    const MultiVector u = RandomValues(level.numberOfFunctions, 1);
    using Values = std::array<double, std::tuple_size_v<std::decay_t<decltype(level.dof[0])>>>;
    std::vector<std::pair<Vec3, char>> first(grid.clipped.position.size(), { Vec3::Zero(), 0 });
    double jump = 0.0;
    for (Id piece = 0; piece < grid.clipped.NumberOfPieces(); ++piece)
    {
      const Index patch = grid.piecePatch[piece];
      for (Index k = grid.clipped.pieceBegin[piece]; k < grid.clipped.pieceBegin[piece + 1]; ++k)
      {
        const Index point = grid.clipped.corners[k];
        std::array<Values, 3> slope;
        BasisGradients(grid.clipped.position[point] - CellCorner(level.cell[patch]), slope);
        Vec3 gradient = Vec3::Zero();
        for (std::size_t i = 0; i < level.dof[patch].size(); ++i)
        {
          gradient += u(level.dof[patch][i], 0) * Vec3(slope[0][i], slope[1][i], slope[2][i]);
        }
        auto& [known, isKnown] = first[point];
        jump = isKnown ? Larger(jump, (gradient - known).norm()) : jump;
        known = gradient;
        isKnown = 1;
      }
    }
    return jump;
  };
  EXPECT_LT(largestJump(space.Operators().levels.front()), 1e-12);
  EXPECT_GT(largestJump(grid.Finest()), 0.1);
}

/// The sides are not parallel to the grid, and the mesh has no error of its own.
TEST(SmoothSpace, HasEigenvaluesOfOrderFourOnARectangle)
{
  const TriangleMesh mesh = Transform(FlatRectangle(4, 3, 1.0, 0.7), { 1, 2, 3 }, 0.5);
  const std::vector<double> exact = RectangleValues(1.0, 0.7, 6);
  double last = 0.0;
  for (const int depth : { 4, 5, 6 })
  {
    const double error = LargestError(EigenvaluesOf(Build(mesh, depth), 6), exact);
    RecordProperty("error" + std::to_string(depth), std::to_string(error));
    if (last > 0.0)
    {
      EXPECT_GT(last / error, 11.0) << depth; // 16 in the limit
    }
    last = error;
  }
  EXPECT_LT(last, 1e-6);
}

/// The lowest mode along the longer side is a cosine. No data are interpolated.
TEST(SmoothSpace, HasFunctionsOfOrderThreeOnARectangle)
{
  const TriangleMesh flat = FlatRectangle(32, 24, 1.0, 0.7);
  const TriangleMesh mesh = Transform(flat, { 1, 2, 3 }, 0.5);
  MultiVector exact(static_cast<Id>(flat.points.size()), 1);
  for (Id k = 0; k < exact.rows(); ++k)
  {
    exact(k, 0) = std::cos(Pi * flat.points[k][0]);
  }
  double last = 0.0;
  for (const int depth : { 3, 4, 5 })
  {
    const SmoothSpace space = Build(mesh, depth);
    SpectrumOptions options;
    options.numberOfModes = 2;
    options.tolerance = 1e-12;
    const Spectrum spectrum = ComputeSpectrum(space, options);
    const MultiVector mode = space.ValuesAtPoints(spectrum.vectors.col(1));
    const double size = mode.col(0).dot(exact.col(0)) / exact.squaredNorm();
    const double error = (mode / size - exact).norm() / exact.norm();
    RecordProperty("error" + std::to_string(depth), std::to_string(error));
    if (last > 0.0)
    {
      EXPECT_GT(last / error, 6.0) << depth; // 8 in the limit
    }
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

/// A finer grid on the same mesh is the reference, so that the mesh's own error does not count.
TEST(SmoothSpace, HasEigenvaluesOfOrderFourOnASphere)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.4);
  constexpr int Modes = 9;
  const std::vector<double> reference = EigenvaluesOf(Build(mesh, 5), Modes);
  const double coarse = LargestError(EigenvaluesOf(Build(mesh, 3), Modes), reference);
  const double fine = LargestError(EigenvaluesOf(Build(mesh, 4), Modes), reference);
  EXPECT_GT(coarse / fine, 11.0); // 17 = (256 - 1) / (16 - 1) in the limit
  EXPECT_LT(fine, 1e-3);
}

TEST(SmoothSpace, TakesFewIterationsAtAnyDepth)
{
  const std::vector<std::pair<std::string, TriangleMesh>> meshes = {
    { "sphere", Transform(GeodesicSphere(32), { 1, 2, 3 }, 0.4) },
    { "cube", Transform(Box(12), { 1, 1, 1 }, 0.02) },
    { "torus", Torus(60, 24, 1.0, 0.3) },
    { "sheets", Transform(TwoSheets(6, 0.01), { 1, 0.3, 0 }, 0.4) },
    { "soup", Unweld(Transform(GeodesicSphere(6), { 1, 0, 1 }, 0.3)) },
  };
  for (const auto& [name, mesh] : meshes)
  {
    for (const int depth : { 3, 4, 5 })
    {
      const SolveReport report = SolveRandom(Build(mesh, depth));
      EXPECT_TRUE(report.converged) << name << " " << depth;
      EXPECT_LE(report.iterations, 12) << name << " " << depth;
    }
  }
}

TEST(SmoothSpace, TakesFewIterationsOnRealMeshes)
{
  int found = 0;
  for (const char* const name : { "rocker_arm.ply", "fandisk_32k.ply", "knot2_12k.ply" })
  {
    const std::string path = RealMesh(name);
    if (!path.empty())
    {
      ++found;
      const SolveReport report = SolveRandom(Build(ReadMesh(path), 5));
      EXPECT_TRUE(report.converged) << name;
      EXPECT_LE(report.iterations, 12) << name;
    }
  }
  if (found == 0)
  {
    GTEST_SKIP() << "There are no real meshes.";
  }
}

/// A field on one sheet does not affect the other sheet, unless the space couples them.
TEST(SmoothSpace, KeepsNearSheetsApart)
{
  const TriangleMesh outer = GeodesicSphere(16, 1.0);
  const TriangleMesh sheets = Join(outer, GeodesicSphere(16, 0.99));
  const auto inner = static_cast<Id>(outer.points.size());
  MultiVector f = MultiVector::Zero(static_cast<Id>(sheets.points.size()), 1);
  f.topRows(inner).setOnes();
  double error[2];
  for (const bool aware : { false, true })
  {
    const SmoothSpace space = Build(sheets, 4, aware);
    EXPECT_EQ(space.ComponentsOf(0).count, aware ? 2 : 1);
    PoissonOptions options;
    options.screeningWeight = 1.0;
    const Multigrid multigrid = BuildMultigrid(space, 1.0, 1.0, options.multigrid);
    const PoissonSolution solution = SolvePoisson(
      space, multigrid, space.LoadOfValues({ FieldAssociation::Points, f }), {}, options);
    EXPECT_TRUE(solution.report.converged);
    error[aware] =
      (space.ValuesAtPoints(solution.coefficients) - f).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  }
  EXPECT_GT(error[0], 0.1);
  EXPECT_LT(error[1], 1e-10);
}

/// Cubes a quarter of a cell apart: every cube has functions of its own on every level.
TEST(SmoothSpace, HasFunctionsForEveryCube)
{
  const TriangleMesh cubes = CubeArray(3, 2, 0.1);
  const SmoothSpace aware = Build(cubes, 4);
  for (std::size_t l = 0; l < aware.NumberOfLevels(); ++l)
  {
    EXPECT_EQ(aware.ComponentsOf(l).count, 27) << l;
  }
  EXPECT_EQ(Build(cubes, 4, false).ComponentsOf(0).count, 1);
  const SolveReport report = SolveRandom(aware);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 12);
}

TEST(SmoothSpace, HasTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = Transform(TrefoilTube(60, 10, 0.5), { 1, 2, 3 }, 0.4);
  const MultiVector f = RandomValues(static_cast<Id>(mesh.points.size()), 2);
  MultiVector first;
  std::vector<double> values;
  for (const int threads : { 1, 2, 3 })
  {
    GridSpaceOptions options;
    options.functions.depth = 4;
    options.functions.threads = threads;
    const SmoothSpace space = BuildSmoothSpace(mesh, options);
    PoissonOptions poisson;
    poisson.multigrid.threads = threads;
    const Multigrid multigrid = BuildMultigrid(space, 1.0, 1.0, poisson.multigrid);
    const MultiVector load = space.LoadOfValues({ FieldAssociation::Points, f }, threads);
    const MultiVector solution = SolvePoisson(space, multigrid, load, {}, poisson).coefficients;
    SpectrumOptions spectrum;
    spectrum.multigrid.threads = threads;
    const std::vector<double> eigenvalues = ComputeSpectrum(space, spectrum).eigenvalues;
    if (threads == 1)
    {
      first = solution;
      values = eigenvalues;
    }
    EXPECT_EQ(solution, first) << threads;
    EXPECT_EQ(eigenvalues, values) << threads;
  }
}

TEST(SmoothSpace, RefusesAWeightOutOfRange)
{
  GridSpaceOptions options;
  options.functions.depth = 3;
  options.normalStabilization = 0.0;
  EXPECT_THROW(BuildSmoothSpace(GeodesicSphere(4), options), InvalidInput);
}
