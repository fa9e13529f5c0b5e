// Tests that right-hand sides are consistent with matrices of the same samples, for every way to
// give a field.
#include "Integrals/LoadVector.h"

#include "Integrals/Assembly.h"
#include "Spaces.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A space with everything that load vectors are compared with.
class LoadsOnSpaces : public ::testing::TestWithParam<SpaceCase>
{
protected:
  /// Returns a M + b L times coefficients.
  MultiVector Apply(double a, double b, const MultiVector& coefficients) const
  {
    const ElementMatrices elements = IntegrateElements(space, rule);
    const FunctionPlaces places = PlacesOfFunctions(space.Finest());
    SparseMatrix A = BuildPattern(space.Finest(), places);
    AssembleValues(space.Finest(), places, elements.mass, a, elements.stiffness, b, A);
    MultiVector result;
    Multiply(A, coefficients, result);
    return result;
  }

  MultiVector Ones(Id columns) const
  {
    return MultiVector::Ones(space.Finest().numberOfFunctions, columns);
  }

  Field RandomOnPoints(Id columns, unsigned seed = 1) const
  {
    // Coincident points have the same value, so the field is a function on the surface.
    const MultiVector table = RandomValues(997, columns, seed);
    Field field{ FieldAssociation::Points, MultiVector(mesh.points.size(), columns) };
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      const double key = std::abs(mesh.points[i].dot(Vec3(7919.0, 104729.0, 1299709.0)));
      field.values.row(i) = table.row(static_cast<Id>(std::fmod(key, 997.0)));
    }
    return field;
  }

  const TriangleMesh& mesh = GetParam().mesh;
  GridFunctions space = GetParam().Build();
  const QuadratureRule& rule = TriangleRule(2);
  /// Rounding of world coordinates, measured in cells.
  double rounding =
    1e-14 * (1.0 + CoordinateCoefficients(space).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() /
                     space.GetGrid().spacing);
};

/// Returns ∇f of a field that is linear on triangles, computed from world coordinates.
MultiVector TriangleGradients(const TriangleMesh& mesh, const MultiVector& f)
{
  MultiVector gradients = MultiVector::Zero(mesh.triangles.size(), 3 * f.cols());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& [a, b, c] = mesh.triangles[t];
    Eigen::Matrix<double, 3, 2> edges;
    edges << mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a];
    const Eigen::Matrix2d gram = edges.transpose() * edges;
    for (Id column = 0; column < f.cols(); ++column)
    {
      const Eigen::Vector2d difference(f(b, column) - f(a, column), f(c, column) - f(a, column));
      gradients.block<1, 3>(t, 3 * column) = (edges * gram.inverse() * difference).transpose();
    }
  }
  return gradients;
}

} // namespace

TEST_P(LoadsOnSpaces, OfConstantsAreTheIntegralsOfTheFunctions)
{
  const MultiVector expected = 2.5 * Apply(1.0, 0.0, Ones(1));
  const Field onPoints{ FieldAssociation::Points,
    MultiVector::Constant(mesh.points.size(), 1, 2.5) };
  const Field onTriangles{ FieldAssociation::Triangles,
    MultiVector::Constant(mesh.triangles.size(), 1, 2.5) };
  EXPECT_LT(RelativeDifference(IntegrateValues(space, mesh, onPoints, rule), expected), 1e-13);
  EXPECT_LT(RelativeDifference(IntegrateValues(space, mesh, onTriangles, rule), expected), 1e-13);
}

TEST_P(LoadsOnSpaces, OfCoordinatesAreTheMassMatrixTimesTheirCoefficients)
{
  const Field f{ FieldAssociation::Points, PointCoordinates(mesh) };
  EXPECT_LT(RelativeDifference(IntegrateValues(space, mesh, f, rule),
              Apply(1.0, 0.0, CoordinateCoefficients(space))),
    rounding);
}

TEST_P(LoadsOnSpaces, OfTheGradientsOfCoordinatesAreTheStiffnessTimesTheirCoefficients)
{
  // The stiffness may give normal derivatives a weight of 1e-12 (relative to its largest entries).
  const double tolerance = 10.0 * rounding + 1e-11;
  const MultiVector expected = Apply(0.0, 1.0, CoordinateCoefficients(space));
  const Field f{ FieldAssociation::Points, PointCoordinates(mesh) };
  EXPECT_LT(
    RelativeDifference(IntegrateGradientsOf(space, mesh, f, nullptr, rule), expected), tolerance);

  // The gradients as vector fields: three constant unit vectors, on points and on triangles.
  const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
  const Eigen::Map<const Eigen::Matrix<double, 1, 9>> row(unit.data());
  for (const auto association : { FieldAssociation::Points, FieldAssociation::Triangles })
  {
    const std::size_t rows =
      association == FieldAssociation::Points ? mesh.points.size() : mesh.triangles.size();
    const Field s{ association, row.replicate(rows, 1) };
    EXPECT_LT(
      RelativeDifference(IntegrateGradients(space, mesh, s, nullptr, rule), expected), tolerance);
  }
}

