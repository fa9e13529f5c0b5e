// Signed distances from curves against exact distances, on both kinds of space.
#include "Distance/CurveDistance.h"
#include "Distance/GeodesicDistance.h"
#include "Largest.h"

#include "Base/Errors.h"
#include "Dense.h"
#include "EitherSpace.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Pi = 3.14159265358979323846;
using Distance = std::function<double(const Vec3&)>;

/// Finds nearest places by a search over all triangles that are near enough.
class NearestOn
{
public:
  explicit NearestOn(const TriangleMesh& mesh) : mesh_(mesh)
  {
    for (const auto& corner : mesh.triangles)
    {
      center_.push_back(
        (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]) / 3.0);
      for (const Id point : corner)
      {
        radius_ = Larger(radius_, (mesh.points[point] - center_.back()).norm());
      }
    }
  }

  std::vector<SurfacePlace> operator()(const Vec3& wanted, double tolerance) const
  {
    std::vector<SurfacePlace> places = { this->Nearest(wanted) };
    const SurfacePlace nearest = places.front();
    for (Id t = 0; t < static_cast<Id>(mesh_.triangles.size()); ++t)
    {
      if (t != nearest.triangle && (center_[t] - nearest.position).norm() - radius_ <= tolerance)
      {
        const Vec3 place = this->PlaceIn(t, nearest.position);
        if ((place - nearest.position).norm() <= tolerance)
        {
          places.push_back({ t, place });
        }
      }
    }
    return places;
  }

private:
  SurfacePlace Nearest(const Vec3& wanted) const
  {
    SurfacePlace nearest{ 0, wanted };
    double least = std::numeric_limits<double>::infinity();
    for (Id t = 0; t < static_cast<Id>(mesh_.triangles.size()); ++t)
    {
      if ((center_[t] - wanted).norm() - radius_ < least)
      {
        const Vec3 place = this->PlaceIn(t, wanted);
        if ((place - wanted).norm() < least)
        {
          least = (place - wanted).norm();
          nearest = { t, place };
        }
      }
    }
    return nearest;
  }

  Vec3 PlaceIn(Id t, const Vec3& wanted) const
  {
    const std::vector<Vec3> candidates = this->Candidates(t, wanted);
    return *std::min_element(candidates.begin(), candidates.end(),
      [&](const Vec3& a, const Vec3& b) { return (a - wanted).norm() < (b - wanted).norm(); });
  }

  std::vector<Vec3> Candidates(Id t, const Vec3& wanted) const
  {
    const auto& corner = mesh_.triangles[t];
    const Vec3& a = mesh_.points[corner[0]];
    Eigen::Matrix<double, 3, 2> edges;
    edges << mesh_.points[corner[1]] - a, mesh_.points[corner[2]] - a;
    const Eigen::Vector2d share = LeastSquares(edges, wanted - a);
    std::vector<Vec3> candidates;
    if (share.minCoeff() >= 0.0 && share.sum() <= 1.0)
    {
      candidates.push_back(a + edges * share);
    }
    for (int k = 0; k < 3; ++k)
    {
      const Vec3& from = mesh_.points[corner[k]];
      const Vec3 along = mesh_.points[corner[(k + 1) % 3]] - from;
      const double t01 = std::clamp((wanted - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
      candidates.push_back(from + t01 * along);
    }
    return candidates;
  }

  const TriangleMesh& mesh_;
  std::vector<Vec3> center_;
  double radius_ = 0.0; // of the largest triangle
};

SurfaceCurve DivideBy(const TriangleMesh& mesh, const std::vector<std::vector<Vec3>>& lines)
{
  return DivideByLines(mesh, lines, NearestOn(mesh), true);
}

/// Marks the points where a function is negative.
Field Inside(const TriangleMesh& mesh, const Distance& distance)
{
  Field inside{ FieldAssociation::Points, MultiVector(static_cast<Id>(mesh.points.size()), 1) };
  for (Id i = 0; i < inside.values.rows(); ++i)
  {
    inside.values(i, 0) = distance(mesh.points[i]) < 0.0 ? 1.0 : 0.0;
  }
  return inside;
}

std::vector<double> Distances(
  const TriangleMesh& mesh, const SurfaceCurve& curve, bool isOnHats, int depth, int threads = 0)
{
  const GeodesicDistance method(BuildEither(mesh, isOnHats, depth, 0.1, threads),
    std::make_shared<const TriangleMesh>(mesh), {}, threads);
  SolveOptions solve;
  solve.tolerance = 1e-4;
  const DistanceField field = method.FromCurve(curve, solve, threads);
  EXPECT_TRUE(field.report.converged);
  EXPECT_EQ(field.unreached, 0);
  return field.atPoints;
}

/// The largest error among points whose exact distance is within a limit.
double LargestError(const TriangleMesh& mesh, const std::vector<double>& found,
  const Distance& exact, double limit = std::numeric_limits<double>::infinity())
{
  double largest = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const double wanted = exact(mesh.points[i]);
    if (std::abs(wanted) <= limit)
    {
      const double error = std::abs(found[i] - wanted);
      largest = Larger(largest, error);
    }
  }
  return largest;
}

