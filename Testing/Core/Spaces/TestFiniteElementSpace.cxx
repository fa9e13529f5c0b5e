// Tests the interface of finite element spaces on all kinds.
#include "Spaces/FiniteElementSpace.h"

#include "Base/Errors.h"
#include "Spaces.h"
#include "Spaces/SmoothSpace.h"
#include "Spaces/SpaceChoice.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int Depth = 4;

struct Case
{
  const char* name;
  FunctionKind kind;
  /// Weight of the normal derivative in the stiffness. Loads of gradients do not have it.
  double normalWeight;
};

void PrintTo(const Case& c, std::ostream* stream)
{
  *stream << c.name;
}

/// A space, and the coefficients of the coordinates in its unit of length.
struct SpaceOnMesh
{
  SpaceOnMesh(const TriangleMesh& inputMesh, FunctionKind kind, int degree = 2) : mesh(inputMesh)
  {
    SpaceOptions functions;
    functions.depth = Depth;
    SpaceChoice choice;
    choice.kind = kind;
    choice.quadratureDegree = degree;
    choice.coarsestSize = 32;
    space = BuildSpace(mesh, functions, choice, {});
    coordinates = space->EmbeddingOfMesh();
    for (Id i = 0; i < coordinates.rows(); ++i)
    {
      SetRow(coordinates, i,
        coordinates.row(i).transpose() + (space->Origin() / space->UnitLength()).eval());
    }
  }

  TriangleMesh mesh;
  std::unique_ptr<FiniteElementSpace> space;
  MultiVector coordinates;
};

std::vector<TriangleMesh> Meshes()
{
  return { Transform(GeodesicSphere(8), { 1, 2, 3 }, 0.4, 5.0), Torus(24, 12, 1.0, 0.3),
    Transform(TwoSheets(6, 0.01), { 1, 0.3, 0 }, 0.4), Join(Box(4), GeodesicSphere(4, 0.1)) };
}

class EverySpace : public ::testing::TestWithParam<Case>
{
protected:
  SpaceOnMesh Build(const TriangleMesh& mesh, int degree = 2) const
  {
    return { mesh, GetParam().kind, degree };
  }
};

Eigen::MatrixXd DenseOf(const FiniteElementSpace& space, double a, double b)
{
  return Dense(space.Matrix(0, a, b));
}

} // namespace

TEST_P(EverySpace, HasALoadOfOneThatAddsUpToTheArea)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const MultiVector one = MultiVector::Ones(static_cast<Id>(mesh.points.size()), 1);
    const MultiVector load = on.space->LoadOfValues({ FieldAssociation::Points, one });
    const double area = SurfaceArea(mesh) / std::pow(on.space->UnitLength(), 2);
    EXPECT_NEAR(load.sum(), area, 1e-9 * area);
    for (Id i = 0; i < load.rows(); ++i)
    {
      ASSERT_NEAR(load(i, 0), on.space->Integrals()[i], 1e-11 * area);
    }
    const MultiVector ones = MultiVector::Ones(load.rows(), 1);
    EXPECT_LT((Product(DenseOf(*on.space, 1, 0), ones) - load).norm(), 1e-11 * load.norm());
    EXPECT_LT(Product(DenseOf(*on.space, 0, 1), ones).norm(), 1e-9);
  }
}

