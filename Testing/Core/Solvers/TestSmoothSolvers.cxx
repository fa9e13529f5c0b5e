// Tests solvers on the quadratic functions of a grid, and the solvers that refuse these functions.
#include "Base/Errors.h"
#include "Distance/GeodesicDistance.h"
#include "Largest.h"
#include "Meshes.h"
#include "Solvers/DynamicsSolver.h"
#include "Solvers/GaussianFieldSolver.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/PoissonSolver.h"
#include "Solvers/SpectrumSolver.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

SurfaceOptions SmoothAt(int depth)
{
  SurfaceOptions options;
  options.space.depth = depth;
  options.choice.kind = FunctionKind::SmoothGrid;
  return options;
}

class SmoothSolvers : public ::testing::Test
{
protected:
  const std::shared_ptr<const TriangleMesh> mesh =
    std::make_shared<const TriangleMesh>(GeodesicSphere(48));
  Stages stages;
};

/// The largest relative error of the last values that belong to l = 1, 2, 3.
double ErrorOfSpectrum(
  Stages& stages, const std::shared_ptr<const TriangleMesh>& mesh, const SurfaceOptions& options)
{
  LocalSurface surface(stages, mesh, options);
  SpectrumSolver::Options ofSpectrum;
  ofSpectrum.numberOfModes = 16;
  SpectrumSolver solver;
  const SpectrumSolver::Result& result = solver.Update(surface, {}, ofSpectrum, {});
  EXPECT_TRUE(result.spectrum.converged);
  const double unit = surface.Space().UnitLength();
  double error = 0.0;
  for (const int l : { 1, 2, 3 })
  {
    const double found = result.spectrum.eigenvalues[l * (l + 2)] / (unit * unit);
    error = Larger(error, std::abs(found / (l * (l + 1.0)) - 1.0));
  }
  return error;
}

} // namespace

TEST_F(SmoothSolvers, HaveBetterModesOnTheSameGrid)
{
  const double smooth = ErrorOfSpectrum(stages, mesh, SmoothAt(3));
  SurfaceOptions grid = SmoothAt(3);
  grid.choice.kind = FunctionKind::Grid;
  Stages own;
  const double trilinear = ErrorOfSpectrum(own, mesh, grid);
  EXPECT_LT(smooth, 2e-3); // 4e-4 of it are the facets'
  EXPECT_GT(trilinear, 4.0 * smooth);
}

TEST_F(SmoothSolvers, ShareTheirOperators)
{
  LocalSurface surface(stages, mesh, SmoothAt(3));
  surface.Prepare({});
  const auto first = FindSpace(surface.Basis(), SmoothAt(3).choice);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->NumberOfFunctions(0), surface.Space().NumberOfFunctions(0));
  SpaceChoice grid = SmoothAt(3).choice;
  grid.kind = FunctionKind::Grid;
  EXPECT_FALSE(FindSpace(surface.Basis(), grid)); // it was not built on the way
}

TEST_F(SmoothSolvers, TakeACoarserGridWhereTheDepthIsAutomatic)
{
  const int grid = ChooseDepth(*mesh, AutomaticDepth, FunctionKind::Grid, AsManyAsWanted);
  EXPECT_EQ(ChooseDepth(*mesh, AutomaticDepth, FunctionKind::SmoothGrid, AsManyAsWanted), grid - 1);
  EXPECT_EQ(ChooseDepth(*mesh, 7, FunctionKind::SmoothGrid, AsManyAsWanted), 7);
}

TEST_F(SmoothSolvers, RefuseDistancesAndHeldValues)
{
  LocalSurface surface(stages, mesh, SmoothAt(3));
  surface.Prepare({});
  EXPECT_THROW(surface.MakeDistance({}, {}), InvalidInput);
  const MultiVector one = MultiVector::Ones(1, 1);
  EXPECT_THROW(surface.Hold({ 0 }, one), InvalidInput);
  try
  {
    surface.Hold({ 0 }, one);
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("Function Space"), std::string::npos);
  }
}

TEST_F(SmoothSolvers, RefuseDynamics)
{
  EXPECT_THROW(
    DynamicsSolver::Solve(mesh, {}, DynamicsSolver::Options(), SmoothAt(3)), InvalidInput);
}

TEST_F(SmoothSolvers, RefuseRandomFields)
{
  EXPECT_THROW(GaussianFieldSolver::Solve(mesh, {}, GaussianFieldSolver::Options(), SmoothAt(3)),
    InvalidInput);
}