/// A line through every triangle that a plane cuts, as vtkCutter makes them.
std::vector<std::vector<Vec3>> Slice(const TriangleMesh& mesh, const Distance& height)
{
  std::vector<std::vector<Vec3>> lines;
  for (const auto& corner : mesh.triangles)
  {
    std::vector<Vec3> line;
    for (int k = 0; k < 3; ++k)
    {
      // From the lower id, so that neighbors have the same point.
      const Vec3& a = mesh.points[std::min(corner[k], corner[(k + 1) % 3])];
      const Vec3& b = mesh.points[std::max(corner[k], corner[(k + 1) % 3])];
      if ((height(a) < 0.0) != (height(b) < 0.0))
      {
        line.push_back(a + height(a) / (height(a) - height(b)) * (b - a));
      }
    }
    if (!line.empty())
    {
      lines.push_back(line);
    }
  }
  return lines;
}

/// Expects points to be on different sides of a curve exactly where they are on different sides of
/// a plane.
void ExpectSidesOf(const TriangleMesh& mesh, const Distance& height, const SurfaceCurve& curve)
{
  for (const auto& corner : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Id a = corner[k];
      const Id b = corner[(k + 1) % 3];
      ASSERT_EQ(curve.side[a] == curve.side[b],
        (height(mesh.points[a]) < 0.0) == (height(mesh.points[b]) < 0.0))
        << a << " " << b << " at " << height(mesh.points[a]) << " and " << height(mesh.points[b]);
    }
  }
}