/// If a function has slope 1, its direction is its gradient. The gradients of coordinates on a
/// plane are known.
TEST_P(EverySpace, IntegratesDirectionsAsGradientsOverTheirSize)
{
  const Eigen::AngleAxisd turn(0.4, Vec3(1, 0.3, 0).normalized());
  const SpaceOnMesh on = this->Build(Transform(TwoSheets(6, 0.2), { 1, 0.3, 0 }, 0.4));
  const Vec3 slope = turn * Vec3(0.6, -0.8, 0);
  const FiniteElementSpace* nested = on.space->NestedLevels();
  const MultiVector coordinates = nested ? nested->EmbeddingOfMesh() : on.coordinates;
  const MultiVector u = coordinates * (1e-200 * slope); // works for arbitrarily small slopes
  MultiVector s(static_cast<Id>(on.mesh.points.size()), 3);
  for (Id i = 0; i < s.rows(); ++i)
  {
    SetRow(s, i, slope);
  }
  const MultiVector expected = on.space->LoadOfGradients({ FieldAssociation::Points, s }, nullptr);
  EXPECT_LT((on.space->LoadOfDirections(u, nullptr) - expected).norm(), 1e-6 * expected.norm());
  const Field twice{ FieldAssociation::Triangles,
    MultiVector::Constant(static_cast<Id>(on.mesh.triangles.size()), 1, 2.0) };
  EXPECT_LT((on.space->LoadOfDirections(u, &twice) - 2 * expected).norm(), 1e-6 * expected.norm());
  EXPECT_EQ(on.space->LoadOfDirections(MultiVector::Ones(u.rows(), 1), nullptr).norm(), 0.0);
  EXPECT_THROW(on.space->LoadOfDirections(MultiVector::Ones(3, 1), nullptr), InvalidInput);
}

/// Compares ∫ (a + b p) x_i over the boundary, for coordinates as functions of the space.
TEST_P(EverySpace, IntegratesAlongBoundaries)
{
  const TriangleMesh coarse = Transform(FlatRectangle(1, 2, 2.0, 3.0), { 1, 2, 3 }, 0.4, 5.0);
  for (const TriangleMesh& mesh : { coarse, FlatRectangle(1, 1), Meshes()[2] })
  {
    const SpaceOnMesh on = this->Build(mesh);
    const std::vector<TriangleEdge> edges = FindSurfaceEdges(mesh, true).boundary;
    const EdgeSamples samples = on.space->SamplesOfSegments(SegmentsOf(edges, mesh));
    Vec3 expected = Vec3::Zero();
    double length = 0.0;
    for (const TriangleEdge& edge : edges)
    {
      const auto ends = edge.Ends(mesh);
      const Vec3& a = mesh.points[ends[0]];
      const Vec3& b = mesh.points[ends[1]];
      length += (b - a).norm();
      expected += (b - a).norm() / 6.0 *
                  ((2 + 3 * a[0]) * (2 * a + b) + (2 + 3 * b[0]) * (a + 2 * b)); // a linear
                                                                                 // function times a
                                                                                 // linear function
    }
    MultiVector values;
    Multiply(samples.rows, on.coordinates * on.space->UnitLength(), values);
    Vec3 sum = Vec3::Zero();
    double total = 0.0;
    for (Id k = 0; k < values.rows(); ++k)
    {
      const auto ends = edges[samples.edge[k]].Ends(mesh);
      const double t = samples.position[k];
      const Vec3 place = (1.0 - t) * mesh.points[ends[0]] + t * mesh.points[ends[1]];
      const Vec3 value = values.row(k).transpose();
      ASSERT_LT((value - place).norm(), 1e-9);
      sum += samples.length[k] * (2 + 3 * place[0]) * value;
      total += samples.length[k];
    }
    EXPECT_NEAR(total, length, 1e-9 * length);
    EXPECT_LT((sum - expected).norm(), 1e-9 * expected.norm());
    EXPECT_THROW(
      on.space->SamplesOfSegments({ { Id(1000000), Vec3::Unit(0), Vec3::Unit(1) } }), InvalidInput);
  }
}

