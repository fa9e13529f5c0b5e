// Distances against exact distances on surfaces with known distances, on both kinds of space.
#include "Distance/GeodesicDistance.h"
#include "Largest.h"

#include "Base/Errors.h"
#include "Dense.h"
#include "Distance/CurveDistance.h"
#include "Distance/DistantHeat.h"
#include "EitherSpace.h"
#include "Solvers/SolveWarnings.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Pi = 3.14159265358979323846;

std::shared_ptr<const FiniteElementSpace> Build(
  const TriangleMesh& mesh, bool isOnHats, int depth, int threads = 0)
{
  return BuildEither(mesh, isOnHats, depth, 0.1, threads);
}

SolveOptions Solve()
{
  SolveOptions solve;
  solve.tolerance = 1e-4;
  return solve;
}

DistanceField Distances(
  const TriangleMesh& mesh, const std::vector<Id>& sources, bool isOnHats, int depth)
{
  const GeodesicDistance distance(
    Build(mesh, isOnHats, depth), std::make_shared<const TriangleMesh>(mesh), {});
  DistanceField field = distance.From(sources, Solve());
  EXPECT_TRUE(field.report.converged);
  EXPECT_EQ(field.unreached, 0);
  for (const Id source : sources)
  {
    EXPECT_EQ(field.atPoints[source], 0.0);
  }
  return field;
}

double LargestError(const DistanceField& field, const std::vector<double>& exact)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    const double error = std::abs(field.atPoints[i] - exact[i]);
    largest = Larger(largest, error);
  }
  return largest;
}

std::vector<double> ExactOf(
  const TriangleMesh& mesh, const std::function<double(const Vec3&)>& distanceOf)
{
  std::vector<double> exact;
  for (const Vec3& point : mesh.points)
  {
    exact.push_back(distanceOf(point));
  }
  return exact;
}

Id NearestPoint(const TriangleMesh& mesh, const Vec3& place)
{
  Id nearest = 0;
  for (Id i = 1; i < static_cast<Id>(mesh.points.size()); ++i)
  {
    if ((mesh.points[i] - place).norm() < (mesh.points[nearest] - place).norm())
    {
      nearest = i;
    }
  }
  return nearest;
}

std::vector<double> DistancesInSpace(const TriangleMesh& mesh, const std::vector<Id>& sources)
{
  return ExactOf(mesh,
    [&](const Vec3& point)
    {
      double least = 1e300;
      for (const Id source : sources)
      {
        least = std::min(least, (point - mesh.points[source]).norm());
      }
      return least;
    });
}

/// Largest error from one point over half the great circle.
double ErrorOnSphere(bool isOnHats, int depth, int fineness)
{
  constexpr double Radius = 2.0;
  const TriangleMesh mesh = Transform(GeodesicSphere(fineness, Radius), { 1, 2, 3 }, 0.7);
  const Vec3 pole = mesh.points[17] / Radius;
  const std::vector<double> exact = ExactOf(mesh,
    [&](const Vec3& p) { return Radius * std::acos(std::clamp(pole.dot(p) / Radius, -1.0, 1.0)); });
  return LargestError(Distances(mesh, { 17 }, isOnHats, depth), exact) / (Pi * Radius);
}

/// Largest error over the diagonal of a square with four sources, two of them close to each other.
double ErrorOnSquare(bool isOnHats, int depth, int fineness)
{
  TriangleMesh mesh = FlatRectangle(fineness, fineness);
  std::vector<Id> sources;
  for (const Vec3& place :
    { Vec3(0.13, 0.22, 0), Vec3(0.71, 0.35, 0), Vec3(0.42, 0.88, 0), Vec3(0.2, 0.3, 0) })
  {
    sources.push_back(NearestPoint(mesh, place));
  }
  mesh = Transform(mesh, { 1, 2, 3 }, 0.5, 4.0);
  const std::vector<double> exact = DistancesInSpace(mesh, sources);
  return LargestError(Distances(mesh, sources, isOnHats, depth), exact) / (4.0 * std::sqrt(2.0));
}

/// A strip of the given length, bent so that its point at length s moves to (x(s), y, z(s)).
TriangleMesh BentStrip(
  int along, int across, double length, double width, const std::function<Vec3(double)>& place)
{
  return Mapped(FlatRectangle(along, across, length, width),
    [&](const Vec3& p) -> Vec3 { return place(p[0]) + Vec3(0, p[1], 0); });
}

