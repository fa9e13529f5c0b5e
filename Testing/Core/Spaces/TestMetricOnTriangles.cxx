// Compares a metric given by tensors with a mesh moved so that it has this metric, on grids and on
// hats.
#include "Integrals/TriangleMetric.h"

#include "Base/Errors.h"
#include "Spaces.h"
#include "Spaces/HatLoad.h"
#include "Spaces/HatSpace.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A map that stretches, shears and turns. It is far from the identity in every plane.
Eigen::Matrix3d SomeMap()
{
  Eigen::Matrix3d map;
  map << 1.5, 0.4, -0.2, //
    -0.3, 0.8, 0.1,      //
    0.2, -0.5, 2.0;
  return map;
}

/// Returns a mesh bent by a map that is not affine: every triangle gets a metric of its own.
TriangleMesh Bent(const TriangleMesh& mesh)
{
  return Mapped(mesh,
    [](const Vec3& p) -> Vec3
    { return p + Vec3(0.3 * p[1] * p[2], 0.2 * std::sin(3.0 * p[0]), -0.25 * p[0] * p[1]); });
}

std::vector<double> Six(const Eigen::Matrix3d& g)
{
  return { g(0, 0), g(1, 1), g(2, 2), g(0, 1), g(1, 2), g(0, 2) };
}

Field TensorsOf(Id rows, FieldAssociation association, const Eigen::Matrix3d& g)
{
  Field field{ association, MultiVector(rows, 6) };
  const std::vector<double> six = Six(g);
  for (Id row = 0; row < rows; ++row)
  {
    field.values.row(row) = Eigen::Map<const Eigen::RowVectorXd>(six.data(), 6);
  }
  return field;
}

/// Returns JᵀJ of the linear map on each triangle, with arbitrary entries across the plane.
Field TensorsOfMove(const TriangleMesh& mesh, const TriangleMesh& moved)
{
  Field field = TensorsOf(
    static_cast<Id>(mesh.triangles.size()), FieldAssociation::Triangles, Eigen::Matrix3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto frame = [&](const TriangleMesh& from)
    {
      const auto& corner = from.triangles[t];
      const Vec3 a = from.points[corner[1]] - from.points[corner[0]];
      const Vec3 b = from.points[corner[2]] - from.points[corner[0]];
      Eigen::Matrix3d columns;
      columns << a, b, a.cross(b).normalized() * 0.7;
      return columns;
    };
    const Eigen::Matrix3d map = frame(moved) * frame(mesh).inverse();
    const std::vector<double> six = Six(map.transpose() * map);
    field.values.row(static_cast<Id>(t)) = Eigen::Map<const Eigen::RowVectorXd>(six.data(), 6);
  }
  return field;
}

std::shared_ptr<const TriangleMetric> Metric(const TriangleMesh& mesh, const Field& tensors)
{
  return std::make_shared<const TriangleMetric>(MetricOfTensors(mesh, tensors));
}

std::vector<TriangleMesh> Meshes()
{
  return { Transform(GeodesicSphere(8), { 1, 2, 3 }, 0.4), Torus(24, 12, 1.0, 0.3),
    Transform(TwoSheets(6, 0.01), { 1, 0.3, 0 }, 0.4), Join(Box(4), GeodesicSphere(4, 0.1)) };
}

HatSpace Build(const TriangleMesh& mesh)
{
  GridSpaceOptions options;
  options.functions.depth = 4;
  options.coarsestSize = 32;
  return BuildHatSpace(mesh, options);
}

Eigen::MatrixXd DenseOf(const FiniteElementSpace& space, double a, double b)
{
  return Dense(space.Matrix(0, a, b));
}

Field OnPoints(const MultiVector& values)
{
  return { FieldAssociation::Points, values };
}

