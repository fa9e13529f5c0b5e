// Tests the choice of the points that paths connect, and points that no path reaches.
#include "Solvers/PathSolver.h"

#include "Base/Errors.h"
#include "ExpectOne.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Ids = std::vector<std::pair<Id, Id>>;

const auto Cube = std::make_shared<const TriangleMesh>(Box(4));

PathSolver::Input Given(const std::vector<Id>& sources, const std::vector<Id>& targets)
{
  PathSolver::Input input;
  input.sources.ids = sources;
  input.targets.ids = targets;
  return input;
}

PathSolver::Options Type(PathType type)
{
  PathSolver::Options options;
  options.pathType = type;
  return options;
}

PathSolver::Result Solve(const std::vector<Id>& sources, const std::vector<Id>& targets,
  PathType type = PathType::ToNearestSource)
{
  return PathSolver::Solve(Cube, Given(sources, targets), Type(type));
}

Ids EndsOf(const PathSolver::Result& result)
{
  Ids ends;
  for (const PathSolver::Path& path : result.paths)
  {
    EXPECT_TRUE(path.isShortest);
    EXPECT_EQ(PositionOf(*Cube, path.path.points.front()), Cube->points[path.source]);
    EXPECT_EQ(PositionOf(*Cube, path.path.points.back()), Cube->points[path.target]);
    ends.emplace_back(path.source, path.target);
  }
  return ends;
}

Id CornerOfCube(double x, double y, double z)
{
  for (std::size_t point = 0; point < Cube->points.size(); ++point)
  {
    if (Cube->points[point] == Vec3(x, y, z))
    {
      return static_cast<Id>(point);
    }
  }
  return -1;
}

} // namespace

