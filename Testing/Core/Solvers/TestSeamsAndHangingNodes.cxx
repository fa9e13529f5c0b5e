// Problems on surfaces with seams and hanging nodes, whose exact solutions are known.
#include "Grid/JoinSeams.h"
#include "Largest.h"
#include "Meshes.h"
#include "Solvers/DistanceSolver.h"
#include "Solvers/SpectrumSolver.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A tube of radius 1 and length 3, which rounding leaves open along a line.
TriangleMesh TubeWithSeam()
{
  TriangleMesh mesh = FlatRectangle(60, 30);
  for (Vec3& point : mesh.points)
  {
    const double angle = 2 * M_PI * point[0];
    point = Vec3(std::cos(angle), std::sin(angle), 3.0 * point[1]);
  }
  return mesh;
}

/// A unit square whose right half is twice as fine.
TriangleMesh SquareWithHangingNodes()
{
  TriangleMesh fine = FlatRectangle(20, 40, 0.5, 1.0);
  for (Vec3& point : fine.points)
  {
    point[0] += 0.5;
  }
  return Join(FlatRectangle(10, 20, 0.5, 1.0), fine);
}

std::shared_ptr<const TriangleMesh> Joined(TriangleMesh mesh)
{
  JoinSeams(mesh);
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

std::vector<double> Eigenvalues(
  const std::shared_ptr<const TriangleMesh>& mesh, FunctionKind kind, bool isAware, int modes)
{
  SpectrumSolver::Options options;
  options.numberOfModes = modes;
  SurfaceOptions surface = SpectrumSolver::SurfaceDefaults();
  surface.space.depth = 6;
  surface.space.connectivityAware = isAware;
  surface.choice.kind = kind;
  return SpectrumSolver::Solve(mesh, {}, options, surface).eigenvalues;
}

/// Expects eigenvalues with a relative error that trilinear functions of this depth, and hats of
/// this mesh, stay below.
void ExpectEigenvalues(const std::shared_ptr<const TriangleMesh>& mesh,
  const std::vector<double>& exact, double relativeError)
{
  for (const auto& [kind, isAware] :
    std::vector<std::pair<FunctionKind, bool>>{
      { FunctionKind::Grid, true }, { FunctionKind::Grid, false }, { FunctionKind::Hats, true } })
  {
    const std::vector<double> found =
      Eigenvalues(mesh, kind, isAware, static_cast<int>(exact.size()));
    ASSERT_GE(found.size(), exact.size());
    for (std::size_t k = 0; k < exact.size(); ++k)
    {
      EXPECT_NEAR(found[k], exact[k], relativeError * std::max(1.0, exact[k])) << k;
    }
  }
}

double LargestErrorOfDistance(
  const std::shared_ptr<const TriangleMesh>& mesh, Id source, const std::vector<double>& exact)
{
  SurfaceOptions surface = DistanceSolver::SurfaceDefaults();
  surface.space.depth = 6;
  DistanceSolver::Input input;
  input.ids = { source };
  const auto result = DistanceSolver::Solve(mesh, input, {}, surface);
  double largest = 0.0;
  for (std::size_t point = 0; point < exact.size(); ++point)
  {
    largest = Larger(largest, std::abs(result.atPoints(static_cast<Id>(point), 0) - exact[point]));
  }
  return largest;
}

} // namespace

TEST(SeamsAndHangingNodes, ATubeHasTheSpectrumOfACylinder)
{
  const double first = std::pow(M_PI / 3.0, 2);
  ExpectEigenvalues(Joined(TubeWithSeam()), { 0, 1, 1, first, 1 + first, 1 + first, 4, 4 }, 0.01);
}

TEST(SeamsAndHangingNodes, ASquareOfTwoHalvesHasTheSpectrumOfASquare)
{
  std::vector<double> exact = { 0, 1, 1, 2, 4, 4, 5, 5 };
  for (double& value : exact)
  {
    value *= M_PI * M_PI;
  }
  ExpectEigenvalues(Joined(SquareWithHangingNodes()), exact, 0.02);
}

TEST(SeamsAndHangingNodes, DistancesCrossThem)
{
  const auto tube = Joined(TubeWithSeam());
  const Id source = 15 * 61 + 3;
  std::vector<double> exact;
  for (const Vec3& point : tube->points)
  {
    const double turn = std::atan2(point[1], point[0]) - 2 * M_PI * 3 / 60;
    exact.push_back(std::hypot(std::remainder(turn, 2 * M_PI), point[2] - 1.5));
  }
  EXPECT_LT(LargestErrorOfDistance(tube, source, exact), 0.1); // a cell is 0.05

  const auto square = Joined(SquareWithHangingNodes());
  exact.clear();
  for (const Vec3& point : square->points)
  {
    exact.push_back((point - square->points[0]).norm());
  }
  EXPECT_LT(LargestErrorOfDistance(square, 0, exact), 0.03);
}
