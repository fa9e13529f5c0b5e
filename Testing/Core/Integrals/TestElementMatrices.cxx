// Tests element matrices: sums that must hold on any mesh, an independent integration on coarse
// levels, and invariance (subdivision in the plane, slivers, threads).
#include "Integrals/ElementMatrices.h"
#include "Largest.h"

#include "Dense.h"
#include "ElementSums.h"
#include "Spaces.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Element = Eigen::Matrix<double, FunctionsPerPatch, FunctionsPerPatch>;

Element Full(const ElementMatrix& packed)
{
  Element full;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = 0; j < FunctionsPerPatch; ++j)
    {
      full(i, j) = packed[PackedIndex(i, j)];
    }
  }
  return full;
}

double AreaInGridUnits(const SpaceCase& space, const Grid& grid)
{
  return SurfaceArea(space.mesh) / (grid.spacing * grid.spacing);
}

/// The element matrices of a level, integrated directly from the samples of the finest pieces
/// without coarsening.
struct DirectIntegrals
{
  std::vector<Element> mass;
  std::vector<Element> stiffness;
};

DirectIntegrals IntegrateOnLevel(
  const GridFunctions& space, std::size_t levelNumber, const QuadratureRule& rule)
{
  const PatchLevel& level = space.levels[levelNumber];
  const double side = std::pow(2.0, double(levelNumber));
  DirectIntegrals sums;
  sums.mass.assign(level.NumberOfPatches(), Element::Zero());
  sums.stiffness = sums.mass;
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    Id patch = space.piecePatch[piece];
    for (std::size_t l = 0; l < levelNumber; ++l)
    {
      patch = space.levels[l].parent[patch];
    }
    const CellIndex cell = MortonDecode(level.cell[patch]);
    const Vec3 corner = side * Vec3(cell[0], cell[1], cell[2]);
    const Index* ids = space.clipped.corners.data() + space.clipped.pieceBegin[piece];
    const Id count = space.clipped.pieceBegin[piece + 1] - space.clipped.pieceBegin[piece];
    for (Id k = 1; k + 1 < count; ++k)
    {
      const Vec3& p = space.clipped.position[ids[0]];
      const Vec3& q = space.clipped.position[ids[k]];
      const Vec3& r = space.clipped.position[ids[k + 1]];
      const Vec3 twice = (q - p).cross(r - p);
      if (twice.norm() == 0.0)
      {
        continue;
      }
      const Eigen::Matrix3d tangential =
        Eigen::Matrix3d::Identity() - twice * twice.transpose() / twice.squaredNorm();
      for (const auto& point : rule.points)
      {
        const auto& t = point.barycentric;
        const Vec3 local = (t[0] * p + t[1] * q + t[2] * r - corner) / side;
        std::array<double, FunctionsPerPatch> b;
        TrilinearValues(local, b);
        const std::array<Vec3, FunctionsPerPatch> g = TrilinearGradientsAt(local);
        const double weight = 0.5 * twice.norm() * point.weight;
        for (int i = 0; i < FunctionsPerPatch; ++i)
        {
          for (int j = 0; j < FunctionsPerPatch; ++j)
          {
            sums.mass[patch](i, j) += weight * b[i] * b[j];
            sums.stiffness[patch](i, j) += weight * g[i].dot(tangential * g[j]) / (side * side);
          }
        }
      }
    }
  }
  return sums;
}