/// Exact distances on a flat strip. Bending keeps them.
std::vector<double> DistancesOnStrip(int along, int across, double length, double width, Id source)
{
  return DistancesInSpace(FlatRectangle(along, across, length, width), { source });
}

/// The values of all functions at a point.
MultiVector LoadOfPoint(const FiniteElementSpace& space, Id point)
{
  const SparseMatrix row = space.RowsAtPoints({ point });
  MultiVector load = MultiVector::Zero(row.columns, 1);
  for (std::size_t k = 0; k < row.column.size(); ++k)
  {
    load(row.column[k], 0) = row.value[k];
  }
  return load;
}

} // namespace

TEST(GeodesicDistance, OnASphereIsTheGreatCircleAndErrorsFallWithDepth)
{
  const double coarse = ErrorOnSphere(false, 4, 40);
  const double fine = ErrorOnSphere(false, 5, 40);
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(fine, 0.65 * coarse);
  const double coarseOnHats = ErrorOnSphere(true, 4, 20);
  const double fineOnHats = ErrorOnSphere(true, 5, 40);
  EXPECT_LT(fineOnHats, 0.01);
  EXPECT_LT(fineOnHats, 0.65 * coarseOnHats);
}

TEST(GeodesicDistance, OnASphereAtTheDefaultDepthIsWithinOnePercent)
{
  EXPECT_LT(ErrorOnSphere(false, 7, 60), 0.01);
}

/// From the middle of a face of a turned cube. With a weak stabilization the heat is negative
/// beyond the edges, and distances are wrong; this must be told.
TEST(GeodesicDistance, TellsWhenTheHeatOscillatesAtEdges)
{
  const TriangleMesh cube = Box(16);
  const Id source = NearestPoint(cube, { 0.5, 0.5, 1.0 });
  const Id opposite = NearestPoint(cube, { 0.5, 0.5, 0.0 });
  for (const Vec3& axis : { Vec3(3, 5, 8), Vec3(1, -2, 0.5), Vec3(0.2, 1, 1) })
  {
    const auto mesh = std::make_shared<const TriangleMesh>(Transform(cube, axis, 1.1));
    const auto from = [&](double stabilization)
    {
      DistanceOptions options;
      options.estimateErrors = true;
      const GeodesicDistance method(BuildEither(*mesh, false, 5, stabilization), mesh, options);
      return method.From({ source }, Solve());
    };
    const DistanceField strong = from(DistanceOptions::LeastStabilization);
    EXPECT_FALSE(strong.heatOscillates);
    EXPECT_TRUE(strong.accuracy.isTrusted);
    EXPECT_NEAR(strong.atPoints[opposite], 2.0, 0.06);
    const DistanceField weak = from(1e-4);
    EXPECT_TRUE(weak.heatOscillates);
    EXPECT_FALSE(weak.accuracy.isTrusted);
    EXPECT_FALSE(WarningsOf(weak, 1e-4).empty());
  }
}

TEST(GeodesicDistance, SaysHowFarItIsOff)
{
  // Great circles on a sphere, and two sources on a square, whose fronts meet at a crease.
  TriangleMesh sphere = GeodesicSphere(40);
  TriangleMesh square = FlatRectangle(100, 100);
  const std::vector<Id> ofSquare = { NearestPoint(square, { 0.2, 0.3, 0.0 }),
    NearestPoint(square, { 0.8, 0.6, 0.0 }) };
  const std::vector<double> onSquare = DistancesInSpace(square, ofSquare);
  const Vec3 pole = sphere.points[3];
  const std::vector<double> onSphere = ExactOf(
    sphere, [&](const Vec3& point) { return std::acos(std::clamp(point.dot(pole), -1.0, 1.0)); });
  sphere = Transform(sphere, { 1, 2, 3 }, 0.5);
  square = Transform(square, { 1, 2, 3 }, 0.5);
  for (const bool isOnHats : { false, true })
  {
    for (const int depth : { 5, 6 })
    {
      for (const bool isSphere : { true, false })
      {
        SCOPED_TRACE(std::to_string(isOnHats) + std::to_string(depth) + std::to_string(isSphere));
        const TriangleMesh& mesh = isSphere ? sphere : square;
        DistanceOptions options;
        options.estimateErrors = true;
        const GeodesicDistance method(
          Build(mesh, isOnHats, depth), std::make_shared<const TriangleMesh>(mesh), options);
        const DistanceField field =
          method.From(isSphere ? std::vector<Id>{ 3 } : ofSquare, Solve());
        const double largest = LargestError(field, isSphere ? onSphere : onSquare);
        EXPECT_TRUE(field.accuracy.isTrusted);
        EXPECT_GT(field.accuracy.largest, largest / 3.0);
        EXPECT_LT(field.accuracy.largest, largest * 4.0);
        EXPECT_GT(field.accuracy.discretization, 0.0);
        EXPECT_LT(field.accuracy.discretization, 0.3);
        EXPECT_LT(field.accuracy.algebraic, 0.1 * field.accuracy.discretization);
      }
    }
  }
  const DistanceField unasked = Distances(sphere, { 3 }, false, 4);
  EXPECT_TRUE(std::isnan(unasked.accuracy.discretization));
}