TEST_P(EverySpace, TurnsVectorsAboutTheNormal)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const auto triangles = static_cast<Id>(mesh.triangles.size());
    const MultiVector s = RandomValues(triangles, 3);
    MultiVector turned(triangles, 3);
    for (Id t = 0; t < triangles; ++t)
    {
      const auto& corner = mesh.triangles[t];
      const Vec3 normal = (mesh.points[corner[1]] - mesh.points[corner[0]])
                            .cross(mesh.points[corner[2]] - mesh.points[corner[0]])
                            .normalized();
      SetRow(turned, t, normal.cross(Vec3(s(t, 0), s(t, 1), s(t, 2))));
    }
    const MultiVector expected =
      on.space->LoadOfGradients({ FieldAssociation::Triangles, turned }, nullptr);
    const MultiVector load = on.space->LoadOfTurnedGradients({ FieldAssociation::Triangles, s });
    EXPECT_LT((load - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST_P(EverySpace, IntegratesGradientsAsItsStiffnessDoes)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const MultiVector expected =
      Product(DenseOf(*on.space, 0, 1), on.coordinates) * on.space->UnitLength();
    const Field points{ FieldAssociation::Points, PointCoordinates(mesh) };
    const MultiVector load = on.space->LoadOfGradientsOf(points, nullptr);
    // Loads along the surface nearly cancel inside it, so the weight counts several times.
    const double tolerance = 1e-6 + 10.0 * GetParam().normalWeight;
    EXPECT_LT((load - expected).norm(), tolerance * expected.norm());

    const MultiVector gradients =
      on.space->GradientsOnTriangles(on.coordinates) * on.space->UnitLength();
    const MultiVector again =
      on.space->LoadOfGradients({ FieldAssociation::Triangles, gradients }, nullptr);
    EXPECT_LT((again - load).norm(), 1e-6 * expected.norm());
  }
}

TEST_P(EverySpace, GradientsOfCoordinatesAreProjections)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const MultiVector gradients =
      on.space->GradientsOnTriangles(on.coordinates) * on.space->UnitLength();
    ASSERT_EQ(gradients.rows(), static_cast<Id>(mesh.triangles.size()));
    for (Id t = 0; t < gradients.rows(); ++t)
    {
      const auto& corner = mesh.triangles[t];
      const Vec3 normal = (mesh.points[corner[1]] - mesh.points[corner[0]])
                            .cross(mesh.points[corner[2]] - mesh.points[corner[0]])
                            .normalized();
      for (int c = 0; c < 3; ++c)
      {
        const Vec3 expected = Vec3::Unit(c) - normal[c] * normal;
        const Vec3 found = gradients.row(t).segment<3>(3 * c).transpose();
        ASSERT_LT((found - expected).norm(), 1e-8) << t << " " << c;
      }
    }
  }
}

TEST_P(EverySpace, HasTheNormsOfItsMass)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const MultiVector u = RandomValues(on.space->NumberOfFunctions(0), 3);
    MultiVector product;
    Multiply(on.space->Matrix(0, 1.0, 0.0), u, product);
    const Columns norms = on.space->SquaredNorms(u);
    for (Id c = 0; c < u.cols(); ++c)
    {
      EXPECT_NEAR(norms[c], u.col(c).dot(product.col(c)), 1e-12 * norms[c]);
    }
    EXPECT_TRUE((on.space->SquaredNorms(u, 1) == on.space->SquaredNorms(u, 2)).all());
  }
}

/// Uses facets as in STL files: they have corners of their own, which coincide in one point or two.
TEST_P(EverySpace, HasTheValuesOfOtherPointsWhereATriangleWithoutAreaEnds)
{
  TriangleMesh mesh = GeodesicSphere(12);
  const std::array<std::array<Id, 3>, 3> places = { { { 40, 40, 40 }, { 41, 50, 50 },
    { 7, 7, 90 } } };
  std::vector<std::pair<Id, Id>> same;
  for (const auto& place : places)
  {
    const auto first = static_cast<Id>(mesh.points.size());
    for (Id k = 0; k < 3; ++k)
    {
      same.emplace_back(first + k, place[k]);
      mesh.points.push_back(mesh.points[place[k]]);
    }
    mesh.triangles.push_back({ first, first + 1, first + 2 });
  }
  const SpaceOnMesh on = this->Build(mesh);
  const MultiVector values =
    on.space->ValuesAtPoints(RandomValues(on.space->NumberOfFunctions(0), 2));
  for (const auto& [added, given] : same)
  {
    EXPECT_LT((values.row(added) - values.row(given)).norm(), 1e-12) << added;
  }
}

