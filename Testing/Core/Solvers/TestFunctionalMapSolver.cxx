// Maps between surfaces whose corresponding places are known.
#include "Solvers/FunctionalMapSolver.h"

#include "AtDepth.h"
#include "Base/Errors.h"
#include "Largest.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

const SurfaceOptions AtDepth5 = AtDepth<FunctionalMapSolver>(5);

FunctionalMapSolver::Options Modes(int number)
{
  FunctionalMapSolver::Options options;
  options.numberOfModes = number;
  return options;
}

FunctionalMapSolver::Result Map(const TriangleMesh& mesh, const TriangleMesh& reference,
  int modes = 40, const std::vector<Landmark>& landmarks = {}, int threads = 0)
{
  FunctionalMapSolver::Input input;
  input.landmarks = landmarks;
  SurfaceOptions options = AtDepth5;
  options.space.threads = threads;
  return FunctionalMapSolver::Solve(std::make_shared<const TriangleMesh>(mesh),
    std::make_shared<const TriangleMesh>(reference), input, Modes(modes), options);
}

/// A closed surface without any symmetry, from the places of a sphere.
Vec3 Pebble(const Vec3& p)
{
  const double bumps = 0.3 * std::exp(-4.0 * (p - Vec3(0.6, 0.8, 0.0)).squaredNorm()) +
                       0.2 * std::exp(-6.0 * (p - Vec3(-0.3, 0.2, 0.93)).squaredNorm());
  return (1.0 + bumps) * Vec3(1.6 * p[0], p[1], 0.7 * p[2]);
}

/// A flat quadrilateral whose sides and angles all differ, from the unit square.
Vec3 Kite(const Vec3& p)
{
  return { 3.0 * p[0] + 0.8 * p[1], 1.5 * p[1] + 0.7 * p[0] * p[1], 0.0 };
}

/// Rolls the plane up without stretching it.
Vec3 Roll(const Vec3& p)
{
  constexpr double Radius = 1.2;
  return { Radius * std::sin(p[0] / Radius), p[1], Radius * (1.0 - std::cos(p[0] / Radius)) };
}

/// Distances of places from true places.
std::vector<double> Errors(
  const FunctionalMapSolver::Result& result, const std::vector<Vec3>& truth)
{
  std::vector<double> errors;
  for (std::size_t k = 0; k < truth.size(); ++k)
  {
    errors.push_back((result.map.places.row(static_cast<Id>(k)).transpose() - truth[k]).norm());
  }
  return errors;
}

double Largest(const std::vector<double>& values)
{
  double largest = 0.0;
  for (const double value : values)
  {
    largest = Larger(largest, value);
  }
  return largest;
}

double Mean(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / double(values.size());
}

/// Another mesh of the surface: its points are others.
TriangleMesh OtherSphere()
{
  return Transform(GeodesicSphere(20), { 1, 2, 3 }, 0.7);
}

} // namespace

/// A surface that has moved, meshed in another way. Errors are some of an edge of the meshes, 0.1.
TEST(FunctionalMapSolver, FindsTheMotionOfASurface)
{
  const TriangleMesh mesh = Mapped(GeodesicSphere(16), Pebble);
  const TriangleMesh reference =
    Transform(Mapped(OtherSphere(), Pebble), { 1, -1, 2 }, 2.0, 3.0, { 5, 6, 7 });
  const FunctionalMapSolver::Result result = Map(mesh, reference);
  const std::vector<Vec3> truth = Transform(mesh, { 1, -1, 2 }, 2.0, 3.0, { 5, 6, 7 }).points;
  const std::vector<double> errors = Errors(result, truth);
  EXPECT_LT(Mean(errors), 3.0 * 0.02);
  EXPECT_LT(Largest(errors), 3.0 * 0.1);
  EXPECT_LT(result.map.meanMismatch, 0.1);
  EXPECT_FALSE(result.map.isAmbiguous);
  EXPECT_TRUE(result.isConverged);
  EXPECT_TRUE(result.warnings.empty());
}