TEST(GeodesicDistance, FromSeveralSourcesOnASquareHasErrorsThatFallWithDepth)
{
  const double errors[] = { ErrorOnSquare(false, 5, 100), ErrorOnSquare(false, 6, 100),
    ErrorOnSquare(false, 7, 100) };
  EXPECT_LT(errors[2], 0.02);
  EXPECT_LT(errors[2], 0.75 * errors[1]);
  EXPECT_LT(errors[1], 0.75 * errors[0]);
  EXPECT_LT(ErrorOnSquare(true, 7, 100), 0.02); // the heat flows on the grid
}

TEST(GeodesicDistance, DoesNotDependOnTheTriangles)
{
  const TriangleMesh coarse = Transform(FlatRectangle(5, 5), { 1, 2, 3 }, 0.5);
  const TriangleMesh needles = Transform(FlatRectangle(5, 400), { 1, 2, 3 }, 0.5);
  const TriangleMesh soup = Unweld(coarse);
  const Vec3 place = coarse.points[8];
  const auto at = [&](const TriangleMesh& mesh)
  {
    const DistanceField field = Distances(mesh, { NearestPoint(mesh, place) }, false, 5);
    std::vector<double> values;
    for (const Vec3& point : coarse.points)
    {
      values.push_back(field.atPoints[NearestPoint(mesh, point)]);
    }
    return values;
  };
  const std::vector<double> expected = at(coarse);
  // Near the source, distances are off by a part of sqrt(t), which is 0.066 at this depth.
  EXPECT_LT(
    LargestError({ expected, {}, false, 0, 0, false, {} }, DistancesInSpace(coarse, { 8 })), 0.05);
  EXPECT_LT(
    LargestError({ expected, {}, false, 0, 0, false, {} }, at(needles)), 2e-4); // other quadrature
  EXPECT_LT(
    LargestError({ expected, {}, false, 0, 0, false, {} }, at(soup)), 1e-11); // other order of sums
}

/// Two sheets a third of a cell apart, joined at one edge. The path leads around this edge.
TEST(GeodesicDistance, DoesNotJumpBetweenSheetsThatAreNearerThanACell)
{
  const double gap = 0.01;
  const double width = 0.5;
  const auto fold = [=](double s)
  {
    return s < 1.0         ? Vec3(1.0 - s, 0, 0)
           : s < 1.0 + gap ? Vec3(0, 0, s - 1.0)
                           : Vec3(s - 1.0 - gap, 0, gap);
  };
  const TriangleMesh mesh = BentStrip(201, 50, 2.0 + gap, width, fold);
  const Id source = 25 * 202;
  const std::vector<double> exact = DistancesOnStrip(201, 50, 2.0 + gap, width, source);
  for (const bool isOnHats : { false, true })
  {
    const DistanceField field = Distances(mesh, { source }, isOnHats, 5);
    EXPECT_LT(LargestError(field, exact), 0.03 * 2.0) << isOnHats;
  }
}

/// Sixty widths and five extents long, so that heat falls by 1e-100 and more.
TEST(GeodesicDistance, IsRightFarAwayOnALongRoll)
{
  constexpr double Length = 8.0;
  constexpr double Start = 0.15; // radius; 0.05 more in every turn
  const auto roll = [](double s)
  {
    constexpr double Slope = 0.05 / (2.0 * Pi);
    const double angle = (std::sqrt(Start * Start + 2.0 * Slope * s) - Start) / Slope;
    const double radius = Start + Slope * angle;
    return Vec3(radius * std::cos(angle), 0, radius * std::sin(angle));
  };
  const TriangleMesh mesh = BentStrip(2000, 20, Length, 0.1, roll);
  const std::vector<double> exact = DistancesOnStrip(2000, 20, Length, 0.1, 0);
  const DistanceField field = Distances(mesh, { 0 }, false, 6);
  EXPECT_LT(LargestError(field, exact), 0.005 * Length);
}