TEST_P(EverySpace, HasTheSameValuesByRows)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const MultiVector x = RandomValues(on.space->NumberOfFunctions(0), 2);
    const MultiVector values = on.space->ValuesAtPoints(x);
    std::vector<Id> points;
    for (Id point = 0; point < values.rows(); point += 3)
    {
      points.push_back(point);
    }
    MultiVector byRows;
    Multiply(on.space->RowsAtPoints(points), x, byRows);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      ASSERT_LT((byRows.row(static_cast<Id>(k)) - values.row(points[k])).norm(), 1e-13);
    }
    const Id none = static_cast<Id>(mesh.points.size());
    EXPECT_THROW(on.space->RowsAtPoints({ none }), InvalidInput);
    EXPECT_THROW(on.space->RowsAtPoints({ -1 }), InvalidInput);
  }
}

TEST_P(EverySpace, TheEmbeddingOfTheMeshHasItsPoints)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const MultiVector embedding = on.space->EmbeddingOfMesh();
    ASSERT_EQ(embedding.rows(), on.space->NumberOfFunctions(0));
    EXPECT_EQ(on.space->EmbeddingOfMesh(1), embedding);
    const MultiVector points = on.space->ValuesAtPoints(embedding);
    const std::vector<char> reached = on.space->PointsWithFunctions();
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
    {
      const Vec3 position =
        on.space->Origin() + on.space->UnitLength() * points.row(static_cast<Id>(k)).transpose();
      ASSERT_TRUE(!reached[k] || (position - mesh.points[k]).norm() < 1e-12 * 10.0);
    }
    // Quadratic functions have their places in the middle of cells, including cells around the
    // grid.
    EXPECT_LE(embedding.maxCoeff<Eigen::PropagateNaN>(), on.space->Extent() + 0.5 + 1e-9);
    EXPECT_GE(embedding.minCoeff(), -0.5 - 1e-9);
  }
}

TEST_P(EverySpace, ACopyInAnotherMetricLeavesTheOriginalAlone)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const Eigen::MatrixXd mass = DenseOf(*on.space, 1, 0);
    const Eigen::MatrixXd stiffness = DenseOf(*on.space, 0, 1);
    const std::unique_ptr<FiniteElementSpace> copy = on.space->Copy();
    EXPECT_EQ(copy->SetMetric(on.coordinates), 0); // the metric of the mesh itself
    EXPECT_LT(RelativeDifference(DenseOf(*copy, 1, 0), mass), 1e-6);
    EXPECT_LT(RelativeDifference(DenseOf(*copy, 0, 1), stiffness), 1e-6);

    const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
    const MultiVector moved =
      3.0 * on.coordinates * turn.toRotationMatrix().transpose() + // scaled and turned
      MultiVector::Constant(on.coordinates.rows(), 3, 5.0);
    EXPECT_EQ(copy->SetMetric(moved), 0);
    EXPECT_LT(RelativeDifference(DenseOf(*copy, 1, 0), 9.0 * mass), 1e-6);
    EXPECT_LT(RelativeDifference(DenseOf(*copy, 0, 1), stiffness), 1e-6);
    EXPECT_LT(
      RelativeDifference(Dense(copy->Matrix(1, 1, 0)), 9.0 * Dense(on.space->Matrix(1, 1, 0))),
      1e-6);
    EXPECT_EQ(DenseOf(*on.space, 1, 0), mass);
    EXPECT_EQ(DenseOf(*on.space, 0, 1), stiffness);
    EXPECT_THROW(copy->SetMetric(MultiVector::Ones(3, 3)), InvalidInput);
  }
}

