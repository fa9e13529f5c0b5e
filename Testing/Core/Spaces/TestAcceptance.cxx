// Tests the method as a whole against figures of the thesis and numbers that the project promises.
#include "Discretization.h"
#include "Equations/Poisson.h"
#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Spectrum/Spectrum.h"
#include "Support/Meshes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

GridFunctions SpaceOf(const TriangleMesh& mesh, int depth, bool connectivityAware = true)
{
  SpaceOptions options;
  options.depth = depth;
  options.connectivityAware = connectivityAware;
  return BuildGridFunctions(mesh, options);
}

/// Returns a color: a smooth function of the position that neither space represents exactly.
Field Color(const TriangleMesh& mesh)
{
  Field field;
  field.values.resize(mesh.points.size(), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3& p = mesh.points[i];
    field.values(i, 0) = std::sin(6.0 * p[0] + 1.0) * std::cos(5.0 * p[1]) + std::sin(4.0 * p[2]);
  }
  return field;
}

PoissonSolution FitField(const TriangleMesh& mesh, const GridFunctions& space, const Field& f,
  double unitCubeWeight, Index coarsestSize = 256,
  double normalStabilization = DefaultNormalStabilization)
{
  const QuadratureRule& rule = TriangleRule(2);
  const LevelOperators system =
    BuildLevelOperators(space, rule, 0, coarsestSize, normalStabilization);
  PoissonOptions options;
  options.screeningWeight = unitCubeWeight * std::pow(0.25, space.GetGrid().depth);
  const Multigrid multigrid =
    BuildMultigrid(ViewOf(space, system), options.screeningWeight, 1.0, options.multigrid);
  return SolvePoisson(ViewOf(space, system), multigrid, IntegrateValues(space, mesh, f, rule),
    IntegrateGradientsOf(space, mesh, f, nullptr, rule), options);
}

std::vector<double> Eigenvalues(const GridFunctions& space, int count, int quadratureDegree = 2)
{
  const LevelOperators system = BuildLevelOperators(space, TriangleRule(quadratureDegree));
  SpectrumOptions options;
  options.numberOfModes = count;
  const Spectrum spectrum = ComputeSpectrum(ViewOf(space, system), options);
  EXPECT_TRUE(spectrum.converged);
  std::vector<double> world;
  for (const double value : spectrum.eigenvalues)
  {
    world.push_back(value / std::pow(space.GetGrid().spacing, 2));
  }
  return world;
}

} // namespace

class RotatedCube : public ::testing::TestWithParam<std::tuple<int, double>>
{
};

// Thesis Fig. 4.11: Gauss-Seidel stalls on a cube that is barely turned. The cube has side 0.55 in
// a unit cube, whose corners are held by two tiny triangles. The color is fitted with its gradient
// at screening weight 0.01.
TEST_P(RotatedCube, TakesFewIterations)
{
  const auto [depth, degrees] = GetParam();
  TriangleMesh corners;
  corners.points = { { 0, 0, 0 }, { 1e-3, 0, 0 }, { 0, 1e-3, 0 }, { 1, 1, 1 }, { 1 - 1e-3, 1, 1 },
    { 1, 1 - 1e-3, 1 } };
  corners.triangles = { { 0, 1, 2 }, { 3, 4, 5 } };
  const TriangleMesh centered = Box(16, Vec3::Constant(-0.275), Vec3::Constant(0.275));
  const TriangleMesh cube =
    Transform(centered, { 1, 1, 1 }, degrees * std::acos(-1.0) / 180.0, 1.0, Vec3::Constant(0.5));
  const TriangleMesh mesh = Join(cube, corners);
  const GridFunctions space = SpaceOf(mesh, depth);
  ASSERT_NEAR(space.GetGrid().spacing, std::pow(0.5, depth), 1e-15);
  const PoissonSolution solution = FitField(mesh, space, Color(mesh), 0.01);
  EXPECT_TRUE(solution.report.converged);
  EXPECT_LE(solution.report.iterations, 4 * depth - 8); // 12 at depth 5, 16 at depth 6; the
                                                        // benchmark covers depth 7
  RecordProperty("iterations", solution.report.iterations);
  const PoissonSolution stabilized = FitField(mesh, space, Color(mesh), 0.01, 256, 1e-2);
  EXPECT_TRUE(stabilized.report.converged);
  EXPECT_LE(stabilized.report.iterations, 7); // at any depth
}

INSTANTIATE_TEST_SUITE_P(Angles, RotatedCube,
  ::testing::Combine(
    ::testing::Values(5, 6), ::testing::Values(0.0, 0.01, 0.1, 1.0, 5.0, 15.0, 45.0)));