TEST_P(LoadsOnSpaces, OfAnyGradientAreThoseOfTheVectorFieldItIs)
{
  const Field f = RandomOnPoints(2);
  const Field s{ FieldAssociation::Triangles, TriangleGradients(mesh, f.values) };
  const MultiVector a = IntegrateGradientsOf(space, mesh, f, nullptr, rule);
  const MultiVector b = IntegrateGradients(space, mesh, s, nullptr, rule);
  EXPECT_LT(RelativeDifference(a, b), 10.0 * rounding);
  // Integrals of gradients against constants vanish.
  EXPECT_LT(
    a.colwise().sum().cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-12 * a.cwiseAbs().sum());
}

TEST_P(LoadsOnSpaces, IgnoreThePartOfAVectorFieldAlongTheNormal)
{
  const Field s{ FieldAssociation::Triangles, RandomValues(mesh.triangles.size(), 3) };
  Field tilted = s;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 normal =
      (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
    SetRow(tilted.values, static_cast<Id>(t), s.values.row(t).transpose() + 5.0 * normal);
  }
  EXPECT_LT(RelativeDifference(IntegrateGradients(space, mesh, tilted, nullptr, rule),
              IntegrateGradients(space, mesh, s, nullptr, rule)),
    50.0 * rounding);
}

TEST_P(LoadsOnSpaces, TakeAScaleOnPointsAndOnTriangles)
{
  const Field f = RandomOnPoints(1);
  const MultiVector plain = IntegrateGradientsOf(space, mesh, f, nullptr, rule);
  const Field three{ FieldAssociation::Points, MultiVector::Constant(mesh.points.size(), 1, 3.0) };
  EXPECT_LT(
    RelativeDifference(IntegrateGradientsOf(space, mesh, f, &three, rule), 3.0 * plain), 1e-13);

  // A scale on triangles has the same effect as scaling the field there.
  const Field s{ FieldAssociation::Triangles, TriangleGradients(mesh, f.values) };
  const Field scale{ FieldAssociation::Triangles, RandomValues(mesh.triangles.size(), 1, 3) };
  const Field scaled{ FieldAssociation::Triangles, scale.values.col(0).asDiagonal() * s.values };
  EXPECT_LT(RelativeDifference(IntegrateGradients(space, mesh, s, &scale, rule),
              IntegrateGradients(space, mesh, scaled, nullptr, rule)),
    1e-13);
  EXPECT_LT(RelativeDifference(IntegrateGradientsOf(space, mesh, f, &scale, rule),
              IntegrateGradients(space, mesh, scaled, nullptr, rule)),
    10.0 * rounding);
}

TEST_P(LoadsOnSpaces, OfAScaleOnPointsAreThoseOfTheScaledField)
{
  // σ times a constant vector is linear on triangles if σ is.
  const Field scale = RandomOnPoints(1);
  const Field constant{ FieldAssociation::Points,
    Eigen::RowVector3d(1, -2, 3).replicate(mesh.points.size(), 1) };
  const Field scaled{ FieldAssociation::Points,
    scale.values.col(0).asDiagonal() * constant.values };
  EXPECT_LT(RelativeDifference(IntegrateGradients(space, mesh, constant, &scale, rule),
              IntegrateGradients(space, mesh, scaled, nullptr, rule)),
    1e-12);
}

TEST_P(LoadsOnSpaces, TakeAnyNumberOfColumns)
{
  const Field f = RandomOnPoints(11);
  const MultiVector all = IntegrateValues(space, mesh, f, rule);
  ASSERT_EQ(all.cols(), 11);
  for (Id c = 0; c < 11; ++c)
  {
    const Field single{ f.association, f.values.col(c) };
    EXPECT_LT(RelativeDifference(all.col(c), IntegrateValues(space, mesh, single, rule)), 1e-14);
  }
  EXPECT_EQ(IntegrateValues(space, mesh, { f.association, f.values.leftCols(0) }, rule).cols(), 0);
}