std::vector<Vec3> Circle(const Vec3& center, double radius, int count)
{
  std::vector<Vec3> line;
  for (int k = 0; k < count; ++k)
  {
    const double angle = 2.0 * Pi * k / count + 0.1;
    line.push_back(center + radius * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  line.push_back(line.front());
  return line;
}

} // namespace

/// A line from border to border. The errors come from heat at the ends, where it leaves obliquely.
TEST(SignedDistance, FromALineOnASquareIsTheDistanceFromItAndErrorsFallWithDepth)
{
  const Distance exact = [](const Vec3& p)
  { return (p[0] - 0.37 - 0.2 * p[1]) / std::sqrt(1.04); }; // the left part is smaller
  const TriangleMesh mesh = FlatRectangle(100, 100);
  const SurfaceCurve curve = DivideBy(mesh, { { { 0.37, 0, 0 }, { 0.57, 1, 0 } } });
  for (const bool isOnHats : { false, true })
  {
    const std::vector<double> coarse = Distances(mesh, curve, isOnHats, 5);
    const std::vector<double> fine = Distances(mesh, curve, isOnHats, 7);
    EXPECT_LT(LargestError(mesh, coarse, exact), 0.02); // sqrt(t) is 0.045 and 0.011
    EXPECT_LT(LargestError(mesh, fine, exact), 0.7 * LargestError(mesh, coarse, exact));
    // Next to the line, even halfway between points of the mesh: the distance has no dots.
    EXPECT_LT(LargestError(mesh, fine, exact, 0.015), 0.002) << isOnHats; // a fifth of an edge
  }
}

/// The corners of one long triangle are far from the line that crosses it. They do not change how
/// exact distances near the line and solved ones are blended elsewhere.
TEST(SignedDistance, ALongTriangleMakesNoStepElsewhere)
{
  constexpr int Edges = 100;
  const TriangleMesh longOne{ { { -1, 0.5, 0.3 }, { 2, 0.45, 0.3 }, { 2, 0.55, 0.3 } },
    { { 0, 1, 2 } } };
  const TriangleMesh mesh = Join(FlatRectangle(Edges, Edges), longOne);
  const Distance exact = [](const Vec3& p) { return p[0] - 0.43; };
  const SurfaceCurve curve = DivideBy(mesh, Slice(mesh, exact));
  for (const bool isOnHats : { false, true })
  {
    const std::vector<double> found = Distances(mesh, curve, isOnHats, 5);
    double largest = 0.0; // error of the difference along an edge, in edges
    for (int k = 0; k + 1 < (Edges + 1) * (Edges + 1); ++k)
    {
      const Vec3& a = mesh.points[k];
      const Vec3& b = mesh.points[k + 1];
      const double difference = found[k + 1] - found[k] - (exact(b) - exact(a));
      largest = Larger(largest, (b - a).norm() < 1.5 / Edges ? Edges * std::abs(difference) : 0.0);
    }
    EXPECT_LT(largest, 6e-4) << isOnHats;
  }
}

TEST(SignedDistance, FromACircleIsNegativeInside)
{
  const TriangleMesh mesh = FlatRectangle(100, 100);
  const Distance exact = [](const Vec3& p) { return (p - Vec3(0.45, 0.52, 0)).norm() - 0.3; };
  const SurfaceCurve curve = DivideBy(mesh, { Circle({ 0.45, 0.52, 0 }, 0.3, 200) });
  for (const bool isOnHats : { false, true })
  {
    const std::vector<double> coarse = Distances(mesh, curve, isOnHats, 5);
    const std::vector<double> fine = Distances(mesh, curve, isOnHats, 7);
    EXPECT_LT(LargestError(mesh, fine, exact), 0.02); // in the center, where fronts meet
    EXPECT_LT(LargestError(mesh, fine, exact), 0.55 * LargestError(mesh, coarse, exact));
    EXPECT_LT(LargestError(mesh, fine, exact, 0.02), 0.002) << isOnHats;
    for (std::size_t i = 0; i < fine.size(); ++i)
    {
      ASSERT_GE(fine[i] * exact(mesh.points[i]), -1e-6) << i; // the circle is a polygon
    }
  }
}

TEST(SignedDistance, FromTheEquatorIsTheLatitude)
{
  constexpr double Radius = 3.0;
  const auto errorAt = [&](bool isOnHats, int depth, int fineness)
  {
    const TriangleMesh mesh =
      Transform(GeodesicSphere(fineness, Radius), { 1, 2, 3 }, 0.7, 1.0, { 4, 5, 6 });
    const TriangleMesh axis = Transform(
      Join(TriangleMesh{ { { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } }, {}),
      { 1, 2, 3 }, 0.7);
    std::vector<Vec3> equator;
    for (const Vec3& p : Circle({ 0, 0, 0 }, 1.0, 90))
    {
      equator.push_back(Vec3(4, 5, 6) + Radius * (p[0] * axis.points[1] + p[1] * axis.points[2]));
    }
    const SurfaceCurve curve = DivideBy(mesh, { equator });
    std::vector<double> found = Distances(mesh, curve, isOnHats, depth);
    // Both halves have the same area: the first point is outside.
    const double sign = (mesh.points[0] - Vec3(4, 5, 6)).dot(axis.points[0]) > 0.0 ? 1.0 : -1.0;
    return LargestError(mesh, found,
      [&](const Vec3& p)
      {
        return sign * Radius *
               std::asin(std::clamp((p - Vec3(4, 5, 6)).dot(axis.points[0]) / Radius, -1.0, 1.0));
      });
  };
  for (const bool isOnHats : { false, true })
  {
    const double coarse = errorAt(isOnHats, 4, 20);
    const double fine = errorAt(isOnHats, 6, 40);
    // A sphere has no border and no crease, so less smoothing is no gain there.
    EXPECT_LT(fine, 0.012 * 0.5 * Pi * Radius * (isOnHats ? 1.25 : 1.0)) << isOnHats;
    EXPECT_LT(fine, 0.4 * coarse) << isOnHats;
  }
}

/// The border of a region of points lies half an edge next to the circle. The border of a region of
/// triangles is jagged by an edge.
TEST(SignedDistance, FromTheBorderOfARegionIsAsExactAsItsEdges)
{
  constexpr double Edge = 0.01;
  const TriangleMesh mesh = FlatRectangle(100, 100);
  const Distance exact = [](const Vec3& p) { return (p - Vec3(0.45, 0.52, 0)).norm() - 0.3; };
  const Field points = Inside(mesh, exact);
  Field triangles{ FieldAssociation::Triangles,
    MultiVector::Zero(static_cast<Id>(mesh.triangles.size()), 1) };
  for (Id t = 0; t < triangles.values.rows(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    const Vec3 center =
      (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]) / 3.0;
    triangles.values(t, 0) = exact(center) < 0.0 ? 2.0 : 0.0;
  }
  for (const Field& inside : { points, triangles })
  {
    const SurfaceCurve curve = BorderOfRegion(mesh, inside, true);
    const std::vector<double> found = Distances(mesh, curve, false, 6);
    EXPECT_LT(LargestError(mesh, found, exact, 0.05), Edge);
    EXPECT_LT(LargestError(mesh, found, exact), 0.033); // sqrt(t)
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_GE(found[i] * curve.side[i], 0.0) << i;
    }
  }
}

TEST(SignedDistance, TheBorderOfALabelIsThatOfItsRegion)
{
  const TriangleMesh mesh = FlatRectangle(20, 20);
  const Distance circle = [](const Vec3& p) { return (p - Vec3(0.45, 0.52, 0)).norm() - 0.3; };
  Field labels{ FieldAssociation::Points, MultiVector(static_cast<Id>(mesh.points.size()), 1) };
  Field inside = labels;
  for (Id i = 0; i < labels.values.rows(); ++i)
  {
    const bool isInside = circle(mesh.points[i]) < 0.0;
    inside.values(i, 0) = isInside ? 1.0 : 0.0;
    labels.values(i, 0) = isInside ? -2.0 : double(i % 5); // several labels outside
  }
  const SurfaceCurve curve = BorderOfLabel(mesh, labels, -2, true);
  const SurfaceCurve expected = BorderOfRegion(mesh, inside, true);
  EXPECT_EQ(curve.side, expected.side);
  EXPECT_EQ(Distances(mesh, curve, false, 4), Distances(mesh, expected, false, 4));
  for (const double wrong : { 0.5, std::nan("") })
  {
    labels.values(7, 0) = wrong;
    EXPECT_THROW(BorderOfLabel(mesh, labels, -2, true), InvalidInput) << wrong;
  }
}

/// Two rings around a tube divide it into a short and a long part. Each component has rings of its
/// own.
TEST(SignedDistance, TakesSeveralCurvesOnSeveralComponents)
{
  constexpr double Tube = 0.2;
  const auto torus = [](const Vec3& shift) {
    return Transform(Torus(120, 24, 1.0, Tube), { 1, 0, 0 }, 0.0, 1.0, shift);
  };
  const Vec3 shift(0, 0, 1.5);
  const TriangleMesh mesh = Join(torus(Vec3::Zero()), torus(shift));
  // Meridians of the torus at two angles: intersections with a plane through the axis.
  const auto meridian = [](double angle, const Vec3& at)
  {
    const Vec3 outwards(std::cos(angle), std::sin(angle), 0);
    std::vector<Vec3> line;
    for (int k = 0; k <= 48; ++k)
    {
      const double turn = 2.0 * Pi * k / 48.0;
      line.push_back(
        at + (1.0 + Tube * std::cos(turn)) * outwards + Vec3(0, 0, Tube * std::sin(turn)));
    }
    return line;
  };
  const Vec3 none = Vec3::Zero();
  const SurfaceCurve curve = DivideBy(
    mesh, { meridian(0.5, none), meridian(1.7, none), meridian(0.5, shift), meridian(1.7, shift) });
  const std::vector<double> found = Distances(mesh, curve, false, 6);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const Vec3& p = mesh.points[i];
    const double angle = std::remainder(std::atan2(p[1], p[0]) - 1.1, 2.0 * Pi); // from the middle
    if (std::abs(std::abs(angle) - 0.6) > 1e-3)
    {
      ASSERT_EQ(found[i] > 0.0, std::abs(angle) > 0.6) << i;
    }
    // A path around the outside is longer than the straight one, around the inside shorter.
    if (std::hypot(p[0], p[1]) > 1.0 + 0.99 * Tube && std::abs(angle) < 0.9)
    {
      ASSERT_NEAR(found[i], (1.0 + Tube) * (std::abs(angle) - 0.6), 0.08) << i;
    }
  }
  // One ring divides nothing.
  try
  {
    DivideBy(mesh, { meridian(0.5, none) });
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("do not divide"), std::string::npos) << error.what();
  }
}

