// Two scans of a sphere, one of them brighter, become one coloring.
#include "AtDepth.h"
#include "EachOption.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/StitchSolver.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

std::shared_ptr<const TriangleMesh> Ball()
{
  return std::make_shared<const TriangleMesh>(Transform(GeodesicSphere(24), { 1, 2, 3 }, 0.3));
}

/// Colors are z, and 1 more in the scan 7, which has x > 0. The other scan is 3.
StitchSolver::Input TwoScans(const TriangleMesh& mesh)
{
  const MultiVector points = PointCoordinates(mesh);
  MultiVector colors = points.col(2);
  MultiVector labels(points.rows(), 1);
  for (Id point = 0; point < points.rows(); ++point)
  {
    const bool isBright = points(point, 0) > 0.0;
    labels(point, 0) = isBright ? 7.0 : 3.0;
    colors(point, 0) += isBright ? 1.0 : 0.0;
  }
  return { GivenField::Of("colors", { FieldAssociation::Points, colors }),
    GivenField::Of("labels", { FieldAssociation::Points, labels }) };
}

const SurfaceOptions AtDepth4 = AtDepth<StitchSolver>(4);

StitchSolver::Options KeepingScan(int label)
{
  StitchSolver::Options options;
  options.equation.solve.tolerance = 1e-10;
  options.equation.accuracy = 0.0;
  options.referenceLabel = label;
  return options;
}

double Largest(const MultiVector& values)
{
  return values.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

} // namespace

TEST(StitchSolver, TheReferenceKeepsItsColorsAndTheOtherScanFollows)
{
  const auto mesh = Ball();
  const StitchSolver::Input input = TwoScans(*mesh);
  const MultiVector z = PointCoordinates(*mesh).col(2);
  const MultiVector dark =
    StitchSolver::Solve(mesh, input, KeepingScan(3), AtDepth<StitchSolver>(5)).values;
  const MultiVector bright =
    StitchSolver::Solve(mesh, input, KeepingScan(7), AtDepth<StitchSolver>(5)).values;
  // On the seam, a strip of triangles of side 0.07, no gradient is known.
  EXPECT_LT(Largest(dark - z), 0.1);
  EXPECT_LT(Largest(bright - z - MultiVector::Ones(z.rows(), 1)), 0.1);
}

/// The bright scan fades by 0.5 toward the seam, over a length of 0.3; the sphere's diameter is 2.
/// Without blending the fade moves the scan by all but the 0.06 that it fades within the seam.
TEST(StitchSolver, BlendWidthIsAPartOfTheLongestSide)
{
  const auto mesh = Ball();
  const MultiVector points = PointCoordinates(*mesh);
  MultiVector colors = points.col(2);
  for (Id point = 0; point < points.rows(); ++point)
  {
    const double x = points(point, 0);
    colors(point, 0) += x > 0.0 ? 1.0 - 0.5 * std::max(0.0, 1.0 - x / 0.3) : 0.0;
  }
  StitchSolver::Input input = TwoScans(*mesh);
  input.colors = GivenField::Of("faded", { FieldAssociation::Points, colors });
  const auto meanFarAway = [&](double blendWidth, int depth)
  {
    StitchSolver::Options options = KeepingScan(3);
    options.blendWidth = blendWidth;
    const MultiVector values =
      StitchSolver::Solve(mesh, input, options, AtDepth<StitchSolver>(depth)).values;
    double sum = 0.0;
    int count = 0;
    for (Id point = 0; point < points.rows(); ++point)
    {
      const bool isFar = points(point, 0) > 0.6;
      sum += isFar ? values(point, 0) - points(point, 2) : 0.0;
      count += isFar;
    }
    return sum / count;
  };
  const double blended = meanFarAway(0.25, 5);
  EXPECT_NEAR(meanFarAway(0.0, 5), 0.44, 0.05);
  EXPECT_NEAR(blended, 0.13, 0.05); // 0.5 times the mean share over the fade
  EXPECT_NEAR(meanFarAway(0.25, 6), blended, 0.01);
}

TEST(StitchSolver, EachOptionChangesTheResultAsInANewSolver)
{
  const auto mesh = Ball();
  const StitchSolver::Input input = TwoScans(*mesh);
  const StitchSolver::Options options = KeepingScan(3);
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth4);
  StitchSolver solver;
  const MultiVector first = solver.Update(surface, input, options, {}).values;
  for (const auto& [name, next] : EachChanged(options))
  {
    StitchSolver::Options changed = next;
    changed.referenceLabel = name == "ReferenceLabel" ? 7 : 3; // 4 is no scan
    const MultiVector here = solver.Update(surface, input, changed, {}).values;
    EXPECT_EQ(here, StitchSolver::Solve(mesh, input, changed, AtDepth4).values) << name;
    EXPECT_NE(here, first) << name;
    EXPECT_EQ(solver.Update(surface, input, options, {}).values, first) << name;
  }
}

TEST(StitchSolver, OtherColorsKeepTheCut)
{
  const auto mesh = Ball();
  StitchSolver::Input input = TwoScans(*mesh);
  Stages stages;
  LocalSurface surface(stages, mesh, AtDepth4);
  StitchSolver solver;
  solver.Update(surface, input, KeepingScan(3), {});
  input.colors =
    GivenField::Of("x", { FieldAssociation::Points, PointCoordinates(*mesh).col(0) }, 1);
  solver.Update(surface, input, KeepingScan(3), {});
  EXPECT_EQ(stages.Runs("Cut"), 1);
  EXPECT_EQ(stages.Runs(SolveStage), 2);
}

TEST(StitchSolver, RefusesLabelsAndScansThatAreNone)
{
  const auto mesh = Ball();
  StitchSolver::Input input = TwoScans(*mesh);
  EXPECT_THROW(StitchSolver::Solve(mesh, input, KeepingScan(5), AtDepth4), InvalidInput);
  input.labels = GivenField::Of(
    "halves", { FieldAssociation::Points,
                MultiVector::Constant(static_cast<Id>(mesh->points.size()), 1, 0.5) });
  EXPECT_THROW(StitchSolver::Solve(mesh, input, KeepingScan(3), AtDepth4), InvalidInput);
  EXPECT_THROW(StitchSolver::Solve(mesh, {}, KeepingScan(3), AtDepth4), InvalidInput);
}