/// Tests the case of the conformalized flow: the mass of the moved surface, the stiffness of the
/// start.
TEST_P(EverySpace, AMetricOfTheMassAloneLeavesTheStiffness)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    MultiVector moved = on.coordinates;
    moved.col(1) *= 2.0;
    const std::unique_ptr<FiniteElementSpace> both = on.space->Copy();
    const std::unique_ptr<FiniteElementSpace> mass = on.space->Copy();
    both->SetMetric(moved);
    mass->SetMetric(moved, {}, ElementParts::Mass);
    EXPECT_GT(RelativeDifference(DenseOf(*both, 0, 1), DenseOf(*on.space, 0, 1)), 1e-2);
    for (std::size_t level = 0; level < on.space->NumberOfLevels(); ++level)
    {
      EXPECT_EQ(Dense(mass->Matrix(level, 1, 0)), Dense(both->Matrix(level, 1, 0)));
      EXPECT_EQ(Dense(mass->Matrix(level, 0, 1)), Dense(on.space->Matrix(level, 0, 1)));
    }
    EXPECT_EQ(mass->Integrals(), both->Integrals());
    const MultiVector load = Product(DenseOf(*mass, 0, 1), moved);
    EXPECT_LT(RelativeDifference(mass->StiffnessTimes(moved, {}), load), 1e-10);
    mass->SetMetric(moved);
    EXPECT_LT(RelativeDifference(DenseOf(*mass, 2, 3), DenseOf(*both, 2, 3)), 1e-14);
  }
}

TEST_P(EverySpace, ASurfaceThatCollapsesIsSingularAndFinite)
{
  const SpaceOnMesh on = this->Build(GeodesicSphere(8));
  const std::unique_ptr<FiniteElementSpace> copy = on.space->Copy();
  EXPECT_GT(copy->SetMetric(MultiVector::Zero(on.coordinates.rows(), 3)), 0);
  EXPECT_TRUE(DenseOf(*copy, 1, 1).allFinite());
}

TEST_P(EverySpace, WeightsOfOneChangeNothing)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const std::unique_ptr<FiniteElementSpace> copy = on.space->Copy();
    const MultiVector area = MultiVector::Ones(static_cast<Id>(mesh.triangles.size()), 1);
    const auto elements = static_cast<std::size_t>(copy->MeansOnElements(area).rows());
    EXPECT_THROW(copy->Weigh(std::vector<ElementWeights>(elements)), InvalidInput);
    copy->SplitStiffness(std::vector<Vec3>(mesh.triangles.size(), Vec3(1, 2, 3)));
    copy->Weigh(std::vector<ElementWeights>(elements));
    EXPECT_LT(RelativeDifference(DenseOf(*copy, 1, 0), DenseOf(*on.space, 1, 0)), 1e-6);
    EXPECT_LT(RelativeDifference(DenseOf(*copy, 0, 1), DenseOf(*on.space, 0, 1)), 1e-6);
  }
}

/// On a flat square turned in space, ∇x has a single direction. Its energy gets the weight of this
/// direction.
TEST_P(EverySpace, WeightsAreThoseOfTheDirection)
{
  const Eigen::AngleAxisd turn(0.3, Vec3(0, 0, 1)); // stays in a plane of the grid's cells
  const TriangleMesh mesh = Transform(TwoSheets(6, 0.5), Vec3(0, 0, 1), 0.3);
  const SpaceOnMesh on = this->Build(mesh);
  const std::unique_ptr<FiniteElementSpace> copy = on.space->Copy();
  const Vec3 along = turn * Vec3(1, 0, 0);
  const Vec3 across = turn * Vec3(0, 1, 0);
  copy->SplitStiffness(std::vector<Vec3>(mesh.triangles.size(), along));
  const MultiVector ones = MultiVector::Ones(static_cast<Id>(mesh.triangles.size()), 1);
  copy->Weigh(
    std::vector<ElementWeights>(copy->MeansOnElements(ones).rows(), { 3.0, { 5.0, 0.25 } }));
  const Eigen::MatrixXd stiffness = DenseOf(*copy, 0, 1);
  const double area = SurfaceArea(mesh) / std::pow(on.space->UnitLength(), 2);
  const Eigen::VectorXd x = on.coordinates * along;
  const Eigen::VectorXd y = on.coordinates * across;
  EXPECT_NEAR(x.dot(stiffness * x), 5.0 * area, 1e-6 * area);
  EXPECT_NEAR(y.dot(stiffness * y), 0.25 * area, 1e-6 * area);
  EXPECT_NEAR(x.dot(stiffness * y), 0.0, 1e-6 * area);
  EXPECT_NEAR(DenseOf(*copy, 1, 0).sum(), 3.0 * area, 1e-6 * area);
}

