// Compares right-hand sides for hat functions with matrices and with quadrature.
#include "Spaces/HatLoad.h"

#include "Integrals/QuadratureRule.h"
#include "Spaces.h"
#include "Spaces/HatMatrices.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Unit = 0.125; // a power of two, so that rounding does not depend on it

struct Hats
{
  explicit Hats(const TriangleMesh& inputMesh) : mesh(inputMesh)
  {
    HatOptions options;
    options.unitLength = Unit;
    functions = NumberHatFunctions(mesh, options);
    matrices = AssembleHatMatrices(mesh, functions);
  }

  /// Returns the coefficients of a function given at points.
  MultiVector Coefficients(const MultiVector& onPoints) const
  {
    MultiVector result = MultiVector::Zero(functions.Count(), onPoints.cols());
    for (std::size_t point = 0; point < functions.ofPoint.size(); ++point)
    {
      if (functions.ofPoint[point] >= 0)
      {
        result.row(functions.ofPoint[point]) = onPoints.row(static_cast<Id>(point));
      }
    }
    return result;
  }

  TriangleMesh mesh;
  HatFunctions functions;
  HatMatrices matrices;
};

std::vector<TriangleMesh> Meshes()
{
  return { Transform(GeodesicSphere(4), { 1, 2, 0 }, 0.5, 3.0, { 1, 0, 5 }), FlatRectangle(4, 3),
    Torus(20, 9, 1.0, 0.4), TwoSheets(3, 0.1) };
}

/// Returns the value of a field at barycentric coordinates of a triangle.
Eigen::RowVectorXd ValueAt(
  const Field& field, const TriangleMesh& mesh, Id triangle, const std::array<double, 3>& lambda)
{
  const std::array<Id, 3> row = field.RowsOf(triangle, mesh.triangles[triangle]);
  return lambda[0] * field.values.row(row[0]) + lambda[1] * field.values.row(row[1]) +
         lambda[2] * field.values.row(row[2]);
}

/// Returns ∫ scale <s, ∇φ_i> in world units, with a rule that is exact for the product.
Eigen::MatrixXd GradientsByQuadrature(const Hats& hats, const Field& s, const Field& scale)
{
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(hats.functions.Count(), s.values.cols() / 3);
  for (Id t = 0; t < static_cast<Id>(hats.mesh.triangles.size()); ++t)
  {
    const auto& corner = hats.mesh.triangles[t];
    const Vec3 p[3] = { hats.mesh.points[corner[0]], hats.mesh.points[corner[1]],
      hats.mesh.points[corner[2]] };
    const Vec3 areaVector = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
    for (const QuadratureRule::Point& point : TriangleRule(4).points)
    {
      const double weight =
        point.weight * areaVector.norm() * ValueAt(scale, hats.mesh, t, point.barycentric)[0];
      const Eigen::RowVectorXd vectors = ValueAt(s, hats.mesh, t, point.barycentric);
      for (int k = 0; k < 3; ++k)
      {
        const Vec3 gradient =
          areaVector.cross(p[(k + 2) % 3] - p[(k + 1) % 3]) / (2.0 * areaVector.squaredNorm());
        for (Id c = 0; c < result.cols(); ++c)
        {
          const Vec3 vector(vectors[3 * c], vectors[3 * c + 1], vectors[3 * c + 2]);
          result(hats.functions.ofPoint[corner[k]], c) += weight * gradient.dot(vector);
        }
      }
    }
  }
  return result;
}

} // namespace

TEST(HatLoad, OfValuesAtPointsIsTheMassTimesThem)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const Hats hats(mesh);
    const MultiVector f = RandomValues(static_cast<Id>(mesh.points.size()), 5);
    MultiVector expected;
    Multiply(hats.matrices.mass, hats.Coefficients(f), expected);
    EXPECT_LT(RelativeDifference(
                IntegrateValues(hats.functions, mesh, { FieldAssociation::Points, f }), expected),
      1e-14);
  }
}

TEST(HatLoad, OfValuesOnTrianglesIsAThirdOfTheirIntegrals)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const Hats hats(mesh);
    const MultiVector f = RandomValues(static_cast<Id>(mesh.triangles.size()), 2);
    MultiVector expected = MultiVector::Zero(hats.functions.Count(), 2);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      TriangleMesh alone;
      alone.points = mesh.points;
      alone.triangles = { mesh.triangles[t] };
      for (const Id corner : mesh.triangles[t])
      {
        expected.row(hats.functions.ofPoint[corner]) +=
          SurfaceArea(alone) / (3.0 * Unit * Unit) * f.row(static_cast<Id>(t));
      }
    }
    EXPECT_LT(
      RelativeDifference(
        IntegrateValues(hats.functions, mesh, { FieldAssociation::Triangles, f }), expected),
      1e-13);
  }
}