/// Rolling up a plane keeps all lengths along it.
TEST(FunctionalMapSolver, FindsAnIsometry)
{
  const TriangleMesh flat = Mapped(FlatRectangle(40, 25), Kite);
  const FunctionalMapSolver::Result result =
    Map(Mapped(Mapped(FlatRectangle(30, 20), Kite), Roll), flat);
  const std::vector<double> errors = Errors(result, Mapped(FlatRectangle(30, 20), Kite).points);
  EXPECT_LT(Mean(errors), 0.03); // edges have 0.1
  EXPECT_LT(Largest(errors), 0.15);
  EXPECT_LT(result.map.meanMismatch, 0.1);
}

/// Every triangle of the reference has corners of its own, as in STL files.
TEST(FunctionalMapSolver, FindsPlacesBetweenPointsOfASoup)
{
  const TriangleMesh mesh = Mapped(GeodesicSphere(12), Pebble);
  const TriangleMesh reference = Mapped(OtherSphere(), Pebble);
  const double joined = Mean(Errors(Map(mesh, reference), mesh.points));
  EXPECT_LT(Mean(Errors(Map(mesh, Unweld(reference)), mesh.points)), 1.3 * joined);
}

/// Weights are those of the places, and the matrix takes functions from one surface to the other.
TEST(FunctionalMapSolver, PartsOfAResultAgree)
{
  const TriangleMesh mesh = Mapped(GeodesicSphere(12), Pebble);
  const TriangleMesh reference = Mapped(OtherSphere(), Pebble);
  const FunctionalMapSolver::Result result = Map(mesh, reference, 20);
  const FunctionalMap& map = result.map;
  ASSERT_EQ(map.corners.size(), mesh.points.size());
  for (Id point = 0; point < map.weights.rows(); ++point)
  {
    EXPECT_NEAR(map.weights.row(point).sum(), 1.0, 1e-12);
    EXPECT_GE(map.weights.row(point).minCoeff<Eigen::PropagateNaN>(), 0.0);
    Vec3 place = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      place += map.weights(point, k) * reference.points[map.corners[point][k]];
    }
    EXPECT_LT((map.places.row(point).transpose() - place).norm(), 1e-12);
  }
  const Id modes = map.matrix.rows();
  EXPECT_GE(modes, 20);
  const MultiVector product = map.matrix.transpose() * map.matrix;
  EXPECT_LT((product - MultiVector::Identity(modes, modes)).norm() / std::sqrt(double(modes)), 0.1);
}

/// A shape with one plane of symmetry has two maps. The one that turns no triangle over counts.
TEST(FunctionalMapSolver, KeepsTheSides)
{
  const auto fish = [](const Vec3& p)
  {
    const double bump = 0.4 * std::exp(-5.0 * (p - Vec3(0.9, 0.3, 0.0)).squaredNorm());
    return Vec3((1.0 + bump) * Vec3(1.7 * p[0], p[1] + 0.3 * p[0] * p[0], 0.6 * p[2]));
  };
  const TriangleMesh mesh = Mapped(GeodesicSphere(16), fish);
  const TriangleMesh reference = Mapped(OtherSphere(), fish);
  const std::vector<double> errors = Errors(Map(mesh, reference), mesh.points);
  EXPECT_LT(Mean(errors), 0.03);
  // Landmarks away from the plane can ask for the mirrored map.
  TriangleMesh mirrored = mesh;
  for (Vec3& point : mirrored.points)
  {
    point[2] = -point[2];
  }
  std::vector<Landmark> landmarks;
  for (Id point = 0; point < static_cast<Id>(mesh.points.size()); point += 150)
  {
    Id partner = 0;
    for (Id other = 0; other < static_cast<Id>(mesh.points.size()); ++other)
    {
      const double now = (mesh.points[other] - mirrored.points[point]).norm();
      partner = now < (mesh.points[partner] - mirrored.points[point]).norm() ? other : partner;
    }
    landmarks.push_back({ point, partner });
  }
  EXPECT_LT(Mean(Errors(Map(mesh, mesh, 40, landmarks), mirrored.points)), 0.05);
}