TEST_P(EverySpace, WeighsItsMassAsItsLoads)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh s = this->Build(mesh);
    const Id triangles = static_cast<Id>(mesh.triangles.size());
    const MultiVector random = RandomValues(triangles, 1);
    std::vector<double> weight(triangles);
    double sum = 0.0; // ∫ w
    for (Id t = 0; t < triangles; ++t)
    {
      weight[t] = std::max(0.0, random(t, 0));
      const auto& corner = mesh.triangles[t];
      sum += 0.5 * weight[t] *
             (mesh.points[corner[1]] - mesh.points[corner[0]])
               .cross(mesh.points[corner[2]] - mesh.points[corner[0]])
               .norm();
    }
    const auto weighted = s.space->Copy();
    weighted->WeighMass(weight);
    const Eigen::MatrixXd mass = DenseOf(*weighted, 1.0, 0.0);
    const double unit = s.space->UnitLength();
    EXPECT_NEAR(mass.sum() * unit * unit, sum, 1e-9 * sum);
    // The weighted load of a function of the space is the mass times its coefficients.
    const Field x{ FieldAssociation::Points, PointCoordinates(mesh) / unit };
    const MultiVector load = s.space->LoadOfWeightedValues(x, weight);
    EXPECT_LT(RelativeDifference(mass * s.coordinates, load), 1e-9);
    const Eigen::Map<const Eigen::VectorXd> integrals(
      weighted->Integrals().data(), static_cast<Eigen::Index>(weighted->Integrals().size()));
    EXPECT_LT(RelativeDifference(mass.rowwise().sum(), integrals), 1e-9);
    EXPECT_LT(RelativeDifference(DenseOf(*weighted, 0.0, 1.0), DenseOf(*s.space, 0.0, 1.0)), 1e-12);
  }
}

TEST_P(EverySpace, RefusesWeightsThatDoNotFit)
{
  const SpaceOnMesh s = this->Build(GeodesicSphere(4));
  const Field x{ FieldAssociation::Points, PointCoordinates(s.mesh) };
  std::vector<double> weight(s.mesh.triangles.size(), 1.0);
  weight.back() = -1.0;
  EXPECT_THROW(s.space->WeighMass(weight), InvalidInput);
  weight.back() = std::nan("");
  EXPECT_THROW(s.space->LoadOfWeightedValues(x, weight), InvalidInput);
  weight.pop_back();
  EXPECT_THROW(s.space->WeighMass(weight), InvalidInput);
}