TEST(PathSolver, LeadsToEachTargetFromTheNearestSource)
{
  const Id low = CornerOfCube(0, 0, 0);
  const Id high = CornerOfCube(1, 1, 1);
  const Id near = CornerOfCube(0.25, 0.25, 0);
  const Id far = CornerOfCube(0.75, 1, 1);
  const PathSolver::Result result = Solve({ low, high }, { far, near, low });
  EXPECT_EQ(EndsOf(result), (Ids{ { high, far }, { low, near }, { low, low } }));
  EXPECT_NEAR(result.paths[0].path.length, 0.25, 1e-12);
  EXPECT_NEAR(result.paths[1].path.length, 0.25 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(result.paths[2].path.length, 0.0);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(PathSolver, LeadsThroughPointsInOrder)
{
  const std::vector<Id> corners = { CornerOfCube(1, 0, 0), CornerOfCube(0, 0, 0),
    CornerOfCube(0, 1, 1) };
  const PathSolver::Result open =
    Solve({ corners[0] }, { corners[1], corners[2] }, PathType::InOrder);
  EXPECT_EQ(EndsOf(open), (Ids{ { corners[0], corners[1] }, { corners[1], corners[2] } }));
  const PathSolver::Result closed = Solve({}, corners, PathType::Closed);
  EXPECT_EQ(EndsOf(closed),
    (Ids{ { corners[0], corners[1] }, { corners[1], corners[2] }, { corners[2], corners[0] } }));
  EXPECT_NEAR(closed.paths[1].path.length, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(closed.paths[2].path.length, std::sqrt(5.0), 1e-12);
}

/// A point that is given twice leads to itself, not to a point that nobody has given.
TEST(PathSolver, APointGivenTwiceLeadsToItself)
{
  for (const PathType type :
    { PathType::ToNearestSource, PathType::InOrder, PathType::Closed, PathType::AllPairs })
  {
    const PathSolver::Result result = Solve({ 5 }, { 5 }, type);
    EXPECT_EQ(EndsOf(result), (Ids{ { 5, 5 } }));
    EXPECT_EQ(result.paths.front().path.length, 0.0);
  }
  EXPECT_EQ(EndsOf(Solve({ 5, 5 }, {}, PathType::InOrder)), (Ids{ { 5, 5 } }));
  EXPECT_EQ(EndsOf(Solve({ 5, 5, 9 }, {}, PathType::InOrder)), (Ids{ { 5, 9 } }));
}

TEST(PathSolver, ConnectsAllPairs)
{
  const PathSolver::Result result = Solve({ 3, 50 }, { 21, 7 }, PathType::AllPairs);
  EXPECT_EQ(
    EndsOf(result), (Ids{ { 3, 50 }, { 3, 21 }, { 3, 7 }, { 50, 21 }, { 50, 7 }, { 21, 7 } }));
  for (const PathSolver::Path& path : result.paths)
  {
    const PathSolver::Result back = Solve({ path.target }, { path.source });
    EXPECT_NEAR(back.paths.front().path.length, path.path.length, 1e-12);
  }
}

/// A loop around a prism through three points is as long as the prism is around.
TEST(PathSolver, ClosesALoopAroundATorus)
{
  const int around = 12;
  const auto torus = std::make_shared<const TriangleMesh>(Torus(30, around, 2.0, 0.5));
  // The points of a meridian lie in a plane with the axis.
  std::vector<Id> meridian;
  for (std::size_t point = 0; point < torus->points.size(); ++point)
  {
    const Vec3& p = torus->points[point];
    if (std::abs(p[1]) < 1e-12 && p[0] > 0.0)
    {
      meridian.push_back(static_cast<Id>(point));
    }
  }
  ASSERT_EQ(meridian.size(), static_cast<std::size_t>(around));
  const PathSolver::Result result =
    PathSolver::Solve(torus, Given(meridian, {}), Type(PathType::Closed));
  double length = 0.0;
  for (const PathSolver::Path& path : result.paths)
  {
    length += path.path.length;
  }
  EXPECT_NEAR(length, around * 2.0 * 0.5 * std::sin(3.14159265358979323846 / around), 1e-9);
}

/// A missing point is the farthest from the others, up to the error of the search.
TEST(PathSolver, ChoosesPointsThatAreMissing)
{
  const auto sphere = std::make_shared<const TriangleMesh>(GeodesicSphere(12));
  for (const PathSolver::Input& input : { Given({}, {}), Given({ 40 }, {}), Given({}, { 40 }) })
  {
    const PathSolver::Result result = PathSolver::Solve(sphere, input, {});
    ASSERT_EQ(result.paths.size(), 1u);
    const PathSolver::Path& path = result.paths.front();
    EXPECT_LT(sphere->points[path.source].dot(sphere->points[path.target]), -0.95);
    EXPECT_EQ(path.source == 40, !input.sources.ids.empty());
    EXPECT_EQ(path.target == 40, !input.targets.ids.empty());
  }
  EXPECT_EQ(EndsOf(Solve({}, { 5, 9, 7 })), (Ids{ { 5, 9 }, { 5, 7 } }));
}

TEST(PathSolver, NamesTargetsOnOtherComponents)
{
  const auto two = std::make_shared<const TriangleMesh>(
    Join(Box(2), Transform(Box(2), { 0, 0, 1 }, 0.0, 1.0, { 3, 0, 0 })));
  const Id other = static_cast<Id>(two->points.size()) - 1;
  const PathSolver::Result result = PathSolver::Solve(two, Given({ 0 }, { other, 5 }), {});
  ASSERT_EQ(result.paths.size(), 1u);
  EXPECT_EQ(result.paths.front().target, 5);
  EXPECT_EQ(result.unreached, std::vector<Id>{ other });
  ExpectOne(result.warnings, std::to_string(other));
  // Two pairs have no path, and one point is out of reach.
  const PathSolver::Result pairs =
    PathSolver::Solve(two, Given({ 0, 5, other }, {}), Type(PathType::AllPairs));
  EXPECT_EQ(pairs.paths.size(), 1u);
  EXPECT_EQ(pairs.unreached, std::vector<Id>{ other });
  ExpectOne(pairs.warnings, "2 of 3");
}

/// A search that gives up leaves paths that may be longer, and a warning with their number.
TEST(PathSolver, WarnsOfPathsThatMayNotBeTheShortest)
{
  constexpr std::size_t Windows = 40;
  const PathSolver::Input input = Given({ 3, 50 }, { 21, 7 });
  const PathSolver::Result exact = Solve({ 3, 50 }, { 21, 7 }, PathType::AllPairs);
  EXPECT_TRUE(exact.warnings.empty());
  Stages stages;
  LocalSurface surface(stages, Cube, PathSolver::SurfaceDefaults());
  PathSolver solver(Windows);
  const PathSolver::Result& result = solver.Update(surface, input, Type(PathType::AllPairs));
  ASSERT_EQ(result.paths.size(), exact.paths.size());
  std::size_t unknown = 0;
  for (std::size_t k = 0; k < result.paths.size(); ++k)
  {
    unknown += result.paths[k].isShortest ? 0 : 1;
    EXPECT_GE(result.paths[k].path.length, (1.0 - 1e-12) * exact.paths[k].path.length);
  }
  EXPECT_GT(unknown, 0u);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].find(std::to_string(unknown) + " of 6 paths may not"), 0u)
    << result.warnings[0];
}

TEST(PathSolver, RefusesPointsThatAreNone)
{
  const auto beyond = static_cast<Id>(Cube->points.size());
  EXPECT_THROW(Solve({ beyond }, {}), InvalidInput);
  EXPECT_THROW(Solve({}, { -1 }), InvalidInput);
  PathSolver::Input input;
  Field none;
  none.values = MultiVector::Zero(static_cast<Id>(Cube->points.size()), 1);
  input.targets.mask = GivenField::Of("none", none);
  EXPECT_THROW(PathSolver::Solve(Cube, input, {}), InvalidInput);
}

TEST(PathSolver, RepeatsOnlyWhatHasChanged)
{
  Stages stages;
  LocalSurface surface(stages, Cube, PathSolver::SurfaceDefaults());
  PathSolver solver;
  solver.Update(surface, Given({ 0 }, { 9 }), {});
  solver.Update(surface, Given({ 0 }, { 9 }), {});
  EXPECT_EQ(stages.Runs(SolveStage), 1);
  solver.Update(surface, Given({ 0 }, { 11 }), {});
  EXPECT_EQ(stages.Runs(SolveStage), 2);
  EXPECT_EQ(stages.Runs(PathSolver::GraphStage), 1);
  EXPECT_EQ(stages.Runs(SpaceStage), 0);
}

TEST(PathSolver, StopsWhenAsked)
{
  const Progress abort([](double fraction) { return fraction < 0.5; });
  EXPECT_THROW(PathSolver::Solve(Cube, Given({ 0 }, { 9 }), {}, {}, { 0, abort }), Aborted);
}