// Thesis Fig. 4.5 and 6.4: another place in the grid gives another system with almost the same
// spectrum.
TEST(Acceptance, RigidMotionsHardlyChangeTheSpectrum)
{
  const TriangleMesh knot = TrefoilTube(200, 16, 0.3);
  std::vector<double> low;
  std::vector<double> high;
  for (int turn = 0; turn < 5; ++turn)
  {
    const Vec3 axis(1.0, 2.0 - 0.8 * turn, 0.5 + 0.6 * turn);
    const std::vector<double> values =
      Eigenvalues(SpaceOf(Transform(knot, axis, 0.7 * turn), 7), 50);
    low.resize(values.size(), values.back());
    high.resize(values.size(), 0.0);
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      low[k] = std::min(low[k], values[k]);
      high[k] = std::max(high[k], values[k]);
    }
  }
  for (std::size_t k = 1; k < low.size(); ++k)
  {
    EXPECT_LT(high[k] / low[k] - 1.0, 0.01) << k;
  }
}

// Thesis Fig. 4.4: the rule with three points is enough.
TEST(Acceptance, QuadratureRulesAgreeOnTheSpectrum)
{
  const TriangleMesh mesh = TrefoilTube(120, 16, 0.5);
  const GridFunctions space = SpaceOf(mesh, 5);
  const std::vector<double> reference = Eigenvalues(space, 100, 12);
  for (const int degree : { 2, 4, 6, 10 })
  {
    const std::vector<double> values = Eigenvalues(space, 100, degree);
    for (std::size_t k = 1; k < reference.size(); ++k)
    {
      EXPECT_NEAR(values[k], reference[k], 1e-3 * reference[k]) << degree << " " << k;
    }
  }
}

// Thesis Fig. 6.5, 6.6: the spaces differ only on coarse levels. This changes the convergence.
TEST(Acceptance, SeparatedCubesConvergeFasterWhenConnectivityAware)
{
  const TriangleMesh cubes = CubeArray(6, 2, 1.0);
  const GridFunctions plain = SpaceOf(cubes, 5, false);
  const GridFunctions aware = SpaceOf(cubes, 5, true);
  const LevelOperators plainSystem = BuildLevelOperators(plain, TriangleRule(2));
  const LevelOperators awareSystem = BuildLevelOperators(aware, TriangleRule(2));
  const SparseMatrix plainMatrix = StiffnessMatrix(plain, plainSystem);
  const SparseMatrix awareMatrix = StiffnessMatrix(aware, awareSystem);
  EXPECT_EQ(plainMatrix.column, awareMatrix.column);
  EXPECT_EQ(plainMatrix.value, awareMatrix.value);
  EXPECT_EQ(MassMatrix(plain, plainSystem).value, MassMatrix(aware, awareSystem).value);

  // Every level is used. Otherwise the finest level, which consists of small components, would be
  // solved directly.
  const Field color = Color(cubes);
  const Index all = FunctionsPerPatch;
  const SolveReport plainReport = FitField(cubes, plain, color, 0.01, all).report;
  const SolveReport awareReport = FitField(cubes, aware, color, 0.01, all).report;
  EXPECT_TRUE(awareReport.converged);
  EXPECT_LT(awareReport.convergenceFactor, plainReport.convergenceFactor);
}

// Thesis Fig. 6.2: stripes along a knot whose strands nearly touch.
TEST(Acceptance, StripesOnAKnotNeedConnectivity)
{
  constexpr int Along = 480;
  constexpr int Around = 24;
  const TriangleMesh knot = TrefoilTube(Along, Around, 0.82);
  Field stripes;
  stripes.values.resize(knot.points.size(), 1);
  for (std::size_t i = 0; i < knot.points.size(); ++i)
  {
    stripes.values(i, 0) = std::sin(2.0 * std::acos(-1.0) * 5.0 * double(i / Around) / Along);
  }
  double error[2];
  for (const bool aware : { false, true })
  {
    const GridFunctions space = SpaceOf(knot, 6, aware);
    const PoissonSolution fit = FitField(knot, space, stripes, 1e8); // nearly the projection
    const MultiVector values = EvaluateAtPoints(space, fit.coefficients);
    error[aware] = (values - stripes.values).norm() / stripes.values.norm();
  }
  EXPECT_LT(error[1], 0.1 * error[0]);
}

// A field on one sheet does not affect the other sheet, unless the space couples them.
TEST(Acceptance, NearSheetsDoNotFeelEachOther)
{
  const TriangleMesh outer = GeodesicSphere(24, 1.0);
  const TriangleMesh sheets = Join(outer, GeodesicSphere(24, 0.99));
  const std::size_t inner = outer.points.size();
  Field f;
  f.values.setZero(sheets.points.size(), 1);
  f.values.topRows(inner).setOnes();
  const GridFunctions aware = SpaceOf(sheets, 4, true);
  const GridFunctions plain = SpaceOf(sheets, 4, false);
  const PoissonSolution fit = FitField(sheets, aware, f, 1.0);
  EXPECT_TRUE(fit.report.converged);
  const MultiVector apart = EvaluateAtPoints(aware, fit.coefficients);
  EXPECT_LT((apart - f.values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);
  const MultiVector coupled = EvaluateAtPoints(plain, FitField(sheets, plain, f, 1.0).coefficients);
  EXPECT_GT((coupled - f.values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 0.1);
}