TEST(MetricOnTriangles, OfAnAffineMapIsThatOfTheEmbeddingOnAGrid)
{
  const Eigen::Matrix3d map = SomeMap();
  for (const TriangleMesh& mesh : Meshes())
  {
    const HatSpace hats = Build(mesh);
    const auto moved = hats.Grid().Copy();
    const MultiVector turned = map.transpose();
    moved->SetMetric(moved->EmbeddingOfMesh() * turned);
    for (const FieldAssociation where : { FieldAssociation::Points, FieldAssociation::Triangles })
    {
      const std::size_t rows =
        where == FieldAssociation::Points ? mesh.points.size() : mesh.triangles.size();
      const auto given = hats.Grid().Copy();
      given->SetMetricOnTriangles(
        Metric(mesh, TensorsOf(static_cast<Id>(rows), where, map.transpose() * map)));
      EXPECT_LT(RelativeDifference(DenseOf(*given, 1, 0), DenseOf(*moved, 1, 0)), 1e-12);
      EXPECT_LT(RelativeDifference(DenseOf(*given, 0, 1), DenseOf(*moved, 0, 1)), 1e-9);
      EXPECT_LT(RelativeDifference(Dense(given->Matrix(1, 1, 1)), Dense(moved->Matrix(1, 1, 1))),
        1e-9); // coarser levels follow
    }
  }
}

TEST(MetricOnTriangles, OfAnyMoveIsThatOfTheMovedMeshOnBothSpaces)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const TriangleMesh moved = Bent(mesh);
    const auto metric = Metric(mesh, TensorsOfMove(mesh, moved));
    HatSpace hats = Build(mesh);
    GridSpace grid = hats.Grid();
    grid.SetMetricOfMesh(moved);
    hats.SetMetricOnTriangles(metric);
    EXPECT_LT(RelativeDifference(DenseOf(hats.Grid(), 1, 0), DenseOf(grid, 1, 0)), 1e-11);
    EXPECT_LT(RelativeDifference(DenseOf(hats.Grid(), 0, 1), DenseOf(grid, 0, 1)), 1e-9);
    const HatMatrices expected = AssembleHatMatrices(moved, hats.Hats().functions);
    EXPECT_LT(RelativeDifference(DenseOf(hats, 1, 0), Dense(expected.mass)), 1e-12);
    EXPECT_LT(RelativeDifference(DenseOf(hats, 0, 1), Dense(expected.stiffness)), 1e-10);
    EXPECT_NEAR(metric->AreaOf(mesh), SurfaceArea(moved), 1e-12 * SurfaceArea(moved));
  }
}

TEST(MetricOnTriangles, IsInTheLoadsOfHatsAsOnTheMovedMesh)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const TriangleMesh moved = Bent(mesh);
    HatSpace hats = Build(mesh);
    hats.SetMetricOnTriangles(Metric(mesh, TensorsOfMove(mesh, moved)));
    const HatFunctions& functions = hats.Hats().functions;
    const Field f = OnPoints(RandomValues(static_cast<Id>(mesh.points.size()), 2));
    const Field scale = OnPoints(RandomValues(static_cast<Id>(mesh.points.size()), 1));
    const std::vector<double> weight(mesh.triangles.size(), 0.3);
    EXPECT_LT(
      RelativeDifference(hats.LoadOfValues(f), IntegrateValues(functions, moved, f)), 1e-11);
    EXPECT_LT(RelativeDifference(hats.LoadOfWeightedValues(f, weight),
                IntegrateValues(functions, moved, f, 0, &weight)),
      1e-11);
    EXPECT_LT(RelativeDifference(hats.LoadOfGradientsOf(f, &scale),
                IntegrateGradientsOf(functions, moved, f, &scale)),
      1e-10);
  }
}

