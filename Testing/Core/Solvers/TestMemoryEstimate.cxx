// The memory estimate against the sizes that are really built.
#include "Discretization.h"
#include "MemoryLimit.h"
#include "Meshes.h"
#include "Solvers/MemoryEstimate.h"
#include "Solvers/Requirements.h"
#include "Spaces/HatSpace.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

namespace gridfem
{
namespace
{

struct Case
{
  std::string name;
  TriangleMesh mesh;
  int depth;
  std::string file = {}; ///< a real mesh instead; the tests that need it read it
};

void PrintTo(const Case& item, std::ostream* stream)
{
  *stream << item.name;
}

/// Coarse and fine meshes, with many cells per triangle or many triangles per cell.
std::vector<Case> Cases()
{
  using namespace testing;
  return {
    { "coarse sphere", GeodesicSphere(4), 6 },
    { "fine sphere", GeodesicSphere(80), 4 },
    { "box on grid planes", Box(1), 6 },
    { "tilted box", Transform(Box(1), { 1, 1, 1 }, 0.3), 6 },
    { "torus", Torus(60, 24, 1.0, 0.3), 6 },
    { "trefoil", TrefoilTube(200, 24), 6 },
    { "open sheet", Transform(FlatRectangle(8, 8), { 1, 2, 0 }, 0.7), 6 },
    { "soup", Unweld(Torus(60, 24, 1.0, 0.3)), 5 },
    { "far away", Transform(GeodesicSphere(10), { 1, 0, 1 }, 0.2, 1e3, { 1e6, 0, -1e6 }), 5 },
    { "rocker arm", {}, 6, "rocker_arm.ply" },
  };
}

/// Tests on each of the meshes.
class MemoryEstimates : public ::testing::TestWithParam<Case>
{
protected:
  void SetUp() override
  {
    if (GetParam().file.empty())
    {
      return;
    }
    const std::string path = testing::RealMesh(GetParam().file);
    if (path.empty())
    {
      GTEST_SKIP() << "no real mesh " << GetParam().file;
    }
    mesh = testing::ReadMesh(path);
  }