TEST(GeodesicDistance, FromARegionIsThatFromItsRim)
{
  constexpr double Radius = 0.25;
  const TriangleMesh mesh = FlatRectangle(120, 120);
  const Vec3 center(0.45, 0.5, 0);
  std::vector<Id> sources;
  for (Id i = 0; i < static_cast<Id>(mesh.points.size()); ++i)
  {
    if ((mesh.points[i] - center).norm() <= Radius)
    {
      sources.push_back(i);
    }
  }
  const std::vector<double> exact =
    ExactOf(mesh, [&](const Vec3& p) { return std::max(0.0, (p - center).norm() - Radius); });
  for (const bool isOnHats : { false, true })
  {
    // Distances at the corners, where fronts end, are off by a part of sqrt(t), which is 0.033.
    // Heat flows on the grid for hats, too.
    EXPECT_LT(LargestError(Distances(mesh, sources, isOnHats, 6), exact), 0.027) << isOnHats;
  }
}

namespace
{

/// Points on the border of a square. Without its corners no triangle is a source as a whole.
std::vector<Id> BorderOfSquare(const TriangleMesh& mesh)
{
  std::vector<Id> border;
  for (Id i = 0; i < static_cast<Id>(mesh.points.size()); ++i)
  {
    const Vec3& p = mesh.points[i];
    const double x = std::min(p[0], 1.0 - p[0]);
    const double y = std::min(p[1], 1.0 - p[1]);
    if ((x < 1e-9) != (y < 1e-9))
    {
      border.push_back(i);
    }
  }
  return border;
}

} // namespace

/// No path along the surface is shorter than the straight line to the nearest source. Many sources
/// along a curve, at corners and beside each other make the heat method go wrong there.
TEST(GeodesicDistance, IsNeverBelowTheStraightLineNorZeroBesideASource)
{
  const TriangleMesh square = FlatRectangle(60, 60);
  const TriangleMesh sphere = GeodesicSphere(24);
  const TriangleMesh torus = Torus(60, 30, 1.0, 0.4);
  const std::pair<const TriangleMesh&, std::vector<Id>> cases[] = { { square,
                                                                      BorderOfSquare(square) },
    { sphere, EveryPoint(sphere, 7) }, { sphere, { 0 } }, { torus, EveryPoint(torus, 50) } };
  for (const auto& [mesh, sources] : cases)
  {
    const std::vector<double> straight = DistancesInSpace(mesh, sources);
    for (const bool isOnHats : { false, true })
    {
      const DistanceField field = Distances(mesh, sources, isOnHats, 5);
      for (std::size_t i = 0; i < straight.size(); ++i)
      {
        ASSERT_GE(field.atPoints[i], (1.0 - 1e-14) * straight[i]) << i << " " << isOnHats;
        ASSERT_EQ(field.atPoints[i] == 0.0, straight[i] == 0.0) << i << " " << isOnHats;
      }
    }
  }
}

/// The bound of a signed distance is on its absolute value.
TEST(GeodesicDistance, WithASignIsNeverNearerThanTheStraightLine)
{
  const TriangleMesh mesh = FlatRectangle(60, 60);
  Field isInside;
  isInside.values = MultiVector::Zero(static_cast<Id>(mesh.points.size()), 1);
  for (Id i = 0; i < isInside.values.rows(); ++i)
  {
    const Vec3 p = mesh.points[i] - Vec3(0.5, 0.5, 0.0);
    const double angle = std::atan2(p[1], p[0]);
    isInside.values(i, 0) = p.norm() < 0.3 + 0.1 * std::sin(7.0 * angle) ? 1.0 : 0.0;
  }
  const SurfaceCurve curve = BorderOfRegion(mesh, isInside, false);
  const std::vector<double> straight = DistancesThroughSpace(mesh, PiecesOf(curve, mesh), 1);
  for (const bool isOnHats : { false, true })
  {
    const GeodesicDistance distance(
      Build(mesh, isOnHats, 4), std::make_shared<const TriangleMesh>(mesh), {});
    const std::vector<double> found = distance.FromCurve(curve, Solve()).atPoints;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_GE(std::abs(found[i]), (1.0 - 1e-14) * straight[i]) << i;
      ASSERT_EQ(found[i]<0.0, isInside.values(static_cast<Id>(i), 0)> 0.0) << i;
    }
  }
}