/// Requires that matrices times coefficients equal the loads of the same functions.
void ExpectLoadsOfItsMatrices(
  const FiniteElementSpace& space, const TriangleMesh& mesh, const MultiVector& coordinates)
{
  const MultiVector world = PointCoordinates(mesh);
  const double unit = space.UnitLength();
  const Eigen::MatrixXd mass = DenseOf(space, 1, 0);
  const Eigen::MatrixXd stiffness = DenseOf(space, 0, 1);
  EXPECT_LT(
    RelativeDifference(space.LoadOfValues(OnPoints(world / unit)), mass * coordinates), 1e-9);
  const MultiVector expected = stiffness * coordinates * unit;
  EXPECT_LT(RelativeDifference(space.LoadOfGradientsOf(OnPoints(world), nullptr), expected), 1e-9);
  EXPECT_LT(RelativeDifference(space.LoadOfGradientsOfCoordinates(nullptr), expected), 1e-9);
  // The gradients of x, y and z at points and on triangles: three vectors side by side.
  MultiVector unitVectors(world.rows(), 9);
  for (Id row = 0; row < world.rows(); ++row)
  {
    unitVectors.row(row) << 1, 0, 0, 0, 1, 0, 0, 0, 1;
  }
  EXPECT_LT(
    RelativeDifference(space.LoadOfGradients(OnPoints(unitVectors), nullptr), expected), 1e-9);
  EXPECT_LT(RelativeDifference(
              space.LoadOfGradients(GradientsOf(mesh, OnPoints(world)), nullptr), expected),
    1e-9);
  const MultiVector u = RandomValues(space.NumberOfFunctions(0), 2);
  EXPECT_LT(RelativeDifference(space.StiffnessTimes(u, {}), stiffness * u), 1e-12);
  const Columns squares = space.SquaredNorms(u);
  EXPECT_NEAR(squares[0], u.col(0).dot(mass * u.col(0)), 1e-10 * squares[0]);
}

TEST(MetricOnTriangles, IsInAllLoadsAsInTheMatrices)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const HatSpace hats = Build(mesh);
    const auto metric = Metric(mesh, TensorsOfMove(mesh, Bent(mesh)));
    for (const FiniteElementSpace* space : { static_cast<const FiniteElementSpace*>(&hats),
           static_cast<const FiniteElementSpace*>(&hats.Grid()) })
    {
      const auto own = space->Copy();
      own->SetMetricOnTriangles(metric);
      MultiVector coordinates = own->EmbeddingOfMesh();
      const Vec3 origin = own->Origin() / own->UnitLength();
      for (Id i = 0; i < coordinates.rows(); ++i)
      {
        SetRow(coordinates, i, coordinates.row(i).transpose() + origin);
      }
      ExpectLoadsOfItsMatrices(*own, mesh, coordinates);

      const std::vector<double> weight(mesh.triangles.size(), 0.25);
      const auto weighted = own->Copy();
      weighted->WeighMass(weight);
      EXPECT_LT(RelativeDifference(DenseOf(*weighted, 4, 1), DenseOf(*own, 1, 1)), 1e-11);
      const MultiVector u = RandomValues(own->NumberOfFunctions(0), 1);
      EXPECT_LT(
        RelativeDifference(weighted->StiffnessTimes(u, {}), own->StiffnessTimes(u, {})), 1e-11);
      own->SetMetric(own->EmbeddingOfMesh()); // ends the metric on triangles
      EXPECT_LT(RelativeDifference(DenseOf(*own, 1, 1), DenseOf(*space, 1, 1)), 1e-10);
      EXPECT_LT(RelativeDifference(own->LoadOfValues(OnPoints(PointCoordinates(mesh))),
                  space->LoadOfValues(OnPoints(PointCoordinates(mesh)))),
        1e-14);
    }
  }
}

TEST(MetricOnTriangles, OfTheIdentityChangesNothing)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const HatSpace hats = Build(mesh);
    for (const FiniteElementSpace* space : { static_cast<const FiniteElementSpace*>(&hats),
           static_cast<const FiniteElementSpace*>(&hats.Grid()) })
    {
      const auto own = space->Copy();
      own->SetMetricOnTriangles(
        Metric(mesh, TensorsOf(static_cast<Id>(mesh.points.size()), FieldAssociation::Points,
                       Eigen::Matrix3d::Identity())));
      EXPECT_LT(RelativeDifference(DenseOf(*own, 1, 0), DenseOf(*space, 1, 0)), 1e-14);
      EXPECT_LT(RelativeDifference(DenseOf(*own, 0, 1), DenseOf(*space, 0, 1)), 1e-12);
    }
  }
}