TEST(SignedDistance, IsTheSameOnASoupAndWithNeedles)
{
  const TriangleMesh coarse = Transform(FlatRectangle(40, 40), { 1, 2, 3 }, 0.5);
  const TriangleMesh needles = Transform(FlatRectangle(40, 400), { 1, 2, 3 }, 0.5);
  const TriangleMesh ends = Transform(
    TriangleMesh{ { { 0.37, 0, 0 }, { 0.57, 1, 0 }, { 0.4, 0.3, 0 } }, {} }, { 1, 2, 3 }, 0.5);
  const std::vector<std::vector<Vec3>> line = { { ends.points[0], ends.points[1] } };
  const std::vector<double> expected = Distances(coarse, DivideBy(coarse, line), false, 5);
  const TriangleMesh soup = Unweld(coarse);
  const std::vector<double> onSoup = Distances(soup, DivideBy(soup, line), false, 5);
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      ASSERT_NEAR(onSoup[soup.triangles[t][k]], expected[coarse.triangles[t][k]], 2e-3);
    }
  }
  const std::vector<double> onNeedles = Distances(needles, DivideBy(needles, line), false, 5);
  for (std::size_t i = 0; i < coarse.points.size(); ++i)
  {
    const std::size_t row = i / 41;
    ASSERT_NEAR(onNeedles[10 * row * 41 + i % 41], expected[i], 4e-3) << i;
  }
}

