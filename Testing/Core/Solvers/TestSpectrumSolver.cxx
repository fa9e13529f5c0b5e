// The solver of a spectrum: the eigenvalues of a sphere, the stages that a change repeats, and the
// depth for a wanted accuracy.
#include "Largest.h"
#include "Meshes.h"

#include "Solvers/LocalSurface.h"
#include "Solvers/SpectrumSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

class Spectra : public ::testing::Test
{
protected:
  Spectra()
  {
    asked.space.depth = 4;
    options.numberOfModes = 9;
  }

  const std::shared_ptr<const TriangleMesh> mesh =
    std::make_shared<const TriangleMesh>(GeodesicSphere(16, 2.0));
  SurfaceOptions asked = SpectrumSolver::SurfaceDefaults();
  SpectrumSolver::Options options;
  Stages stages;
  SpectrumSolver solver;
};

TEST_F(Spectra, OneShotIsStepwiseAndGivesTheSphere)
{
  asked.space.depth = 5;
  const SpectrumSolver::Result once = SpectrumSolver::Solve(mesh, {}, options, asked);
  LocalSurface surface(stages, mesh, asked);
  const SpectrumSolver::Result& stepwise = solver.Update(surface, {}, options, {});
  EXPECT_EQ(once.eigenvalues, stepwise.eigenvalues);
  EXPECT_EQ(once.atPoints.col(3), solver.ModesAtPoints(surface, 3, 1).col(0));
  EXPECT_EQ(once.depth, 5);
  ASSERT_EQ(once.NumberOfModes(), 9);
  EXPECT_TRUE(once.warnings.empty());
  for (int k = 1; k < 9; ++k)
  {
    // l (l + 1) / r²; depth 5 and a sphere of flat triangles are good for two percent
    const double exact = (k < 4 ? 2.0 : 6.0) / 4.0;
    EXPECT_NEAR(once.eigenvalues[k], exact, 0.02 * exact);
  }
  // Mode 0 is constant, and the integral of its square is 1.
  EXPECT_NEAR(once.atPoints(0, 0), 1.0 / std::sqrt(SurfaceArea(*mesh)), 1e-9);
}

TEST_F(Spectra, OnlyTheSolveRunsAgain)
{
  LocalSurface surface(stages, mesh, asked);
  solver.Update(surface, {}, options, {});
  solver.Update(surface, {}, options, {});
  EXPECT_EQ(stages.Runs(SolveStage), 1);
  options.equation.solve.tolerance = 1e-4;
  solver.Update(surface, {}, options, {});
  options.numberOfModes = 4;
  EXPECT_EQ(solver.Update(surface, {}, options, {}).NumberOfModes(), 4);
  EXPECT_EQ(stages.Runs(SolveStage), 3);
  EXPECT_EQ(stages.Runs(SpaceStage), 1);
}

TEST_F(Spectra, ACutGroupIsToldOrCompleted)
{
  options.numberOfModes = 6;
  LocalSurface surface(stages, mesh, asked);
  EXPECT_TRUE(solver.Update(surface, {}, options, {}).spectrum.cutsMultiplet);
  EXPECT_TRUE(solver.Update(surface, {}, options, {}).warnings.empty());
  SpectrumSolver::Input input;
  input.completesMultiplets = true;
  const SpectrumSolver::Result& whole = solver.Update(surface, input, options, {});
  EXPECT_EQ(whole.NumberOfModes(), 9); // 1 + 3 + 5
  EXPECT_FALSE(whole.spectrum.cutsMultiplet);
}

TEST_F(Spectra, TheAccuracyChoosesTheDepth)
{
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    asked.choice.kind = kind;
    options.accuracy = 0.05;
    Stages own;
    LocalSurface surface(own, mesh, asked);
    SpectrumSolver spectra;
    const SpectrumSolver::Result result = spectra.Update(surface, {}, options, {});
    EXPECT_TRUE(result.isAccurate);
    const std::vector<double>& errors = result.spectrum.estimatedErrors;
    EXPECT_LE(*std::max_element(errors.begin(), errors.end()), 0.05);
    const std::int64_t runs = own.Runs(SolveStage);
    EXPECT_EQ(spectra.Update(surface, {}, options, {}).depth, result.depth);
    EXPECT_EQ(own.Runs(SolveStage), runs);
    options.accuracy = 0.002;
    EXPECT_GT(spectra.Update(surface, {}, options, {}).depth, result.depth);
  }
}

namespace
{

/// A strip with 16 box-shaped pleats, which unfolds to 3 x 0.3.
TriangleMesh Pleats()
{
  constexpr int Periods = 16;
  constexpr int Cuts = 4; // of each of the four sides of a pleat
  constexpr double Period = 1.0 / Periods;
  TriangleMesh mesh = FlatRectangle(Periods * 4 * Cuts, 6, 3.0, 0.3);
  for (Vec3& point : mesh.points)
  {
    const double along = point[0] / 3.0 * Periods;
    const double part = 4.0 * (along - std::floor(along));
    const double across[4] = { 0.0, 1.0, 1.0, 0.0 };
    const int side = std::min(3, static_cast<int>(part));
    const double rest = part - side;
    const double x = side == 0 ? 0.5 * rest : side == 1 ? 0.5 : side == 2 ? 0.5 + 0.5 * rest : 1.0;
    const double z = side % 2 == 0 ? across[side] : side == 1 ? rest : 1.0 - rest;
    point = Vec3(Period * (std::floor(along) + x), point[1], Period * z);
  }
  return Transform(mesh, { 2, 1, 3 }, 0.6);
}

} // namespace