void ExpectNear(
  const Array<ElementMatrix>& actual, const std::vector<Element>& expected, double relative)
{
  ASSERT_EQ(actual.size(), expected.size());
  double largest = 0.0;
  double worst = 0.0;
  for (std::size_t p = 0; p < actual.size(); ++p)
  {
    largest = Larger(largest, expected[p].cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
    worst =
      Larger(worst, (Full(actual[p]) - expected[p]).cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  }
  EXPECT_LT(worst, relative * largest);
}

std::vector<Element> FullOf(const Array<ElementMatrix>& packed)
{
  std::vector<Element> full;
  for (const ElementMatrix& element : packed)
  {
    full.push_back(Full(element));
  }
  return full;
}

class ElementsOfSpaces : public ::testing::TestWithParam<SpaceCase>
{
};

} // namespace

TEST_P(ElementsOfSpaces, MassSumsToTheArea)
{
  const GridFunctions space = GetParam().Build();
  const ElementMatrices elements = IntegrateElements(space, TriangleRule(2));
  double sum = 0.0;
  for (const ElementMatrix& mass : elements.mass)
  {
    sum += Full(mass).sum();
  }
  const double area = AreaInGridUnits(GetParam(), space.GetGrid());
  // Far from the origin, grid coordinates lose digits by the factor |coordinate| / size.
  EXPECT_NEAR(sum, area, 1e-12 * area);
}

TEST_P(ElementsOfSpaces, StiffnessAnnihilatesConstants)
{
  const ElementMatrices elements = IntegrateElements(GetParam().Build(), TriangleRule(2));
  for (const ElementMatrix& stiffness : elements.stiffness)
  {
    const Element L = Full(stiffness);
    // Each sum has eight terms of both signs, with an error of a few roundings of the largest sum.
    EXPECT_LT(
      L.rowwise().sum().cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-14 * L.trace() + 1e-300);
  }
}

TEST_P(ElementsOfSpaces, AreSymmetricPositiveSemidefinite)
{
  const ElementMatrices elements = IntegrateElements(GetParam().Build(), TriangleRule(2));
  for (std::size_t p = 0; p < elements.mass.size(); ++p)
  {
    for (const Element& E : { Full(elements.mass[p]), Full(elements.stiffness[p]) })
    {
      EXPECT_GE(DenseEigen(E).values[0], -1e-14 * E.trace()); // rounding of sum and solver
    }
  }
}

TEST_P(ElementsOfSpaces, EnergyOfTheCoordinatesIsTwiceTheArea)
{
  // For tangential gradients, |∇x|² + |∇y|² + |∇z|² is the trace of the projection to the plane: 2.
  const GridFunctions space = GetParam().Build();
  const ElementMatrices elements = IntegrateElements(space, TriangleRule(2));
  double energy = 0.0;
  for (const ElementMatrix& stiffness : elements.stiffness)
  {
    const Element L = Full(stiffness);
    for (int axis = 0; axis < 3; ++axis)
    {
      Eigen::Matrix<double, FunctionsPerPatch, 1> x;
      for (int c = 0; c < FunctionsPerPatch; ++c)
      {
        x[c] = (c >> axis) & 1;
      }
      energy += x.dot(L * x);
    }
  }
  const double area = AreaInGridUnits(GetParam(), space.GetGrid());
  // In addition to rounding, normal derivatives may have a weight of 1e-12.
  EXPECT_NEAR(energy, 2.0 * area, 4e-12 * area);
}

TEST_P(ElementsOfSpaces, CoarsenedMatricesEqualDirectIntegrationOnEveryLevel)
{
  const GridFunctions space = GetParam().Build();
  const QuadratureRule& rule = TriangleRule(2);
  ElementMatrices elements = IntegrateElements(space, rule);
  for (std::size_t l = 0; l < space.levels.size(); ++l)
  {
    SCOPED_TRACE(l);
    const DirectIntegrals direct = IntegrateOnLevel(space, l, rule);
    ExpectNear(elements.mass, direct.mass, 1e-12);
    ExpectNear(elements.stiffness, direct.stiffness, 1e-12);
    if (l + 1 < space.levels.size())
    {
      elements = Coarsened(space.levels[l], space.levels[l + 1], elements);
    }
  }
}

TEST_P(ElementsOfSpaces, DoNotDependOnSubdivisionInThePlane)
{
  // Degree 6 integrates the products of two trilinear functions exactly on any piece. The new
  // points of the subdivision are rounded to the input's precision, relative to the origin.
  SpaceCase subdivided = GetParam();
  subdivided.mesh = SubdivideInPlane(subdivided.mesh);
  const GridFunctions coarse = GetParam().Build();
  const GridFunctions fine = subdivided.Build();
  ASSERT_EQ(coarse.Finest().dof, fine.Finest().dof);
  const ElementMatrices a = IntegrateElements(coarse, TriangleRule(6));
  const ElementMatrices b = IntegrateElements(fine, TriangleRule(6));
  ExpectNear(b.mass, FullOf(a.mass), 1e-11);
  ExpectNear(b.stiffness, FullOf(a.stiffness), 1e-11);
}

TEST_P(ElementsOfSpaces, AreTheSameBitsForAnyNumberOfThreads)
{
  const GridFunctions space = GetParam().Build();
  const ElementMatrices one = IntegrateElements(space, TriangleRule(4), 1);
  const ElementMatrices two = IntegrateElements(space, TriangleRule(4), 2);
  EXPECT_EQ(one.mass, two.mass);
  EXPECT_EQ(one.stiffness, two.stiffness);
  EXPECT_EQ(Coarsened(space.levels[0], space.levels[1], one, 1).mass,
    Coarsened(space.levels[0], space.levels[1], one, 2).mass);
}

INSTANTIATE_TEST_SUITE_P(Spaces, ElementsOfSpaces, ::testing::ValuesIn(AllSpaces()));

TEST(ElementMatrices, OfTrianglesWithoutAreaVanish)
{
  TriangleMesh mesh = FlatRectangle(3, 3);
  const double area = SurfaceArea(mesh);
  mesh.triangles.push_back({ 0, 1, 1 }); // a segment
  mesh.triangles.push_back({ 2, 2, 2 }); // a point
  mesh.triangles.push_back({ 0, 1, 2 }); // three points in a row
  const GridFunctions space = BuildGridFunctions(mesh, {});
  const ElementMatrices elements = IntegrateElements(space, TriangleRule(2));
  double sum = 0.0;
  for (std::size_t p = 0; p < elements.mass.size(); ++p)
  {
    sum += Full(elements.mass[p]).sum();
    EXPECT_TRUE(Full(elements.stiffness[p]).allFinite());
  }
  EXPECT_NEAR(sum * std::pow(space.GetGrid().spacing, 2), area, 1e-12);
}

TEST(ElementMatrices, OfASquareInTheMiddleOfACellAreTheKnownOnes)
{
  // A unit square in the plane z = 1/2 fills one cell. Its matrices are tensor products of 1D
  // matrices.
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0.5 }, { 1, 0, 0.5 }, { 1, 1, 0.5 }, { 0, 1, 0.5 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  GridFunctions space;
  space.clipped.position.assign(mesh.points.begin(), mesh.points.end());
  space.clipped.numberOfInputPoints = 4;
  space.clipped.cells = { 0 };
  space.clipped.cellBegin = { 0, 1 };
  space.clipped.pieceTriangle = { 0 };
  space.clipped.pieceBegin = { 0, 4 };
  space.clipped.corners = { 0, 1, 2, 3 };
  space.piecePatch = { 0 };
  space.levels.resize(1);
  space.levels[0].cell = { 0 };
  space.levels[0].dof = { { 0, 1, 2, 3, 4, 5, 6, 7 } };
  space.levels[0].numberOfFunctions = 8;
  const ElementMatrices elements = IntegrateElements(space, TriangleRule(6));
  const double m[2][2] = { { 1.0 / 3.0, 1.0 / 6.0 }, { 1.0 / 6.0, 1.0 / 3.0 } };
  const double d[2][2] = { { 1.0, -1.0 }, { -1.0, 1.0 } };
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = 0; j < FunctionsPerPatch; ++j)
    {
      const int xi = i & 1, yi = (i >> 1) & 1, xj = j & 1, yj = (j >> 1) & 1;
      const double inZ = 0.25; // both functions have the value 1/2 in z
      const int entry = PackedIndex(i, j);
      EXPECT_NEAR(elements.mass[0][entry], m[xi][xj] * m[yi][yj] * inZ, 1e-15);
      EXPECT_NEAR(
        elements.stiffness[0][entry], (d[xi][xj] * m[yi][yj] + m[xi][xj] * d[yi][yj]) * inZ, 2e-12);
    }
  }
}