/// Two sheets a third of a cell apart, joined at one edge. The line is on one of them.
TEST(SignedDistance, DoesNotJumpBetweenSheetsThatAreNearerThanACell)
{
  constexpr double Gap = 0.01;
  constexpr double Length = 2.0 + Gap;
  TriangleMesh mesh = FlatRectangle(201, 50, Length, 0.5);
  std::vector<double> exact;
  for (Vec3& point : mesh.points)
  {
    const double s = point[0];
    exact.push_back(s - 0.6);
    point = s < 1.0         ? Vec3(1.0 - s, point[1], 0)
            : s < 1.0 + Gap ? Vec3(0, point[1], s - 1.0)
                            : Vec3(s - 1.0 - Gap, point[1], Gap);
  }
  const SurfaceCurve curve = DivideBy(mesh, { { { 0.4, 0, 0 }, { 0.4, 0.5, 0 } } });
  for (const bool isOnHats : { false, true })
  {
    const std::vector<double> found = Distances(mesh, curve, isOnHats, 5);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_NEAR(found[i], exact[i], 0.06) << i << " " << isOnHats;
    }
  }
}

TEST(SignedDistance, IsNaNWhereNoCurveIs)
{
  const TriangleMesh mesh = Join(
    FlatRectangle(20, 20), Transform(FlatRectangle(20, 20), { 1, 0, 0 }, 0.0, 1.0, { 0, 0, 3 }));
  const SurfaceCurve curve = DivideBy(mesh, { { { 0.37, 0, 0 }, { 0.57, 1, 0 } } });
  const std::vector<double> found = Distances(mesh, curve, false, 5);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_EQ(std::isnan(found[i]), mesh.points[i][2] > 1.0) << i;
  }
}

