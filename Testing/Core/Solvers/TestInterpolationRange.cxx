// Harmonic interpolation stays between its values, meets them, and converges where a whole boundary
// is given.
#include "Solvers/InterpolationSolver.h"

#include "AtDepth.h"
#include "Grid/SurfaceEdges.h"
#include "Largest.h"
#include "Meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

PointValues ValuesAt(const std::vector<Id>& points, const std::function<double(Id)>& value)
{
  PointValues known{ points, MultiVector(static_cast<Id>(points.size()), 1) };
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    known.values(static_cast<Id>(k), 0) = value(points[k]);
  }
  return known;
}

InterpolationSolver::Result Interpolate(
  const TriangleMesh& mesh, const PointValues& known, FunctionKind kind, int depth, int threads = 0)
{
  SurfaceOptions surface = AtDepth<InterpolationSolver>(depth);
  surface.space.threads = threads;
  surface.choice.kind = kind;
  InterpolationSolver::Input input;
  input.values.find = [&known] { return known; };
  return InterpolationSolver::Solve(std::make_shared<TriangleMesh>(mesh), input, {}, surface);
}

/// How far values leave the range of the given ones. Points without a value do not count.
double Excess(const InterpolationSolver::Result& result, const PointValues& known)
{
  double excess = 0.0;
  for (Id point = 0; point < result.atPoints.rows(); ++point)
  {
    const double value = result.atPoints(point, 0);
    if (!std::isnan(value))
    {
      excess = Larger(excess, known.values.minCoeff<Eigen::PropagateNaN>() - value);
      excess = Larger(excess, value - known.values.maxCoeff<Eigen::PropagateNaN>());
    }
  }
  return excess;
}

/// Different points that a triangle uses, with random values. Every fourth one is followed by a
/// neighbor.
PointValues RandomValues(const TriangleMesh& mesh, Id count, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<char> isTaken(mesh.points.size(), 0);
  PointValues known;
  const auto take = [&](Id point)
  {
    if (!isTaken[point])
    {
      isTaken[point] = 1;
      known.points.push_back(point);
    }
  };
  while (static_cast<Id>(known.points.size()) < count)
  {
    const auto& corners = mesh.triangles[random() % mesh.triangles.size()];
    take(corners[0]);
    if (random() % 4 == 0)
    {
      take(corners[1]);
    }
  }
  return ValuesAt(known.points, [&](Id) { return double(random() % 1000); });
}

struct NamedMesh
{
  std::string name;
  TriangleMesh mesh;
};

std::vector<NamedMesh> MeshesOfRanges()
{
  std::vector<NamedMesh> meshes = { { "square",
                                      Transform(FlatRectangle(48, 48), { 1, 2, 3 }, 0.3) },
    { "sphere", GeodesicSphere(20) }, { "torus", Torus(60, 24, 1.0, 0.4) }, { "box", Box(12) } };
  for (const char* name : { "bones_26comp_4k.ply", "elephant_106_holes_4k.ply", "pulley.stl" })
  {
    const std::string path = RealMesh(name);
    if (!path.empty())
    {
      meshes.push_back({ name, ReadMesh(path) });
    }
  }
  return meshes;
}

class InterpolationRange : public ::testing::TestWithParam<FunctionKind>
{
};

std::vector<Id> BoundaryPoints(const TriangleMesh& mesh)
{
  return EndsOf(FindSurfaceEdges(mesh, true).boundary, mesh);
}

} // namespace

TEST_P(InterpolationRange, HoldsForAnyValues)
{
  for (const NamedMesh& named : MeshesOfRanges())
  {
    for (const Id count : { 2, 10, 100 })
    {
      SCOPED_TRACE(named.name + ", " + std::to_string(count));
      const PointValues known = RandomValues(named.mesh, count, unsigned(count));
      const InterpolationSolver::Result result = Interpolate(named.mesh, known, GetParam(), 5);
      EXPECT_TRUE(result.report.converged);
      EXPECT_LE(Excess(result, known), 0.0);
      if (named.name != "pulley.stl") // its points share places, where the mean counts
      {
        EXPECT_LT(result.misfit, 1e-9 * 1000.0);
      }
    }
  }
}