TEST(Trilinear, FunctionsInterpolateAndSumToOne)
{
  const MultiVector points = RandomValues(20, 3);
  for (Id k = 0; k < points.rows(); ++k)
  {
    const Vec3 local = points.row(k).transpose();
    std::array<double, FunctionsPerPatch> b;
    TrilinearValues(local, b);
    double sum = 0.0;
    Vec3 position = Vec3::Zero();
    for (int c = 0; c < FunctionsPerPatch; ++c)
    {
      sum += b[c];
      position += b[c] * Vec3(c & 1, (c >> 1) & 1, c >> 2);
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_LT((position - local).norm(), 1e-14);
  }
}

TEST(Trilinear, GradientsAreDifferencesAlongTheAxes)
{
  // The functions are linear along an axis, so a difference over length 1 is the derivative.
  const MultiVector points = RandomValues(20, 3);
  for (Id k = 0; k < points.rows(); ++k)
  {
    const Vec3 local = points.row(k).transpose();
    std::array<CornerValues, 3> gradient;
    TrilinearGradients(local, gradient);
    for (int axis = 0; axis < 3; ++axis)
    {
      std::array<double, FunctionsPerPatch> here;
      std::array<double, FunctionsPerPatch> there;
      TrilinearValues(local, here);
      TrilinearValues(local + Vec3::Unit(axis), there);
      for (int c = 0; c < FunctionsPerPatch; ++c)
      {
        EXPECT_NEAR(gradient[axis][c], there[c] - here[c], 1e-13);
      }
    }
  }
}

TEST(Trilinear, ChildWeightsWriteParentFunctionsInChildOnes)
{
  const MultiVector points = RandomValues(20, 3);
  for (int octant = 0; octant < 8; ++octant)
  {
    for (Id k = 0; k < points.rows(); ++k)
    {
      const Vec3 inChild = points.row(k).transpose();
      const Vec3 inParent = 0.5 * (inChild + Vec3(octant & 1, (octant >> 1) & 1, octant >> 2));
      std::array<double, FunctionsPerPatch> child;
      std::array<double, FunctionsPerPatch> parent;
      TrilinearValues(inChild, child);
      TrilinearValues(inParent, parent);
      for (int p = 0; p < FunctionsPerPatch; ++p)
      {
        double value = 0.0;
        for (int c = 0; c < FunctionsPerPatch; ++c)
        {
          value += ChildWeights(octant)[c][p] * child[c];
        }
        EXPECT_NEAR(value, parent[p], 1e-14);
      }
    }
  }
}