TEST(HatLoad, OfValuesThatDifferAtCoincidentPointsTakesEveryTrianglesOwn)
{
  const TriangleMesh soup = Unweld(GeodesicSphere(3));
  const Hats hats(soup);
  // A field that is constant on each triangle: given on triangles, and at the three points of each
  // triangle of a soup.
  const MultiVector f = RandomValues(static_cast<Id>(soup.triangles.size()), 1);
  MultiVector onPoints(static_cast<Id>(soup.points.size()), 1);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
  {
    for (const Id corner : soup.triangles[t])
    {
      onPoints.row(corner) = f.row(static_cast<Id>(t));
    }
  }
  EXPECT_LT(RelativeDifference(
              IntegrateValues(hats.functions, soup, { FieldAssociation::Points, onPoints }),
              IntegrateValues(hats.functions, soup, { FieldAssociation::Triangles, f })),
    1e-14);
}

TEST(HatLoad, OfTheGradientOfAFunctionIsTheStiffnessTimesIt)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const Hats hats(mesh);
    const MultiVector f = RandomValues(static_cast<Id>(mesh.points.size()), 3);
    MultiVector expected;
    Multiply(hats.matrices.stiffness, hats.Coefficients(f), expected);
    const Field field{ FieldAssociation::Points, f };
    EXPECT_LT(
      RelativeDifference(IntegrateGradientsOf(hats.functions, mesh, field, nullptr), expected),
      1e-13);
    // A factor that is linear on a triangle counts with its mean there.
    Field twoOnPoints{ FieldAssociation::Points,
      MultiVector::Constant(static_cast<Id>(mesh.points.size()), 1, 2.0) };
    EXPECT_LT(RelativeDifference(
                IntegrateGradientsOf(hats.functions, mesh, field, &twoOnPoints), 2.0 * expected),
      1e-13);
  }
}

TEST(HatLoad, OfVectorsIsExact)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const Hats hats(mesh);
    for (const auto association : { FieldAssociation::Points, FieldAssociation::Triangles })
    {
      for (const auto scaleAssociation : { FieldAssociation::Points, FieldAssociation::Triangles })
      {
        const auto rows = [&](FieldAssociation a)
        {
          return static_cast<Id>(
            a == FieldAssociation::Points ? mesh.points.size() : mesh.triangles.size());
        };
        const Field s{ association, RandomValues(rows(association), 6) };
        const Field scale{ scaleAssociation, RandomValues(rows(scaleAssociation), 1, 7) };
        EXPECT_LT(RelativeDifference(IntegrateGradients(hats.functions, mesh, s, &scale),
                    GradientsByQuadrature(hats, s, scale)),
          1e-12);
      }
    }
  }
}

TEST(HatLoad, DoesNotDependOnThreads)
{
  const Hats hats(GeodesicSphere(60)); // several blocks
  const Field f{ FieldAssociation::Points,
    RandomValues(static_cast<Id>(hats.mesh.points.size()), 3) };
  EXPECT_EQ(IntegrateValues(hats.functions, hats.mesh, f, 1),
    IntegrateValues(hats.functions, hats.mesh, f, 3));
  EXPECT_EQ(IntegrateGradients(hats.functions, hats.mesh, f, nullptr, 1),
    IntegrateGradients(hats.functions, hats.mesh, f, nullptr, 3));
}

TEST(HatLoad, RefusesFieldsThatDoNotFit)
{
  const Hats hats(GeodesicSphere(2));
  const auto points = static_cast<Id>(hats.mesh.points.size());
  const Field shortOne{ FieldAssociation::Points, MultiVector::Zero(points - 1, 3) };
  const Field pairs{ FieldAssociation::Points, MultiVector::Zero(points, 2) };
  const Field onTriangles{ FieldAssociation::Triangles,
    MultiVector::Zero(static_cast<Id>(hats.mesh.triangles.size()), 3) };
  const Field vectors{ FieldAssociation::Points, MultiVector::Zero(points, 3) };
  EXPECT_THROW(IntegrateValues(hats.functions, hats.mesh, shortOne), InvalidInput);
  EXPECT_THROW(IntegrateGradients(hats.functions, hats.mesh, pairs, nullptr), InvalidInput);
  EXPECT_THROW(IntegrateGradients(hats.functions, hats.mesh, vectors, &pairs), InvalidInput);
  EXPECT_THROW(IntegrateGradientsOf(hats.functions, hats.mesh, onTriangles, nullptr), InvalidInput);
  EXPECT_THROW(IntegrateValues(hats.functions, GeodesicSphere(3), vectors), InvalidInput);
}