/// A rectangle has a half turn, and landmarks choose between it and no turn.
TEST(FunctionalMapSolver, LandmarksChooseAmongSymmetricMaps)
{
  const TriangleMesh mesh = FlatRectangle(30, 20, 3.0, 2.0);
  const FunctionalMapSolver::Result alone = Map(mesh, mesh, 20);
  EXPECT_TRUE(alone.map.isAmbiguous);
  ASSERT_EQ(alone.warnings.size(), 1u);
  EXPECT_NE(alone.warnings[0].find("several ways"), std::string::npos);
  const Id last = static_cast<Id>(mesh.points.size()) - 1;
  TriangleMesh turned = mesh;
  for (Vec3& point : turned.points)
  {
    point = Vec3(3.0, 2.0, 0.0) - point;
  }
  EXPECT_LT(Mean(Errors(Map(mesh, mesh, 20, { { 0, 0 }, { 200, 200 } }), mesh.points)), 0.02);
  const FunctionalMapSolver::Result half =
    Map(mesh, mesh, 20, { { 0, last }, { 200, last - 200 } });
  EXPECT_LT(Mean(Errors(half, turned.points)), 0.02);
  EXPECT_TRUE(half.warnings.empty());
}

/// Shapes that have nothing in common give a warning, and no good number.
TEST(FunctionalMapSolver, UnrelatedShapesDoNotMatch)
{
  const FunctionalMapSolver::Result result =
    Map(Mapped(GeodesicSphere(12), Pebble), TrefoilTube(120, 12), 40);
  EXPECT_GT(result.map.meanMismatch, 0.35);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("do not match"), std::string::npos);
}

TEST(FunctionalMapSolver, ThreadsChangeNoBit)
{
  const TriangleMesh mesh = Mapped(GeodesicSphere(8), Pebble);
  const FunctionalMapSolver::Result one = Map(mesh, mesh, 12, {}, 1);
  const FunctionalMapSolver::Result three = Map(mesh, mesh, 12, {}, 3);
  EXPECT_EQ(one.map.corners, three.map.corners);
  EXPECT_TRUE(one.map.weights == three.map.weights);
  EXPECT_TRUE(one.map.matrix == three.map.matrix);
}

TEST(FunctionalMapSolver, RefusesWithTheReason)
{
  const TriangleMesh mesh = Mapped(GeodesicSphere(6), Pebble);
  const TriangleMesh two = Join(mesh, Transform(mesh, { 0, 0, 1 }, 0.0, 1.0, { 9, 0, 0 }));
  const auto messageOf = [](auto&& run)
  {
    try
    {
      run();
    }
    catch (const InvalidInput& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(messageOf([&] { Map(two, mesh, 12); }).find("The surface has 2 connected"), 0u);
  EXPECT_EQ(messageOf([&] { Map(mesh, two, 12); }).find("Reference: The surface has 2"), 0u);
  EXPECT_NE(messageOf(
              [&] {
                Map(mesh, mesh, 12, { { 3, 100000 } });
              })
              .find("the Reference uses"),
    std::string::npos);
  EXPECT_NE(messageOf(
              [&] {
                Map(mesh, mesh, 12, { { -1, 3 } });
              })
              .find("the surface uses"),
    std::string::npos);
  EXPECT_NE(messageOf([&] { Map(mesh, mesh, 9); }).find("Number Of Modes"), std::string::npos);
}

/// A second update repeats nothing, another landmark repeats the map alone, and both are the
/// results of one shot.
TEST(FunctionalMapSolver, RepeatsWhatHasChanged)
{
  const auto mesh = std::make_shared<const TriangleMesh>(Mapped(GeodesicSphere(8), Pebble));
  Stages stages;
  Stages ofReference;
  LocalSurface surface(stages, mesh, AtDepth5);
  LocalSurface reference(ofReference, mesh, AtDepth5);
  FunctionalMapSolver solver;
  FunctionalMapSolver::Input input;
  solver.Update(surface, reference, input, Modes(12), {});
  solver.Update(surface, reference, input, Modes(12), {});
  EXPECT_EQ(stages.Runs("Map"), 1);
  input.landmarks = { { 5, 5 } };
  const FunctionalMapSolver::Result& result =
    solver.Update(surface, reference, input, Modes(12), {});
  EXPECT_EQ(stages.Runs("Map"), 2);
  EXPECT_EQ(stages.Runs(SolveStage), 1);
  EXPECT_EQ(ofReference.Runs(SolveStage), 1);
  EXPECT_EQ(result.map.corners, Map(*mesh, *mesh, 12, { { 5, 5 } }).map.corners);
  solver.Update(surface, reference, input, Modes(14), {});
  EXPECT_EQ(ofReference.Runs(SolveStage), 2);
}
