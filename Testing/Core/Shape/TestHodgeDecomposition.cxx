// Vector fields with known parts, on both kinds of space.
#include "Shape/HodgeDecomposition.h"

#include "Base/Errors.h"
#include "EitherSpace.h"
#include "Grid/SurfaceEdges.h"
#include "Grid/TriangleArea.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using VectorField = std::function<Vec3(const Vec3& point)>;

std::unique_ptr<FiniteElementSpace> Build(
  const TriangleMesh& mesh, bool isOnHats, int depth, int threads = 0)
{
  return BuildEither(mesh, isOnHats, depth, 1e-2, threads);
}

HodgeOptions Options(int threads = 0)
{
  HodgeOptions options;
  options.multigrid.threads = threads;
  options.solve.tolerance = 1e-6;
  options.solve.maximumIterations = 200;
  return options;
}

Field AtPoints(const TriangleMesh& mesh, const VectorField& v)
{
  Field field{ FieldAssociation::Points, MultiVector(static_cast<Id>(mesh.points.size()), 3) };
  for (Id i = 0; i < field.values.rows(); ++i)
  {
    SetRow(field.values, i, v(mesh.points[i]));
  }
  return field;
}

/// ∫ <a, b> of vectors on triangles.
double Product(const TriangleMesh& mesh, const MultiVector& a, const MultiVector& b)
{
  double sum = 0.0;
  for (Id t = 0; t < a.rows(); ++t)
  {
    sum += AreaOf(mesh, t) * a.row(t).dot(b.row(t));
  }
  return sum;
}

double Norm(const TriangleMesh& mesh, const MultiVector& a)
{
  return std::sqrt(Product(mesh, a, a));
}

HodgeDecomposition Decompose(const TriangleMesh& mesh, const Field& v, bool isOnHats, int depth)
{
  HodgeDecomposition parts = DecomposeField(*Build(mesh, isOnHats, depth), mesh, v, Options());
  EXPECT_TRUE(parts.report.converged);
  return parts;
}

/// Compares each part with the expected field, and checks the sum and the product of each pair,
/// relative to the field.
void ExpectParts(const TriangleMesh& mesh, const HodgeDecomposition& parts,
  const VectorField& gradient, const VectorField& rotation, const VectorField& rest,
  double tolerance)
{
  const MultiVector all =
    parts.gradientOnTriangles + parts.rotationOnTriangles + parts.restOnTriangles;
  const double size = Norm(mesh, all);
  const auto error = [&](const MultiVector& found, const VectorField& expected)
  {
    MultiVector difference = found;
    for (Id t = 0; t < found.rows(); ++t)
    {
      const auto& corner = mesh.triangles[t];
      const Vec3 middle =
        (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]) / 3.0;
      SetRow(difference, t, Vec3(found.row(t).transpose()) - expected(middle));
    }
    return Norm(mesh, difference) / size;
  };
  EXPECT_LT(error(parts.gradientOnTriangles, gradient), tolerance);
  EXPECT_LT(error(parts.rotationOnTriangles, rotation), tolerance);
  EXPECT_LT(error(parts.restOnTriangles, rest), tolerance);
}

void ExpectOrthogonal(const TriangleMesh& mesh, const HodgeDecomposition& parts, double tolerance)
{
  const MultiVector& a = parts.gradientOnTriangles;
  const MultiVector& b = parts.rotationOnTriangles;
  const MultiVector& c = parts.restOnTriangles;
  const double square = Product(mesh, a + b + c, a + b + c);
  EXPECT_LT(std::abs(Product(mesh, a, b)), tolerance * square);
  EXPECT_LT(std::abs(Product(mesh, b, c)), tolerance * square);
  EXPECT_LT(std::abs(Product(mesh, c, a)), tolerance * square);
}

VectorField operator*(double factor, const VectorField& v)
{
  return [=](const Vec3& p) { return Vec3(factor * v(p)); };
}

VectorField operator+(const VectorField& a, const VectorField& b)
{
  return [=](const Vec3& p) { return Vec3(a(p) + b(p)); };
}

const VectorField Zero = [](const Vec3&) { return Vec3(Vec3::Zero()); };

class Hodge : public ::testing::TestWithParam<bool>
{
protected:
  /// Means on triangles have the products of the functions only on hats.
  double Orthogonality() const { return GetParam() ? 1e-7 : 5e-3; }
};

