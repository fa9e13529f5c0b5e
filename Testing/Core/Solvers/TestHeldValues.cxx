// Held points next to each other, with edges between them: the solvers meet their values to the
// tolerance, and leave the rest of the solution as accurate as without them.
#include "AtDepth.h"
#include "Largest.h"
#include "Meshes.h"

#include "Base/Errors.h"
#include "Solvers/DiffusionSolver.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/PoissonSolver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

MultiVector WavesOn(const TriangleMesh& mesh)
{
  MultiVector values(static_cast<Id>(mesh.points.size()), 1);
  for (Id k = 0; k < values.rows(); ++k)
  {
    const Vec3& p = mesh.points[k];
    values(k, 0) = std::sin(3.0 * p[0] + 1.0) + p[1] * p[2];
  }
  return values;
}

/// Holds the values of a cap of a sphere while heat spreads.
DiffusionSolver::Step HeldCap(const std::shared_ptr<const TriangleMesh>& mesh, int depth,
  double tolerance, FunctionKind kind = FunctionKind::Grid)
{
  const MultiVector values = WavesOn(*mesh);
  DiffusionSolver::Input input;
  input.values = GivenField::Of("f", { FieldAssociation::Points, values });
  input.constraints.property = "the cap";
  input.constraints.find = [&]
  {
    PointValues held;
    for (Id k = 0; k < values.rows(); ++k)
    {
      if (mesh->points[k][2] > 0.8)
      {
        held.points.push_back(k);
      }
    }
    held.values = values(held.points, Eigen::indexing::all);
    return held;
  };
  DiffusionSolver::Options options;
  options.diffusionTime = 0.02;
  options.equation.solve.tolerance = tolerance;
  SurfaceOptions asked = AtDepth<DiffusionSolver>(depth);
  asked.choice.kind = kind;
  return DiffusionSolver::Solve(mesh, input, options, asked).steps.front();
}

TEST(HeldValues, OfACapAreMet)
{
  // Edges of 0.5 to 2 cells. With more points than functions, values are met by least squares.
  for (const auto& [fineness, depth] :
    { std::pair{ 6, 4 }, std::pair{ 12, 4 }, std::pair{ 12, 5 }, std::pair{ 20, 5 } })
  {
    const auto mesh =
      std::make_shared<const TriangleMesh>(Transform(GeodesicSphere(fineness), { 1, 2, 3 }, 0.4));
    const DiffusionSolver::Step exact = HeldCap(mesh, depth, 1e-9);
    const DiffusionSolver::Step step = HeldCap(mesh, depth, 0.0);
    EXPECT_TRUE(step.report.converged);
    EXPECT_LT(step.met.misfit, 1e-6) << fineness << " at depth " << depth;
    const double off = (step.atPoints - exact.atPoints).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    EXPECT_LT(off, 1e-5) << fineness << " at depth " << depth;
    EXPECT_LT(step.report.iterations, 60) << fineness << " at depth " << depth;
  }
}

TriangleMesh Disc(int fineness)
{
  return Transform(Disk(fineness), { 1, 2, 3 }, 0.0, 1.5);
}

/// The largest error of x² - y² from its values on the boundary.
double ErrorOnDisc(const std::shared_ptr<const TriangleMesh>& mesh, int depth)
{
  MultiVector exact(static_cast<Id>(mesh->points.size()), 1);
  for (Id k = 0; k < exact.rows(); ++k)
  {
    const Vec3& p = mesh->points[k];
    exact(k, 0) = 4.0 + p[0] * p[0] - p[1] * p[1];
  }
  PoissonSolver::Input input;
  input.values = GivenField::Of("f", { FieldAssociation::Points, exact });
  PoissonSolver::Options options;
  options.screeningWeight = 0.0;
  options.boundaryValues = true;
  options.equation.solve.tolerance = 1e-8;
  SurfaceOptions asked;
  asked.space.depth = depth;
  asked.choice.normalStabilization = 1e-2;
  const PoissonSolver::Result found = PoissonSolver::Solve(mesh, input, options, asked);
  EXPECT_LT(found.misfit, 1e-6);
  return (found.atPoints - exact).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/// The range is 4.5. At depth 5 edges are shorter than cells or about as long, at depth 7 they are
/// longer. There, the chords of the boundary limit the error.
TEST(HeldValues, OfABoundaryGiveAnErrorThatFallsWithDepth)
{
  constexpr double Chords[] = { 4e-3, 1.5e-3 };
  for (int k = 0; k < 2; ++k)
  {
    const auto mesh = std::make_shared<const TriangleMesh>(Disc(k == 0 ? 20 : 40));
    const double coarse = ErrorOnDisc(mesh, 5);
    const double fine = ErrorOnDisc(mesh, 6);
    EXPECT_LT(coarse, 0.025);
    EXPECT_LT(fine, Larger(Chords[k], coarse / 4.0));
    EXPECT_LT(ErrorOnDisc(mesh, 7), Chords[k]);
  }
}

/// A mask of no point is refused. Without the mask, the next update works as in a new solver.
TEST(HeldValues, AreForgottenAfterAMaskThatHoldsNone)
{
  const auto mesh = std::make_shared<const TriangleMesh>(Disc(8));
  const MultiVector values = WavesOn(*mesh);
  DiffusionSolver::Input input;
  input.values = GivenField::Of("f", { FieldAssociation::Points, values });
  SurfaceOptions asked = AtDepth<DiffusionSolver>(4);
  DiffusionSolver::Options options;
  options.diffusionTime = 0.1;
  options.equation.solve.tolerance = 1e-8; // the same with and without a mask
  Stages stages;
  LocalSurface surface(stages, mesh, asked);
  DiffusionSolver solver;
  const auto hold = [&](std::vector<Id> points, int version)
  {
    input.constraints.property = "the mask";
    input.constraints.version = StageKey().Add(version);
    input.constraints.find = [points, &values] {
      return PointValues{ points, values(points, Eigen::seqN(0, values.cols())) };
    };
  };
  const auto expectAsNew = [&]
  {
    const DiffusionSolver::Result fresh = DiffusionSolver::Solve(mesh, input, options, asked);
    EXPECT_EQ(solver.Update(surface, input, options, {}).steps.front().atPoints,
      fresh.steps.front().atPoints);
  };
  for (const bool onBoundary : { false, true })
  {
    options.boundaryValues = onBoundary;
    hold({ 5, 20 }, 1);
    expectAsNew();
    hold({}, 2);
    EXPECT_THROW(solver.Update(surface, input, options, {}), InvalidInput);
    input.constraints = {};
    expectAsNew();
    hold({}, 3);
    EXPECT_THROW(solver.Update(surface, input, options, {}), InvalidInput);
    hold({ 5, 20 }, 4);
    expectAsNew();
  }
}

} // namespace
} // namespace gridfem