/// Several points in one cell: two opposite neighbors, and nine points with values of their own.
TEST_P(InterpolationRange, HoldsForSeveralPointsInACell)
{
  const int n = 96;
  const TriangleMesh mesh = Transform(FlatRectangle(n, n), { 1, 2, 3 }, 0.3);
  std::vector<Id> nine;
  for (Id k = 0; k < 9; ++k)
  {
    nine.push_back((48 + k / 3) * (n + 1) + 40 + k % 3);
  }
  for (const std::vector<Id>& points : { std::vector<Id>{ nine[0], nine[1] }, nine })
  {
    const PointValues known = ValuesAt(points, [](Id point) { return double(point % 2); });
    const InterpolationSolver::Result result = Interpolate(mesh, known, GetParam(), 5);
    EXPECT_LE(Excess(result, known), 0.0);
    EXPECT_EQ(result.misfit, 0.0);
    EXPECT_TRUE(result.warnings.empty());
    const InterpolationSolver::Result onHats = Interpolate(mesh, known, FunctionKind::Hats, 5);
    // The two values alone determine a far field between them. It is their mean on hats. On a grid
    // their weights depend on their places in the cell.
    const MultiVector difference = result.atPoints - onHats.atPoints;
    EXPECT_LT(difference.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 0.25);
    EXPECT_LT(std::abs(difference.mean()), 0.1);
  }
}

TEST_P(InterpolationRange, DoesNotDependOnThreads)
{
  const TriangleMesh mesh = GeodesicSphere(20);
  const PointValues known = RandomValues(mesh, 100, 7);
  EXPECT_EQ(Interpolate(mesh, known, GetParam(), 4, 1).atPoints,
    Interpolate(mesh, known, GetParam(), 4, 3).atPoints);
}

/// For contradictory values at one place the mean counts, and the misfit shows it.
TEST_P(InterpolationRange, SaysWhatCannotBeMet)
{
  const TriangleMesh mesh = GeodesicSphere(8);
  PointValues known = ValuesAt({ 5, 5, 100 }, [](Id) { return 1.0; });
  known.values(1, 0) = 3.0;
  const InterpolationSolver::Result result = Interpolate(mesh, known, GetParam(), 4);
  EXPECT_NEAR(result.misfit, 1.0, 1e-12);
  EXPECT_EQ(result.warnings.size(), 1u);
}

/// A harmonic function on flat or rolled surfaces, from its values at the points of the boundary.
/// Cells of depth 3 are larger than the edges, and cells of depth 7 are smaller.
TEST(InterpolationRate, IsNearTwoForAWholeBoundary)
{
  const auto harmonic = [](double x, double y)
  { return std::exp(0.5 * M_PI * x) * std::sin(0.5 * M_PI * y); };
  const TriangleMesh square = FlatRectangle(40, 40);
  const TriangleMesh cylinder =
    Mapped(square, [](const Vec3& p) { return Vec3(std::cos(p[0]), std::sin(p[0]), p[1]); });
  const TriangleMesh disk = Disk(48);
  struct Patch
  {
    const char* name;
    TriangleMesh flat;
    TriangleMesh mesh;
  };
  for (const Patch& patch :
    { Patch{ "square", square, square }, { "cylinder", square, cylinder }, { "disk", disk, disk } })
  {
    const TriangleMesh mesh = Transform(patch.mesh, { 1, 2, 3 }, 0.5);
    const auto exact = [&](Id point)
    { return harmonic(patch.flat.points[point][0], patch.flat.points[point][1]); };
    const PointValues known = ValuesAt(BoundaryPoints(mesh), exact);
    double first = 0.0;
    double last = std::numeric_limits<double>::infinity();
    for (const int depth : { 3, 4, 5, 6, 7 })
    {
      const InterpolationSolver::Result result =
        Interpolate(mesh, known, FunctionKind::Grid, depth);
      double squares = 0.0;
      for (Id point = 0; point < result.atPoints.rows(); ++point)
      {
        squares += std::pow(result.atPoints(point, 0) - exact(point), 2);
      }
      const double error = std::sqrt(squares / double(result.atPoints.rows()));
      SCOPED_TRACE(std::string(patch.name) + ", depth " + std::to_string(depth));
      RecordProperty(std::string(patch.name) + std::to_string(depth), std::to_string(error));
      EXPECT_LT(error, 1.1 * last); // the mesh limits it in the end
      first = depth == 3 ? error : first;
      last = error;
      if (depth == 5)
      {
        EXPECT_GT(first / error, 8.0); // 2^1.5 a level
      }
    }
    EXPECT_LT(last, 3e-4) << patch.name;
  }
}

INSTANTIATE_TEST_SUITE_P(
  BothSpaces, InterpolationRange, ::testing::Values(FunctionKind::Grid, FunctionKind::Hats));