TEST(GeodesicDistance, IsNaNWhereItsSourcesCannotReach)
{
  TriangleMesh mesh = TwoSheets(20, 0.001);
  mesh.points.push_back({ 0.5, 0.5, 3.0 }); // no triangle uses it
  const auto points = static_cast<Id>(mesh.points.size());
  for (const bool isOnHats : { false, true })
  {
    const DistanceField field = Distances(mesh, { 5 }, isOnHats, 4);
    for (Id i = 0; i < points; ++i)
    {
      ASSERT_EQ(std::isnan(field.atPoints[i]), i >= (points - 1) / 2) << i;
    }
  }
}

TEST(GeodesicDistance, ScalesWithTheMesh)
{
  const TriangleMesh mesh = Torus(40, 20, 1.0, 0.4);
  const TriangleMesh large = Transform(mesh, { 1, 0, 0 }, 0.0, 10.0);
  for (const bool isOnHats : { false, true })
  {
    const DistanceField one = Distances(mesh, { 3 }, isOnHats, 4);
    const DistanceField ten = Distances(large, { 3 }, isOnHats, 4);
    for (std::size_t i = 0; i < one.atPoints.size(); ++i)
    {
      ASSERT_NEAR(10.0 * one.atPoints[i], ten.atPoints[i], 1e-2);
    }
  }
}

/// Heat that comes from far is smooth, and distances from it are rounded by about sqrt(t). On the
/// coarsest level heat is everywhere.
TEST(GeodesicDistance, IsFoundHoweverFarTheHeatComes)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(30));
  std::vector<double> errors;
  for (const double smoothing : { 3.0, 6.0, 20.0, 1000.0 })
  {
    DistanceOptions options;
    options.smoothing = smoothing;
    const GeodesicDistance distance(Build(*mesh, false, 6), mesh, options);
    const DistanceField field = distance.From({ 17 }, Solve());
    EXPECT_TRUE(field.report.converged) << smoothing;
    EXPECT_LT(field.heatSweeps, 60.0) << smoothing;
    errors.push_back(LargestError(field,
      ExactOf(*mesh,
        [&](const Vec3& p) { return std::acos(std::clamp(mesh->points[17].dot(p), -1.0, 1.0)); })));
  }
  EXPECT_LT(errors[0], 0.02 * Pi);
  EXPECT_LT(errors[1], 0.04 * Pi);
  EXPECT_LT(errors[2], 0.12 * Pi);
  EXPECT_LT(errors[3], 0.3 * Pi);
}

TEST(GeodesicDistance, DoesNotDependOnThreadsNorOnOtherSourcesBeforeAndStopsWhenAsked)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(30));
  DistanceOptions options;
  options.multigrid.threads = 1;
  const GeodesicDistance alone(Build(*mesh, false, 5, 1), mesh, options, 1);
  options.multigrid.threads = 3;
  const GeodesicDistance distance(Build(*mesh, false, 5, 3), mesh, options, 3);
  distance.From({ 4, 90 }, Solve(), 3);
  EXPECT_EQ(alone.From({ 7 }, Solve(), 1).atPoints, distance.From({ 7 }, Solve(), 3).atPoints);
  const Job stop(0, Progress([](double done) { return done < 0.5; }));
  EXPECT_THROW(distance.From({ 7 }, Solve(), stop), Aborted);
}

TEST(GeodesicDistance, RefusesWhatIsNoSourceAndNoSmoothing)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(4));
  const auto space = Build(*mesh, false, 3);
  const GeodesicDistance distance(space, mesh, {});
  EXPECT_THROW(distance.From({}, Solve()), InvalidInput);
  EXPECT_THROW(distance.From({ -1 }, Solve()), InvalidInput);
  EXPECT_THROW(distance.From({ 100000 }, Solve()), InvalidInput);
  for (const double smoothing : { 0.0, -1.0, std::nan(""), double(INFINITY) })
  {
    DistanceOptions options;
    options.smoothing = smoothing;
    EXPECT_THROW(GeodesicDistance(space, mesh, options), InvalidInput);
  }
}