/// Coarse grids do not see the pleats: their eigenvalues are too large by more than 100 %, and
/// differ little from each other.
TEST_F(Spectra, AnAccuracyIsReachedOnlyWhereTheSurfaceIsResolved)
{
  const auto pleats = std::make_shared<const TriangleMesh>(Pleats());
  const auto errorOf = [](const SpectrumSolver::Result& result)
  {
    double largest = 0.0;
    for (int k = 1; k < 6; ++k)
    {
      const double exact = std::pow(3.14159265358979323846 * k / 3.0, 2);
      largest = Larger(largest, std::abs(result.eigenvalues[k] / exact - 1.0));
    }
    return largest;
  };
  options.numberOfModes = 6;
  asked.space.depth = 3;
  const SpectrumSolver::Result coarse = SpectrumSolver::Solve(pleats, {}, options, asked);
  EXPECT_GT(errorOf(coarse), 1.0);
  EXPECT_FALSE(coarse.isErrorTrusted);
  for (const double accuracy : { 0.3, 0.1 })
  {
    options.accuracy = accuracy;
    const SpectrumSolver::Result result = SpectrumSolver::Solve(pleats, {}, options, asked);
    EXPECT_TRUE(result.isAccurate);
    EXPECT_TRUE(result.warnings.empty());
    EXPECT_LE(errorOf(result), accuracy);
  }
}

/// Neither another accuracy nor another tolerance confirms the errors of a depth by themselves.
/// Each update chooses the depth that a new solver chooses, and confirms it likewise.
TEST_F(Spectra, AnAccuracyIsConfirmedAsInANewSolver)
{
  const auto pleats = std::make_shared<const TriangleMesh>(Pleats());
  options.numberOfModes = 6;
  LocalSurface surface(stages, pleats, asked);
  for (const double accuracy : { 0.3, 0.15, 0.1 })
  {
    for (const double tolerance : { 1e-6, 1e-4 })
    {
      options.accuracy = accuracy;
      options.equation.solve.tolerance = tolerance;
      const SpectrumSolver::Result fresh = SpectrumSolver::Solve(pleats, {}, options, asked);
      const SpectrumSolver::Result& result = solver.Update(surface, {}, options, {});
      EXPECT_EQ(result.depth, fresh.depth) << accuracy;
      EXPECT_EQ(result.isAccurate, fresh.isAccurate) << accuracy;
      EXPECT_EQ(result.warnings, fresh.warnings) << accuracy;
    }
  }
}

/// A surface whose functions a basis gives.
class GivenSurface : public LocalSurface
{
public:
  GivenSurface(
    Stages& stages, std::shared_ptr<const TriangleMesh> mesh, const SurfaceOptions& options)
    : Surface(stages), LocalSurface(stages, std::move(mesh), options)
  {
  }
  bool AreFunctionsGiven() const override { return true; }
};

TEST_F(Spectra, ADepthThatIsGivenStaysAndTheAccuracyIsReported)
{
  options.accuracy = 1e-5;
  GivenSurface surface(stages, mesh, asked);
  const SpectrumSolver::Result& result = solver.Update(surface, {}, options, {});
  EXPECT_EQ(result.depth, 4);
  EXPECT_FALSE(result.isAccurate);
  EXPECT_EQ(result.warnings.size(), 1u);
}

TEST_F(Spectra, TheCostOfManyModesIsAnnounced)
{
  const std::shared_ptr<const TriangleMesh> large =
    std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  asked.space.depth = 7;
  options.numberOfModes = 5000;
  std::string cost;
  SpectrumSolver::Input input;
  input.announce = [&](const std::string& text, bool) { cost = text; };
  const Progress aborts([&](double) { return cost.empty(); });
  EXPECT_THROW(SpectrumSolver::Solve(large, input, options, asked, { 0, aborts }), Aborted);
  EXPECT_NE(cost.find("5000 modes"), std::string::npos);
}

/// Two spheres that share one point. It has one hat, but no function of the grid joins the sheets.
TEST_F(Spectra, SheetsThatTouchInAPointAreOneSurfaceOnHatsAlone)
{
  const TriangleMesh sphere = GeodesicSphere(8);
  const auto two = std::make_shared<const TriangleMesh>(
    Join(sphere, Transform(sphere, { 0, 0, 1 }, 0.0, 1.0, { 2, 0, 0 })));
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    asked.choice.kind = kind;
    const SpectrumSolver::Result result = SpectrumSolver::Solve(two, {}, options, asked);
    EXPECT_EQ(result.spectrum.numberOfConstants, kind == FunctionKind::Hats ? 1 : 2);
  }
}

} // namespace
} // namespace gridfem