TEST(SignedDistance, IsTheSameBitForBitWithAnyNumberOfThreads)
{
  const TriangleMesh mesh = GeodesicSphere(20);
  const SurfaceCurve curve = DivideBy(mesh, { Circle({ 0, 0, 0.3 }, 1.0, 90) });
  for (const bool isOnHats : { false, true })
  {
    EXPECT_EQ(Distances(mesh, curve, isOnHats, 5, 1), Distances(mesh, curve, isOnHats, 5, 3));
  }
}

/// Lines along edges of the mesh, through its points, in pieces, and repeated.
TEST(SignedDistance, FollowsLinesAlongEdgesAndInPieces)
{
  const TriangleMesh mesh = FlatRectangle(10, 10);
  const std::vector<std::vector<Vec3>> pieces = { { { 0.3, 0, 0 }, { 0.3, 0.5, 0 } },
    { { 0.3, 1, 0 }, { 0.3, 0.8, 0 }, { 0.3, 0.5, 0 } } };
  const SurfaceCurve curve = DivideBy(mesh, pieces);
  const std::vector<double> near = DistancesNear(curve, mesh, 10.0);
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    ASSERT_NEAR(near[i], mesh.points[i][0] - 0.3, 1e-6) << i; // the resolution of lines
  }
  double length = 0.0;
  for (const TriangleSegment& segment : curve.segments)
  {
    const auto& corner = mesh.triangles[segment.triangle];
    const auto at = [&](double t)
    {
      return PointOfSegment(
        segment, t, mesh.points[corner[0]], mesh.points[corner[1]], mesh.points[corner[2]]);
    };
    length += (at(1.0) - at(0.0)).norm();
  }
  EXPECT_NEAR(length, 1.0, 1e-5); // up to the resolution at points of the mesh
}

/// Boxes that stand on each other, and sheets on top of each other. The nearest triangle of a point
/// of a slice belongs sometimes to one part, sometimes to the other.
TEST(SignedDistance, TakesSlicesOfPartsThatTouch)
{
  const std::vector<TriangleMesh> meshes = {
    Join(Box(7), Box(5, { 0.1, 0.3, 1.0 }, { 0.9, 1.2, 1.8 })),
    Join(FlatRectangle(17, 17),
      Transform(FlatRectangle(29, 23), { 0, 0, 1 }, 0.7, 0.6, { 0.5, 0.1, 0 })),
  };
  for (const TriangleMesh& mesh : meshes)
  {
    for (const Vec3& normal : { Vec3(1, 0.2, 0.1), Vec3(0.3, -1, 0.2), Vec3(-0.4, 0.53, 0.3) })
    {
      const Distance height = [&](const Vec3& p) { return normal.dot(p - Vec3(0.41, 0.37, 0)); };
      SCOPED_TRACE(normal.transpose());
      ExpectSidesOf(mesh, height, DivideBy(mesh, Slice(mesh, height)));
    }
  }
}

/// Doubled triangles with the opposite orientation, as pockets, sheets that cross in an edge, and
/// triangles that face either way.
TEST(SignedDistance, TakesSlicesOfSurfacesThatAreNotManifold)
{
  TriangleMesh doubled = GeodesicSphere(12);
  for (std::size_t t = 0; t < doubled.triangles.size(); t += 5)
  {
    auto again = doubled.triangles[t];
    doubled.triangles.push_back(again);
    if (t % 2 == 0)
    {
      std::swap(doubled.triangles.back()[0], doubled.triangles.back()[1]);
    }
  }
  TriangleMesh pockets = GeodesicSphere(12);
  for (std::size_t t = 0; t < 400; t += 9)
  {
    const auto corner = pockets.triangles[t];
    const auto tip = static_cast<Id>(pockets.points.size());
    pockets.points.push_back(1.2 * pockets.points[corner[0]]);
    pockets.triangles.push_back({ corner[1], corner[2], tip });
    pockets.triangles.push_back({ tip, corner[2], corner[1] });
  }
  const TriangleMesh upright =
    Transform(FlatRectangle(10, 10), { 1, 0, 0 }, 1.5707963267948966, 1.0, { 0, 0.5, -0.5 });
  TriangleMesh crossing = Join(FlatRectangle(10, 10), upright);
  for (Vec3& point : crossing.points)
  {
    point = (10.0 * point).array().round() / 10.0; // points of the common edge coincide
  }
  const TriangleMesh turned = TurnSome(GeodesicSphere(12), 0.4, 1);
  for (const TriangleMesh& mesh : { doubled, pockets, crossing, turned })
  {
    for (const Vec3& normal : { Vec3(1, 0.2, 0.1), Vec3(0.3, -1, 0.2), Vec3(-0.4, 0.53, 0.3) })
    {
      const Distance height = [&](const Vec3& p) { return normal.dot(p - Vec3(0.41, 0.37, 0)); };
      ExpectSidesOf(mesh, height, DivideBy(mesh, Slice(mesh, height)));
    }
  }
}