/// ∇(x y) on a sphere around 0, along the sphere.
Vec3 SlopeOnSphere(const Vec3& p)
{
  const Vec3 n = p.normalized();
  const Vec3 slope(p[1], p[0], 0.0);
  return slope - n.dot(slope) * n;
}

Vec3 TurnedOnSphere(const Vec3& p)
{
  return p.normalized().cross(SlopeOnSphere(p));
}

/// On the torus of radius 1 around z: the gradient of the angle around z, which is harmonic.
Vec3 AroundAxis(const Vec3& p)
{
  return Vec3(-p[1], p[0], 0.0) / (p[0] * p[0] + p[1] * p[1]);
}

Vec3 TorusNormal(const Vec3& p)
{
  const Vec3 middle = Vec3(p[0], p[1], 0.0).normalized();
  return (p - middle).normalized();
}

/// A ring in the plane z = 0, with radii 1 and 2.
TriangleMesh Ring(Id around, Id across)
{
  TriangleMesh mesh = FlatRectangle(static_cast<int>(across), static_cast<int>(around));
  for (Vec3& p : mesh.points)
  {
    const double angle = 2 * M_PI * p[1];
    p = (1.0 + p[0]) * Vec3(std::cos(angle), std::sin(angle), 0.0);
  }
  // The two ends of the rectangle share one row of points, so the angle needs no welding.
  for (auto& triangle : mesh.triangles)
  {
    for (Id& corner : triangle)
    {
      corner = corner >= around * (across + 1) ? corner - around * (across + 1) : corner;
    }
  }
  return mesh;
}

} // namespace

TEST_P(Hodge, FindsGradientsAndRotationsOnASphere)
{
  const TriangleMesh mesh = GeodesicSphere(32, 2.0);
  const HodgeDecomposition slope = Decompose(mesh, AtPoints(mesh, SlopeOnSphere), GetParam(), 5);
  ExpectParts(mesh, slope, SlopeOnSphere, Zero, Zero, 0.03);
  ExpectOrthogonal(mesh, slope, this->Orthogonality());
  const HodgeDecomposition turned = Decompose(mesh, AtPoints(mesh, TurnedOnSphere), GetParam(), 5);
  ExpectParts(mesh, turned, Zero, TurnedOnSphere, Zero, 0.03);
  ExpectOrthogonal(mesh, turned, this->Orthogonality());
  for (Id i = 0; i < static_cast<Id>(mesh.points.size()); ++i)
  {
    const Vec3& p = mesh.points[i];
    ASSERT_NEAR(slope.potentialAtPoints(i, 0), p[0] * p[1], 0.02);
    ASSERT_NEAR(turned.streamAtPoints(i, 0), p[0] * p[1], 0.02);
    ASSERT_LT((turned.rotationAtPoints.row(i).transpose() - TurnedOnSphere(p)).norm(), 0.1);
    ASSERT_LT(turned.restAtPoints.row(i).norm(), 0.05);
  }
}

TEST_P(Hodge, LeavesTheTwoHarmonicFieldsOfATorus)
{
  const TriangleMesh mesh = Torus(96, 48, 1.0, 0.4);
  const VectorField around = AroundAxis;
  const VectorField through = [](const Vec3& p)
  { return Vec3(TorusNormal(p).cross(AroundAxis(p))); };
  const VectorField slope = [](const Vec3& p)
  { return Vec3(Vec3::UnitX() - TorusNormal(p)[0] * TorusNormal(p)); };
  const VectorField turned = [](const Vec3& p)
  { return Vec3(TorusNormal(p).cross(Vec3::UnitZ())); };
  const Field v = AtPoints(mesh, 2.0 * slope + turned + 0.5 * around + 0.7 * through);
  const HodgeDecomposition parts = Decompose(mesh, v, GetParam(), 5);
  ExpectParts(mesh, parts, 2.0 * slope, turned, 0.5 * around + 0.7 * through, 0.05);
  ExpectOrthogonal(mesh, parts, this->Orthogonality());
}