  TriangleMesh mesh = GetParam().mesh;
  int depth = GetParam().depth;
};

template<class T, class Allocator>
double Bytes(const std::vector<T, Allocator>& items)
{
  return static_cast<double>(items.size() * sizeof(T));
}

double Bytes(const SparseMatrix& A)
{
  return Bytes(A.value) + static_cast<double>(A.rowBegin.size() * sizeof(Id)) +
         static_cast<double>(A.column.size() * sizeof(Index));
}

double Bytes(const ClippedMesh& clipped)
{
  return Bytes(clipped.cutPoints) + Bytes(clipped.position) + Bytes(clipped.cells) +
         Bytes(clipped.cellBegin) + Bytes(clipped.pieceTriangle) + Bytes(clipped.pieceBegin) +
         Bytes(clipped.corners) + Bytes(clipped.links);
}

double Bytes(const GridFunctions& space)
{
  double bytes = Bytes(space.clipped) + Bytes(space.piecePatch) + Bytes(space.pointPatch) +
                 Bytes(space.component);
  for (const PatchLevel& level : space.levels)
  {
    bytes += Bytes(level.cell) + Bytes(level.dof) + Bytes(level.parent);
  }
  return bytes;
}

/// Bytes without the prolongations and their transposes, which the hierarchy shares.
double Bytes(const LevelOperators& system)
{
  double bytes = Bytes(system.integral);
  for (std::size_t l = 0; l < system.elements.size(); ++l)
  {
    bytes += Bytes(system.elements[l].mass) + Bytes(system.elements[l].stiffness) +
             Bytes(system.places[l].begin) + Bytes(system.places[l].item) +
             Bytes(system.pattern[l]);
  }
  return bytes;
}

GridFunctions BuildSpace(const TriangleMesh& mesh, int depth)
{
  SpaceOptions options;
  options.depth = depth;
  return BuildGridFunctions(mesh, options);
}

/// Sizes are exact on average over positions of the grid, except for contributions of curves on the
/// surface. These are rims, creases, and rows of cells next to faces on grid planes. Their share is
/// at most this.
double ShareOfCurves(int depth)
{
  return 4.0 / double(1 << depth);
}

TEST_P(MemoryEstimates, ExpectsTheSizesThatCome)
{
  const MemoryEstimate estimate = EstimateMemory(mesh, depth);
  const GridFunctions space = BuildSpace(mesh, depth);
  const auto expectNear = [](double expected, double real, double share)
  { EXPECT_NEAR(expected / real, 1.0, share); };
  const double share = ShareOfCurves(depth);
  expectNear(
    estimate.clippedTriangles, static_cast<double>(space.clipped.NumberOfTriangles()), share);
  expectNear(estimate.patches, static_cast<double>(space.Finest().NumberOfPatches()), share);
  expectNear(estimate.functions, space.Finest().numberOfFunctions, share);
}

TEST_P(MemoryEstimates, HoldsWhatIsBuiltAndNotMuchMore)
{
  const MemoryEstimate estimate = EstimateMemory(mesh, depth);
  const GridFunctions space = BuildSpace(mesh, depth);
  const LevelOperators system = BuildLevelOperators(space, TriangleRule(2));
  const Multigrid multigrid =
    BuildMultigrid(gridfem::testing::ViewOf(space, system), 0.01, 1.0, {});
  const double arrays = Bytes(space) + Bytes(system) + static_cast<double>(multigrid.Memory());
  // The arrays at the end. Rims and coarse levels have a few more functions than areas tell. The
  // peak of clipping is up to twice the size of its result.
  EXPECT_GT(estimate.bytes, (1.0 - ShareOfCurves(depth)) * arrays);
  EXPECT_LT(estimate.bytes, 2.5 * arrays);
}

TEST_P(MemoryEstimates, HoldsTheHatFunctions)
{
  const GridFunctions space = BuildSpace(mesh, depth);
  const LevelOperators system = BuildLevelOperators(space, TriangleRule(2));
  const auto level = std::make_shared<const HatLevel>(BuildHatLevel(mesh, space, {}, true));
  const HatLevel& hats = *level;
  const std::size_t withHats =
    BuildMultigrid(HatSpace(level, testing::ViewOf(space, system)), 0.01, 1.0, {}).Memory();
  const std::size_t without =
    BuildMultigrid(testing::ViewOf(space, system), 0.01, 1.0, {}).Memory();
  const HatFunctions& functions = hats.functions;
  const double arrays =
    Bytes(functions.ofPoint) + Bytes(functions.begin) + Bytes(functions.corners) +
    Bytes(functions.component) + Bytes(hats.matrices.mass) + Bytes(hats.matrices.stiffness) +
    Bytes(hats.matrices.integral) + static_cast<double>(withHats) - static_cast<double>(without);
  EXPECT_GT(EstimateHatMemory(mesh, space.Finest().numberOfFunctions), arrays);
  EXPECT_LT(EstimateHatMemory(mesh, space.Finest().numberOfFunctions), 2.5 * arrays);
}

TEST(MemoryEstimate, TheSuggestedDepthIsTheFinestThatThePointsFill)
{
  for (const TriangleMesh& mesh : { testing::GeodesicSphere(120),
         testing::Torus(500, 200, 1.0, 0.4), testing::TrefoilTube(2000, 60) })
  {
    SCOPED_TRACE(mesh.points.size());
    const auto functionsAt = [&](int depth)
    { return BuildSpace(mesh, depth).Finest().numberOfFunctions; };
    const int depth = SuggestedDepth(mesh);
    const auto points = static_cast<double>(mesh.points.size());
    EXPECT_LT(functionsAt(depth), 1.05 * points);
    EXPECT_GT(functionsAt(depth + 1), 0.95 * points);
    EXPECT_EQ(SuggestedDepth(testing::Unweld(mesh)), depth);
  }
}

TEST(MemoryEstimate, TheSuggestedDepthOfACoarseMeshIsSix)
{
  EXPECT_EQ(SuggestedDepth(testing::Box(1)), 6);
}

TEST(MemoryEstimate, TheDepthForPointsIsTheFinestThatHasNoMoreFunctionsForEach)
{
  const double all = std::numeric_limits<double>::infinity();
  for (const TriangleMesh& mesh : { testing::GeodesicSphere(30), testing::Torus(200, 80, 1.0, 0.4),
         testing::TrefoilTube(800, 24) })
  {
    const auto points = static_cast<double>(mesh.points.size());
    for (const double perPoint : { 1.0, 4.0 })
    {
      SCOPED_TRACE(points * perPoint);
      const auto functionsAt = [&](int depth)
      { return BuildSpace(mesh, depth).Finest().numberOfFunctions; };
      const int depth = DepthForPoints(mesh, MaximumDepth, perPoint);
      // Estimates are good to a few percent. Rims have more functions than areas tell.
      EXPECT_LT(functionsAt(depth), 1.2 * perPoint * points);
      EXPECT_GT(functionsAt(depth + 1), 0.95 * perPoint * points);
      EXPECT_EQ(DepthForPoints(mesh, depth - 1, perPoint), depth - 1);
      EXPECT_EQ(DepthForPoints(testing::Unweld(mesh), MaximumDepth, perPoint), depth);
    }
    EXPECT_EQ(DepthForPoints(mesh, 9, all), 9);
  }
  EXPECT_EQ(DepthForPoints(testing::Box(1), 9, 1.0), MinimumDepth);
}

TEST(MemoryEstimate, ADepthGivesWayBelowHatFunctionsOnly)
{
  const TriangleMesh mesh = testing::GeodesicSphere(30); // 3,602 points
  const int enough = DepthForPoints(mesh, MaximumDepth, 1.0);
  ASSERT_LT(enough, 6);
  EXPECT_EQ(ChooseDepth(mesh, 7, FunctionKind::Grid, 1.0), 7);
  EXPECT_EQ(ChooseDepth(mesh, AutomaticDepth, FunctionKind::Grid, 1.0), SuggestedDepth(mesh));
  EXPECT_EQ(ChooseDepth(mesh, 7, FunctionKind::Hats, EnoughToPrecondition), enough);
  EXPECT_EQ(ChooseDepth(mesh, 7, FunctionKind::Hats, EnoughToEstimate), enough + 1);
  EXPECT_EQ(ChooseDepth(mesh, 7, FunctionKind::Hats, AsManyAsWanted), 7);
  EXPECT_EQ(ChooseDepth(mesh, enough - 1, FunctionKind::Hats, EnoughToPrecondition), enough - 1);
  EXPECT_EQ(ChooseDepth(mesh, AutomaticDepth, FunctionKind::Hats, EnoughToPrecondition), enough);
}

TEST_P(MemoryEstimates, GrowsWithDepth)
{
  for (int level = MinimumDepth; level < MaximumDepth; ++level)
  {
    const MemoryEstimate coarse = EstimateMemory(mesh, level);
    const MemoryEstimate fine = EstimateMemory(mesh, level + 1);
    EXPECT_GT(fine.bytes, coarse.bytes);
    // Areas grow by 4, everything else by less.
    EXPECT_LE(fine.bytes, 4.0 * coarse.bytes);
  }
  // At large depths only areas count.
  EXPECT_NEAR(EstimateMemory(mesh, 14).bytes / EstimateMemory(mesh, 13).bytes, 4.0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Meshes, MemoryEstimates, ::testing::ValuesIn(Cases()));

TEST(MemoryEstimate, DoesNotDependOnTheUnit)
{
  const TriangleMesh mesh = testing::Torus(40, 20, 1.0, 0.4);
  const MemoryEstimate estimate = EstimateMemory(mesh, 7);
  for (const double scale : { 1.0 / 1024.0, 1024.0 }) // powers of 2: no rounding
  {
    const TriangleMesh scaled = testing::Transform(mesh, { 0, 0, 1 }, 0.0, scale);
    EXPECT_DOUBLE_EQ(EstimateMemory(scaled, 7).bytes, estimate.bytes);
  }
}

TEST(MemoryEstimate, KnowsWhatTheMachineHas)
{
  if (!std::ifstream("/proc/meminfo"))
  {
    GTEST_SKIP() << "this system does not say how much memory it has";
  }
  EXPECT_GT(MemoryOfMachine(), 1e6);
  EXPECT_LT(MemoryOfMachine(), 1e15);
}

TEST(MemoryEstimate, KnowsTheLimitOfTheProcess)
{
  constexpr double Room = 3e8;
  const MemoryNeed need = NeedOfModes(100000, 300, 1);
  const auto isRefused = [&need]
  {
    try
    {
      RequireMemory(need, AvailableMemory());
      return false;
    }
    catch (const InvalidInput&)
    {
      return true;
    }
  };
  ASSERT_GT(need.bytes, 1.5 * Room);
  EXPECT_FALSE(isRefused());
  double room = 0.0;
  bool isRefusedWithin = false;
  {
    const testing::MemoryLimit limit(Room);
    room = MemoryOfProcess();
    isRefusedWithin = isRefused();
  }
  EXPECT_NEAR(room, Room, 0.2 * Room);
  EXPECT_TRUE(isRefusedWithin);
  EXPECT_FALSE(isRefused());
}

} // namespace
} // namespace gridfem