TEST(SignedDistance, TakesALineThatIsThereTwiceOnce)
{
  const TriangleMesh mesh = FlatRectangle(10, 10);
  const std::vector<Vec3> line = { { 0.33, 0, 0 }, { 0.46, 0.41, 0 }, { 0.57, 1, 0 } };
  const std::vector<Vec3> back(line.rbegin(), line.rend());
  const SurfaceCurve once = DivideBy(mesh, { line });
  const SurfaceCurve twice = DivideBy(mesh, { line, back });
  EXPECT_EQ(once.side, twice.side);
  EXPECT_EQ(once.segments.size(), twice.segments.size());
}

/// Lines within one triangle: across two adjacent borders, closed around no point, and open.
TEST(SignedDistance, TakesLinesWithinATriangle)
{
  const TriangleMesh triangle{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } };
  const SurfaceCurve corner = DivideBy(triangle, { { { 0.3, 0, 0 }, { 0, 0.3, 0 } } });
  EXPECT_EQ(corner.side, (std::vector<signed char>{ -1, 1, 1 }));
  const TriangleMesh square = FlatRectangle(4, 4);
  const SurfaceCurve ear = DivideBy(square, { { { 0, 0.8, 0 }, { 0.2, 1, 0 } } });
  EXPECT_EQ(std::count(ear.side.begin(), ear.side.end(), -1), 1);
  const std::vector<Vec3> loop = Circle({ 0.1, 0.05, 0 }, 0.02, 7);
  const SurfaceCurve within = DivideBy(square, { loop });
  EXPECT_EQ(std::count(within.side.begin(), within.side.end(), 1), 25);
  EXPECT_THROW(DivideBy(square, { { loop.begin(), loop.begin() + 3 } }), InvalidInput);
}

TEST(SignedDistance, RefusesLinesThatDivideNothing)
{
  const TriangleMesh mesh = FlatRectangle(10, 10);
  const std::vector<std::pair<std::string, std::vector<std::vector<Vec3>>>> cases = {
    { "not closed", { { { 0.23, 0.21, 0 }, { 0.24, 0.22, 0 } } } },
    { "(0.466667, 0.533333, 0)", { { { 0.23, 0, 0 }, { 0.5, 0.51, 0 } } } },
    { "ends", { { { 0.23, 0, 0 }, { 0.23, 1, 0 } }, { { 0.23, 0.51, 0 }, { 1, 0.51, 0 } } } },
    { "no length", { { { 0.23, 0.2, 0 } } } },
    { "no length", {} },
  };
  for (const auto& [reason, lines] : cases)
  {
    try
    {
      DivideBy(mesh, lines);
      FAIL() << reason;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
  const TriangleMesh sheets = TwoSheets(4, 0.5);
  EXPECT_THROW(DivideBy(sheets, { { { 0.2, 0.3, 0.0 }, { 0.2, 0.3, 0.5 } } }), InvalidInput);
  Field inside{ FieldAssociation::Points,
    MultiVector::Ones(static_cast<Id>(mesh.points.size()), 1) };
  EXPECT_THROW(BorderOfRegion(mesh, inside, true), InvalidInput);
  inside.values.resize(3, 1);
  EXPECT_THROW(BorderOfRegion(mesh, inside, true), InvalidInput);
  const GeodesicDistance method(
    BuildEither(mesh, false, 4, 0.1), std::make_shared<const TriangleMesh>(mesh), {});
  EXPECT_THROW(method.FromCurve({}, {}), InvalidInput);
}