/// On a ring, the flow through it is a gradient, and the flow around the hole is harmonic. An eddy
/// that is 0 at the boundary is a rotation.
TEST_P(Hodge, KeepsWhatGoesAroundAHole)
{
  const TriangleMesh mesh = Ring(120, 24);
  const auto radius = [](const Vec3& p) { return p.norm(); };
  const VectorField outwards = [&](const Vec3& p) { return Vec3(p / p.squaredNorm()); };
  const VectorField eddy = [&](const Vec3& p) // of sin(π (r - 1)) with n = (0, 0, -1) or (0, 0, 1)
  { return Vec3(M_PI * std::cos(M_PI * (radius(p) - 1.0)) * Vec3(-p[1], p[0], 0.0) / radius(p)); };
  const Field v = AtPoints(mesh, outwards + 2.0 * VectorField(AroundAxis) + eddy);
  const HodgeDecomposition parts = Decompose(mesh, v, GetParam(), 6);
  ExpectParts(mesh, parts, outwards, eddy, 2.0 * VectorField(AroundAxis), 0.04);
  ExpectOrthogonal(mesh, parts, this->Orthogonality());
  for (const Id point : EndsOf(FindSurfaceEdges(mesh, true).boundary, mesh))
  {
    ASSERT_NEAR(parts.streamAtPoints(point, 0), 0.0, 1e-3);
  }
}

/// The parts are right although triangles have different orientations and points are not shared.
TEST_P(Hodge, DoesNotDependOnTheOrientationOfTriangles)
{
  TriangleMesh mesh = GeodesicSphere(24);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
  {
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  }
  const VectorField v = VectorField(SlopeOnSphere) + 2.0 * VectorField(TurnedOnSphere);
  for (const TriangleMesh& own : { mesh, Unweld(mesh) })
  {
    const HodgeDecomposition parts = Decompose(own, AtPoints(own, v), GetParam(), 4);
    EXPECT_EQ(parts.numberOfOneSided, 0);
    ExpectParts(own, parts, SlopeOnSphere, 2.0 * VectorField(TurnedOnSphere), Zero, 0.05);
    ExpectOrthogonal(own, parts, 2 * this->Orthogonality());
  }
}

/// Three sheets that meet in an edge. Each is a component of its own, held at the edge.
TEST_P(Hodge, IsOrthogonalWhereSheetsBranch)
{
  const TriangleMesh sheet = FlatRectangle(48, 48);
  TriangleMesh mesh = sheet;
  for (const double angle : { 2.0, 4.0 })
  {
    mesh = Join(mesh, Transform(sheet, { 0, 1, 0 }, angle));
  }
  const Field v =
    AtPoints(mesh, [](const Vec3& p) { return Vec3(p[1] * p[1], p[2] - 3.0 * p[0] * p[1], p[1]); });
  const HodgeDecomposition parts = Decompose(mesh, v, GetParam(), 5);
  EXPECT_GT(Norm(mesh, parts.rotationOnTriangles), 0.1);
  ExpectOrthogonal(mesh, parts, this->Orthogonality());
}

TEST_P(Hodge, AddsUpToTheFieldAndDoesNotDependOnThreads)
{
  const TriangleMesh mesh = Torus(30, 20, 1.0, 0.4);
  const Field v{ FieldAssociation::Triangles,
    RandomValues(static_cast<Id>(mesh.triangles.size()), 3) };
  const auto decompose = [&](int threads)
  {
    return DecomposeField(
      *Build(mesh, GetParam(), 4, threads), mesh, v, Options(threads), Job(threads));
  };
  const HodgeDecomposition parts = decompose(1);
  for (Id t = 0; t < v.values.rows(); ++t)
  {
    const Vec3 normal = AreaVector(mesh.points, mesh.triangles[t]).normalized();
    const Vec3 given = v.values.row(t).transpose();
    const Vec3 sum = (parts.gradientOnTriangles.row(t) + parts.rotationOnTriangles.row(t) +
                      parts.restOnTriangles.row(t))
                       .transpose();
    ASSERT_LT((sum - (given - normal.dot(given) * normal)).norm(), 1e-12);
  }
  const HodgeDecomposition other = decompose(3);
  EXPECT_EQ(parts.restOnTriangles, other.restOnTriangles);
  EXPECT_EQ(parts.rotationAtPoints, other.rotationAtPoints);
  const Job stop(0, Progress([](double done) { return done < 0.5; }));
  EXPECT_THROW(DecomposeField(*Build(mesh, GetParam(), 4), mesh, v, Options(), stop), Aborted);
  EXPECT_THROW(DecomposeField(*Build(mesh, GetParam(), 4), mesh,
                 { FieldAssociation::Triangles, v.values.leftCols(2) }, Options()),
    InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, Hodge, ::testing::Bool());