TEST_P(LoadsOnSpaces, FindCutPointsByPositionWhereTheirOriginIsNotKnown)
{
  GridFunctions restored = space;
  restored.clipped.cutPoints.clear();
  const Field f = RandomOnPoints(1);
  const MultiVector expected = IntegrateValues(space, mesh, f, rule);
  EXPECT_LT(RelativeDifference(IntegrateValues(restored, mesh, f, rule), expected), 1e-11);
}

TEST_P(LoadsOnSpaces, DoNotDependOnSubdivisionInThePlane)
{
  // Coordinates times a function have degree 4, which the rule of degree 6 integrates exactly.
  SpaceCase subdivided = GetParam();
  subdivided.mesh = SubdivideInPlane(subdivided.mesh);
  const GridFunctions fine = subdivided.Build();
  const Field a{ FieldAssociation::Points, PointCoordinates(mesh) };
  const Field b{ FieldAssociation::Points, PointCoordinates(subdivided.mesh) };
  EXPECT_LT(RelativeDifference(IntegrateValues(fine, subdivided.mesh, b, TriangleRule(6)),
              IntegrateValues(space, mesh, a, TriangleRule(6))),
    1e-11);
}

TEST_P(LoadsOnSpaces, AreTheSameBitsForAnyNumberOfThreads)
{
  const Field f = RandomOnPoints(3);
  EXPECT_EQ(IntegrateValues(space, mesh, f, rule, 1), IntegrateValues(space, mesh, f, rule, 2));
  EXPECT_EQ(IntegrateGradients(space, mesh, f, nullptr, rule, 1),
    IntegrateGradients(space, mesh, f, nullptr, rule, 2));
  EXPECT_EQ(IntegrateGradientsOf(space, mesh, f, nullptr, rule, 1),
    IntegrateGradientsOf(space, mesh, f, nullptr, rule, 2));
}

INSTANTIATE_TEST_SUITE_P(Spaces, LoadsOnSpaces, ::testing::ValuesIn(AllSpaces()));

TEST(LoadVector, OfTrianglesWithoutAreaIsFinite)
{
  TriangleMesh mesh = FlatRectangle(3, 3);
  mesh.triangles.push_back({ 0, 1, 1 });
  mesh.triangles.push_back({ 0, 1, 2 });
  const GridFunctions space = BuildGridFunctions(mesh, {});
  const Field f{ FieldAssociation::Points, RandomValues(mesh.points.size(), 3) };
  const QuadratureRule& rule = TriangleRule(2);
  EXPECT_TRUE(IntegrateValues(space, mesh, f, rule).allFinite());
  EXPECT_TRUE(IntegrateGradientsOf(space, mesh, f, nullptr, rule).allFinite());
  EXPECT_TRUE(IntegrateGradients(space, mesh, f, nullptr, rule).allFinite());
}

TEST(LoadVector, RefusesFieldsThatDoNotFit)
{
  const TriangleMesh mesh = Box(2);
  const GridFunctions space = BuildGridFunctions(mesh, {});
  const QuadratureRule& rule = TriangleRule(2);
  const Field fitting{ FieldAssociation::Points, MultiVector::Zero(mesh.points.size(), 4) };
  const Field rows{ FieldAssociation::Triangles, MultiVector::Zero(mesh.points.size() + 1, 3) };
  const Field onTriangles{ FieldAssociation::Triangles,
    MultiVector::Zero(mesh.triangles.size(), 1) };
  EXPECT_THROW(IntegrateValues(space, mesh, rows, rule), InvalidInput);
  EXPECT_THROW(IntegrateValues(space, Box(3), fitting, rule), InvalidInput);
  EXPECT_THROW(IntegrateGradients(space, mesh, fitting, nullptr, rule), InvalidInput);
  EXPECT_THROW(IntegrateGradientsOf(space, mesh, fitting, &fitting, rule), InvalidInput);
  EXPECT_THROW(IntegrateGradientsOf(space, mesh, onTriangles, nullptr, rule), InvalidInput);
}

TEST(LoadVector, StopsWhenAskedTo)
{
  const TriangleMesh mesh = Box(8);
  const GridFunctions space = BuildGridFunctions(mesh, {});
  const Field f{ FieldAssociation::Points, PointCoordinates(mesh) };
  const Progress stop([](double) { return false; });
  EXPECT_THROW(IntegrateValues(space, mesh, f, TriangleRule(2), { 2, stop }), Aborted);
}