/// The weight of the normal derivative does not depend on the metric.
TEST(MetricOnTriangles, KeepsCoordinatesTheSolutionOfTheirOwnEquation)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(8), { 1, 2, 3 }, 0.4);
  GridSpaceOptions options;
  options.functions.depth = 4;
  options.normalStabilization = 0.5;
  GridSpace grid = BuildGridSpace(mesh, options);
  grid.SetMetricOnTriangles(Metric(mesh, TensorsOfMove(mesh, Bent(mesh))));
  const MultiVector expected = DenseOf(grid, 0, 1) * grid.EmbeddingOfMesh() * grid.UnitLength();
  EXPECT_LT(RelativeDifference(grid.LoadOfGradientsOfCoordinates(nullptr), expected), 1e-12);
}

TEST(PlaneTensor, KnowsItsEigenvaluesInThePlane)
{
  const TriangleMesh flat = FlatRectangle(1, 1);
  Eigen::Matrix3d tensor = Eigen::Vector3d(4.0, 9.0, -1.0).asDiagonal();
  const PlaneTensor plane(flat, 0, tensor); // entries across the plane do not count
  EXPECT_NEAR(plane.Eigenvalues()[0], 4.0, 1e-14);
  EXPECT_NEAR(plane.Eigenvalues()[1], 9.0, 1e-14);
  EXPECT_TRUE(plane.IsMetric());
  EXPECT_NEAR(plane.Area(), 6.0, 1e-14);
  const Eigen::Matrix3d expected = Eigen::Vector3d(1.5, 2.0 / 3.0, 0.0).asDiagonal();
  EXPECT_LT((plane.InverseTimesArea() - expected).norm(), 1e-14);

  const auto isMetric = [&](double xx, double yy, double xy)
  {
    const double six[6] = { xx, yy, 1.0, xy, 0.0, 0.0 };
    return PlaneTensor(flat, 0, SymmetricTensor(six)).IsMetric();
  };
  EXPECT_TRUE(isMetric(2.0, 1.0, 1.4));
  EXPECT_FALSE(isMetric(2.0, 1.0, 1.5));
  EXPECT_FALSE(isMetric(0.0, 0.0, 0.0));
  EXPECT_FALSE(isMetric(1.0, 0.0, 0.0));
  EXPECT_FALSE(isMetric(-1.0, -1.0, 0.0));
  EXPECT_TRUE(isMetric(1e-60, 1e-60, 0.0));
  EXPECT_TRUE(isMetric(1e99, 1e90, 0.0));
  EXPECT_FALSE(isMetric(1e-200, 1e-200, 0.0));
  EXPECT_FALSE(isMetric(1e200, 1e200, 0.0));
  EXPECT_FALSE(isMetric(1e8, 1e-8, 0.0));
  EXPECT_FALSE(isMetric(std::nan(""), 1.0, 0.0));
  EXPECT_FALSE(isMetric(1.0, 1.0, INFINITY));
}

TEST(PlaneTensor, OfATriangleWithoutAPlaneIsTheIdentity)
{
  const TriangleMesh line{ { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 1e-11, 0 } }, { { 0, 1, 2 } } };
  const PlaneTensor plane(line, 0, -Eigen::Matrix3d::Identity());
  EXPECT_TRUE(plane.IsMetric());
  EXPECT_EQ(plane.Area(), 1.0);
  EXPECT_EQ(plane.InverseTimesArea(), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

TEST(MetricOfTensors, RefusesWhatIsNoMetric)
{
  const TriangleMesh mesh = GeodesicSphere(3);
  const Id points = static_cast<Id>(mesh.points.size());
  Field tensors = TensorsOf(points, FieldAssociation::Points, Eigen::Matrix3d::Identity());
  tensors.values.conservativeResize(points, 5);
  EXPECT_THROW(MetricOfTensors(mesh, tensors), InvalidInput);
  tensors = TensorsOf(points, FieldAssociation::Points, -Eigen::Matrix3d::Identity());
  EXPECT_THROW(MetricOfTensors(mesh, tensors), InvalidInput);
  tensors = TensorsOf(points - 1, FieldAssociation::Points, Eigen::Matrix3d::Identity());
  EXPECT_THROW(MetricOfTensors(mesh, tensors), InvalidInput);
  HatSpace hats = Build(mesh);
  EXPECT_THROW(hats.SetMetricOnTriangles(std::make_shared<TriangleMetric>()), InvalidInput);
}

} // namespace