TEST_P(EverySpace, MeansOnElementsKeepConstants)
{
  const SpaceOnMesh on = this->Build(Torus(24, 12, 1.0, 0.3));
  const MultiVector seven =
    MultiVector::Constant(static_cast<Id>(on.mesh.triangles.size()), 2, 7.0);
  const MultiVector means = on.space->MeansOnElements(seven);
  EXPECT_LT((means.array() - 7.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);
}

TEST_P(EverySpace, MultipliesItsOwnFunctionsByItsElements)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const SpaceOnMesh on = this->Build(mesh);
    const MultiVector u = RandomValues(on.space->NumberOfFunctions(0), 5);
    const MultiVector expected = Product(DenseOf(*on.space, 0.0, 1.0), u);
    EXPECT_LE(RelativeDifference(on.space->StiffnessTimes(u, {}), expected), 1e-13);
    EXPECT_EQ(on.space->StiffnessTimes(u, {}, 1), on.space->StiffnessTimes(u, {}, 2));

    // The coordinates, once as functions of the space and once as a field that is integrated.
    const MultiVector world = on.coordinates * on.space->UnitLength();
    EXPECT_LE(RelativeDifference(Product(DenseOf(*on.space, 1.0, 0.0), world),
                on.space->LoadOfValues({ FieldAssociation::Points, PointCoordinates(mesh) })),
      1e-12);
    EXPECT_LE(RelativeDifference(on.space->StiffnessTimes(world, {}),
                on.space->LoadOfGradientsOfCoordinates(nullptr)),
      1e-12);
  }
}

/// A scale that is constant on each component gives one number per element.
TEST_P(EverySpace, ScalesGradientsInProductsWithItsStiffness)
{
  const TriangleMesh mesh = Join(Box(4), GeodesicSphere(4, 0.1));
  const auto boxes = static_cast<Id>(Box(4).triangles.size());
  const SpaceOnMesh on = this->Build(mesh);
  Field scale{ FieldAssociation::Triangles,
    MultiVector::Constant(static_cast<Id>(mesh.triangles.size()), 1, 3.0) };
  scale.values.bottomRows(scale.values.rows() - boxes).setConstant(-0.5);
  const MultiVector means = on.space->MeansOnElements(scale.values);
  const std::vector<double> onElements(means.data(), means.data() + means.size());
  const MultiVector world = on.coordinates * on.space->UnitLength();
  EXPECT_LE(RelativeDifference(on.space->StiffnessTimes(world, onElements),
              on.space->LoadOfGradientsOfCoordinates(&scale)),
    1e-12);
  EXPECT_THROW(on.space->StiffnessTimes(world, { 1.0, 2.0 }), InvalidInput);
  EXPECT_THROW(on.space->StiffnessTimes(world.topRows(3), {}), InvalidInput);
}

TEST_P(EverySpace, MultipliesByItsStiffnessInItsOwnMetric)
{
  const SpaceOnMesh on = this->Build(Torus(24, 12, 1.0, 0.3));
  const MultiVector u = RandomValues(on.space->NumberOfFunctions(0), 2);
  const auto agrees = [&](const FiniteElementSpace& space)
  {
    const MultiVector expected = Product(DenseOf(space, 0.0, 1.0), u);
    return RelativeDifference(space.StiffnessTimes(u, {}), expected);
  };
  const auto weighted = on.space->Copy();
  const std::vector<Vec3> along(on.mesh.triangles.size(), Vec3(1, 2, 3));
  weighted->SplitStiffness(along);
  const Id elements =
    weighted->MeansOnElements(MultiVector::Ones(static_cast<Id>(along.size()), 1)).rows();
  std::vector<ElementWeights> weights(elements);
  const MultiVector random = RandomValues(elements, 3);
  for (Id e = 0; e < elements; ++e)
  {
    weights[e] = { 1.5 + random(e, 0), { 1.5 + random(e, 1), 1.5 + random(e, 2) } };
  }
  weighted->Weigh(weights);
  EXPECT_LE(agrees(*weighted), 1e-13);
  const auto moved = on.space->Copy();
  MultiVector embedding = on.space->EmbeddingOfMesh();
  embedding.col(0) *= 2.0;
  moved->SetMetric(embedding);
  EXPECT_LE(agrees(*moved), 1e-13);
  EXPECT_LE(agrees(*on.space), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EverySpace,
  ::testing::Values(Case{ "grid", FunctionKind::Grid, 0.0 },
    Case{ "hats", FunctionKind::Hats, 0.0 },
    Case{ "smooth", FunctionKind::SmoothGrid, SmoothStabilization }),
  [](const auto& kind) { return std::string(kind.param.name); });