/// Each equation holds to 1 % of its own terms, both where u is 1 and where it is 1e-60.
TEST(DistantHeat, IsAccurateRelativeToWhatArrives)
{
  const TriangleMesh mesh = FlatRectangle(400, 10, 1.0, 0.02);
  const auto space = Build(mesh, false, 7);
  const DistantHeat equation(*space, 0, 3.0);
  const MultiVector load = LoadOfPoint(*space, 0);
  const HeatField heat = equation.From(load);
  EXPECT_TRUE(heat.converged);
  EXPECT_EQ(heat.unreached, 0);
  EXPECT_LT(heat.sweeps, 40.0);
  const MultiVector& u = heat.coefficients;
  EXPECT_LT(u.cwiseAbs().minCoeff(), 1e-25 * u.maxCoeff<Eigen::PropagateNaN>());
  const SparseMatrix& A = equation.Matrix();
  for (Index i = 0; i < A.rows; ++i)
  {
    double rest = load(i, 0) / 3.0;
    double size = rest;
    for (Id k = A.rowBegin[i]; k < A.rowBegin[i + 1]; ++k)
    {
      rest -= A.value[k] * u(A.column[k], 0);
      size += std::abs(A.value[k] * u(A.column[k], 0));
    }
    ASSERT_LT(std::abs(rest), 0.01 * size) << i << " of " << A.rows;
  }
}

/// Near the sources a direct solver is accurate, too.
TEST(DistantHeat, IsTheSolutionOfTheEquation)
{
  for (const TriangleMesh& mesh :
    { GeodesicSphere(12), Torus(30, 15, 1.0, 0.3), TwoSheets(9, 0.1) })
  {
    const auto space = Build(mesh, false, 4);
    const DistantHeat equation(*space, 0, 3.0);
    const MultiVector load = LoadOfPoint(*space, 7);
    const HeatField heat = equation.From(load);
    EXPECT_TRUE(heat.converged);
    const Eigen::MatrixXd A = Dense(equation.Matrix());
    const Eigen::VectorXd exact = DenseSolution(A, load.col(0) / 3.0);
    const double error =
      (heat.coefficients.col(0) - exact).transpose() * A * (heat.coefficients.col(0) - exact);
    EXPECT_LT(std::sqrt(error), 3e-3 * std::sqrt(exact.dot(A * exact)));
  }
}

/// Every patch, extended by the functions coupled to its first function, up to 27 functions.
UnknownGroups WidePatches(const SparseMatrix& A, const UnknownGroups& patches)
{
  UnknownGroups wide(27);
  for (Id p = 0; p < patches.Count(); ++p)
  {
    const UnknownGroup patch = patches[p];
    std::vector<Index> group(patch.begin(), patch.end());
    for (Id k = A.rowBegin[patch[0]]; k < A.rowBegin[patch[0] + 1]; ++k)
    {
      if (std::find(patch.begin(), patch.end(), A.column[k]) == patch.end())
      {
        group.push_back(A.column[k]);
      }
    }
    group.resize(27, -1);
    wide.Add(group);
  }
  return wide;
}

TEST(DistantHeat, TakesPatchesOfAnySize)
{
  const auto space = Build(GeodesicSphere(12), false, 4);
  const DistantHeat equation(*space, 0, 3.0);
  const SparseMatrix& A = equation.Matrix();
  const DistantHeat wide(
    A, WidePatches(A, space->Relaxation(0, {}).order.dof), 3.0, DistantHeat::SmallChange, 1);
  const MultiVector load = LoadOfPoint(*space, 7);
  const HeatField heat = wide.Continue(load, MultiVector::Zero(A.rows, 1));
  EXPECT_TRUE(heat.converged);
  EXPECT_EQ(heat.unreached, 0);
  const Eigen::VectorXd exact = DenseSolution(Dense(A), load.col(0) / 3.0);
  EXPECT_LT((heat.coefficients.col(0) - exact).norm(), 3e-3 * exact.norm());
}

/// Heat below the smallest number is lost, and counted.
TEST(DistantHeat, SaysWhereItDoesNotArrive)
{
  const TriangleMesh mesh = FlatRectangle(400, 10, 1.0, 0.02);
  const auto space = Build(mesh, false, 7);
  const DistantHeat equation(*space, 0, 0.02);
  MultiVector load = MultiVector::Zero(space->NumberOfFunctions(0), 1);
  load(0, 0) = 1e-250;
  const HeatField heat = equation.From(load);
  EXPECT_GT(heat.unreached, 0);
  EXPECT_LT(heat.unreached, load.rows());
  EXPECT_THROW(equation.From(MultiVector::Zero(3, 1)), InvalidInput);
}
