// Compares integrals in another metric with the mesh's own metric and with sums over samples that
// use a pseudo-inverse in space. Other tests check properties that hold on any surface.
#include "Integrals/SurfaceMetric.h"

#include "Base/Errors.h"
#include "Discretization.h"
#include "ElementSums.h"
#include "Integrals/QuadratureSamples.h"
#include "Spaces.h"
#include "Spaces/LevelOperators.h"

#include <Eigen/SVD>
#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

MultiVector Mapped(const MultiVector& coordinates, const Eigen::Matrix3d& map)
{
  return coordinates * map.transpose();
}

struct Integrals
{
  ElementMatrices elements;
  Id singular;
};

Integrals IntegrateEmbedding(
  const GridFunctions& space, const MultiVector& embedding, int degree = 2, int threads = 0)
{
  const QuadratureRule& rule = TriangleRule(degree);
  Integrals result;
  result.singular = IntegrateElements(
    space, rule, MetricOfEmbedding(space, rule, embedding, threads), result.elements, threads);
  return result;
}

void ExpectNear(const Array<ElementMatrix>& a, const Array<ElementMatrix>& b, double tolerance)
{
  EXPECT_LE(LargestDifference(a, b), tolerance * LargestEntry(b));
}

Array<ElementMatrix> Scaled(double factor, Array<ElementMatrix> matrices)
{
  for (ElementMatrix& matrix : matrices)
  {
    for (double& entry : matrix)
    {
      entry *= factor;
    }
  }
  return matrices;
}

/// Computes element matrices with everything in space: the metric restricted to the tangent plane,
/// and its pseudo-inverse from the singular values of dX (I - n nᵀ).
ElementMatrices IntegrateInSpace(const GridFunctions& space, const MultiVector& embedding)
{
  const PatchLevel& level = space.Finest();
  ElementMatrices sums;
  sums.mass.assign(level.NumberOfPatches(), ElementMatrix{});
  sums.stiffness = sums.mass;
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    const Id patch = space.piecePatch[piece];
    const Vec3 n = UnitNormal(space.clipped, piece);
    const Eigen::Matrix3d tangential = Eigen::Matrix3d::Identity() - n * n.transpose();
    ForEachSample(space.clipped, piece, CellCorner(level.cell[patch]), TriangleRule(2),
      [&](const Vec3& local, double area)
      {
        std::array<double, FunctionsPerPatch> value;
        TrilinearValues(local, value);
        const std::array<Vec3, FunctionsPerPatch> gradient = TrilinearGradientsAt(local);
        Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
        for (int c = 0; c < FunctionsPerPatch; ++c)
        {
          slope += embedding.row(level.dof[patch][c]).transpose() * gradient[c].transpose();
        }
        const Eigen::JacobiSVD<Eigen::Matrix3d> svd(slope * tangential, Eigen::ComputeFullV);
        const Vec3 sigma = svd.singularValues();
        const Eigen::Matrix3d V = svd.matrixV();
        const Eigen::Matrix3d inverse = V.col(0) * V.col(0).transpose() / (sigma[0] * sigma[0]) +
                                        V.col(1) * V.col(1).transpose() / (sigma[1] * sigma[1]);
        const double weight = area * sigma[0] * sigma[1];
        for (int i = 0; i < FunctionsPerPatch; ++i)
        {
          for (int j = i; j < FunctionsPerPatch; ++j)
          {
            sums.mass[patch][PackedIndex(i, j)] += weight * value[i] * value[j];
            sums.stiffness[patch][PackedIndex(i, j)] +=
              weight * gradient[i].dot(inverse * gradient[j]);
          }
        }
      });
  }
  return sums;
}

class MetricOfSpaces : public ::testing::TestWithParam<SpaceCase>
{
};

} // namespace

TEST_P(MetricOfSpaces, OfTheIdentityIsTheMeshsOwn)
{
  const GridFunctions space = GetParam().Build();
  const ElementMatrices own = IntegrateElements(space, TriangleRule(4));
  const Integrals identity = IntegrateEmbedding(space, GridCoordinates(space), 4);
  ExpectNear(identity.elements.mass, own.mass, 1e-12);
  ExpectNear(identity.elements.stiffness, own.stiffness, 1e-12);
  EXPECT_EQ(identity.singular, 0);
}

TEST_P(MetricOfSpaces, ScalesMassByTheSquareAndStiffnessNot)
{
  const GridFunctions space = GetParam().Build();
  const ElementMatrices own = IntegrateElements(space, TriangleRule(2));
  const Integrals scaled = IntegrateEmbedding(space, 3.0 * GridCoordinates(space));
  ExpectNear(scaled.elements.mass, Scaled(9.0, own.mass), 1e-12);
  ExpectNear(scaled.elements.stiffness, own.stiffness, 1e-12);
}

TEST_P(MetricOfSpaces, DoesNotChangeUnderRotation)
{
  const GridFunctions space = GetParam().Build();
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const ElementMatrices own = IntegrateElements(space, TriangleRule(2));
  const Integrals turned = IntegrateEmbedding(space, Mapped(GridCoordinates(space), turn));
  ExpectNear(turned.elements.mass, own.mass, 1e-12);
  ExpectNear(turned.elements.stiffness, own.stiffness, 1e-12);
}

/// 1ᵀ M 1 is the area of the mapped surface. The energy of its own coordinates is twice the area.
TEST_P(MetricOfSpaces, HasTheAreaAndTheEnergyOfALinearImage)
{
  SpaceCase mapped = GetParam();
  const GridFunctions space = mapped.Build();
  Eigen::Matrix3d map;
  map << 1.5, 0.2, 0.0, 0.1, 0.7, 0.3, -0.2, 0.0, 1.1;
  const MultiVector embedding = Mapped(GridCoordinates(space), map);
  for (Vec3& point : mapped.mesh.points)
  {
    point = map * space.GetGrid().ToGrid(point);
  }
  const double area = SurfaceArea(mapped.mesh);
  const Integrals image = IntegrateEmbedding(space, embedding);
  const MultiVector ones = MultiVector::Ones(space.Finest().numberOfFunctions, 1);
  // Coordinates are rounded to 2^-52 of the distance from the origin: up to 1e-13 of a cell.
  EXPECT_NEAR(Energy(space, image.elements.mass, ones), area, 1e-10 * area);
  EXPECT_NEAR(Energy(space, image.elements.stiffness, embedding), 2.0 * area, 1e-10 * area);
}

TEST_P(MetricOfSpaces, AgreesWithSumsInSpaceForABentSurface)
{
  const GridFunctions space = GetParam().Build();
  const MultiVector embedding =
    GridCoordinates(space) + 0.1 * RandomValues(space.Finest().numberOfFunctions, 3);
  const Integrals bent = IntegrateEmbedding(space, embedding);
  const ElementMatrices reference = IntegrateInSpace(space, embedding);
  EXPECT_EQ(bent.singular, 0);
  // The reference does not contain the normal's weight of 1e-12.
  ExpectNear(bent.elements.mass, reference.mass, 1e-11);
  ExpectNear(bent.elements.stiffness, reference.stiffness, 1e-11);
}

TEST_P(MetricOfSpaces, IsTheSameBitsForAnyNumberOfThreads)
{
  const GridFunctions space = GetParam().Build();
  const MultiVector embedding =
    GridCoordinates(space) + 0.1 * RandomValues(space.Finest().numberOfFunctions, 3);
  const Integrals one = IntegrateEmbedding(space, embedding, 2, 1);
  const Integrals two = IntegrateEmbedding(space, embedding, 2, 2);
  EXPECT_EQ(one.elements.mass, two.elements.mass);
  EXPECT_EQ(one.elements.stiffness, two.elements.stiffness);
}

INSTANTIATE_TEST_SUITE_P(Spaces, MetricOfSpaces, ::testing::ValuesIn(AllSpaces(3)));

TEST(SurfaceMetric, SingularSamplesContributeNothingAndAreCounted)
{
  const GridFunctions space = BuildGridFunctions(GeodesicSphere(6), { { 3 } });
  MultiVector line = GridCoordinates(space);
  line.rightCols(2).setZero();
  const Integrals collapsed = IntegrateEmbedding(space, line);
  Id samples = 0;
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    ForEachSample(
      space.clipped, piece, Vec3::Zero(), TriangleRule(2), [&](const Vec3&, double) { ++samples; });
  }
  EXPECT_EQ(collapsed.singular, samples);
  EXPECT_EQ(LargestEntry(collapsed.elements.mass), 0.0);
  EXPECT_EQ(LargestEntry(collapsed.elements.stiffness), 0.0);
}

TEST(SurfaceMetric, OneBadSampleIsLeftOut)
{
  const GridFunctions space = BuildGridFunctions(GeodesicSphere(6), { { 3 } });
  const QuadratureRule& rule = TriangleRule(2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const FundamentalForm& bad :
    { FundamentalForm{ nan, 0, 1 }, FundamentalForm{ 1, nan, 1 }, FundamentalForm{ 1, 0, infinity },
      FundamentalForm{ -1, 0, -1 }, FundamentalForm{ 1, 2, 1 }, FundamentalForm{ 0, 0, 0 },
      FundamentalForm{ 1e-160, 0, 1e-160 }, FundamentalForm{ 1e160, 0, 1e160 } })
  {
    SampleMetric metric(NumberOfSamples(space.clipped, rule), { 1, 0, 1 });
    metric[7] = bad;
    ElementMatrices elements;
    EXPECT_EQ(IntegrateElements(space, rule, metric, elements), 1);
    EXPECT_TRUE(std::isfinite(LargestEntry(elements.mass)));
    EXPECT_TRUE(std::isfinite(LargestEntry(elements.stiffness)));
    EXPECT_GT(LargestEntry(elements.stiffness), 0.0);
  }
}

/// Near the smallest and the largest determinant, square roots keep all digits.
TEST(SurfaceMetric, TinyAndHugeMetricsScaleAreas)
{
  const GridFunctions space = BuildGridFunctions(GeodesicSphere(6), { { 3 } });
  const QuadratureRule& rule = TriangleRule(2);
  const ElementMatrices own = IntegrateElements(space, rule);
  for (const double scale : { 1e-149, 1e149 })
  {
    const SampleMetric metric(NumberOfSamples(space.clipped, rule), { scale, 0, scale });
    ElementMatrices elements;
    EXPECT_EQ(IntegrateElements(space, rule, metric, elements), 0);
    ExpectNear(elements.mass, Scaled(scale, own.mass), 1e-12);
    ExpectNear(elements.stiffness, own.stiffness, 1e-12);
  }
}

TEST(SurfaceMetric, RefusesTheWrongNumbers)
{
  const GridFunctions space = BuildGridFunctions(GeodesicSphere(4), { { 3 } });
  const QuadratureRule& rule = TriangleRule(2);
  ElementMatrices elements;
  EXPECT_THROW(
    IntegrateElements(space, rule, SampleMetric(5, { 1, 0, 1 }), elements), InvalidInput);
  EXPECT_THROW(MetricOfEmbedding(space, rule, MultiVector::Ones(3, 3)), InvalidInput);
  EXPECT_THROW(
    MetricOfEmbedding(space, rule, MultiVector::Ones(space.Finest().numberOfFunctions, 2)),
    InvalidInput);
}

/// Twice the lengths give four times the mass, all powers of two. The updated hierarchy therefore
/// has the same bits as one built with a quarter of the weight.
TEST(SurfaceMetric, AnUpdatedHierarchyEqualsANewOne)
{
  const GridFunctions space = BuildGridFunctions(Torus(40, 20, 1.0, 0.4), { { 5 } });
  const QuadratureRule& rule = TriangleRule(2);
  LevelOperators system = BuildLevelOperators(space, rule);
  const std::vector<double> integral = system.integral;
  const double lambda = 0.125;
  MultigridOptions options;
  Multigrid updated = BuildMultigrid(ViewOf(space, system), lambda, 1.0, options);
  const SampleMetric own(NumberOfSamples(space.clipped, rule), { 1, 0, 1 });
  const SampleMetric twice(NumberOfSamples(space.clipped, rule), { 4, 0, 4 });

  IntegrateElements(space, rule, own, system.elements.front());
  UpdateOperators(space, system);
  const Multigrid fresh = BuildMultigrid(ViewOf(space, system), lambda, 1.0, options);
  IntegrateElements(space, rule, twice, system.elements.front());
  UpdateOperators(space, system);
  UpdateMultigrid(ViewOf(space, system), 0.25 * lambda, 1.0, updated);

  const MultiVector b = RandomValues(space.Finest().numberOfFunctions, 2);
  MultiVector x;
  MultiVector y;
  updated.Precondition(b, x);
  fresh.Precondition(b, y);
  EXPECT_EQ(x, y);
  for (std::size_t i = 0; i < integral.size(); ++i)
  {
    EXPECT_NEAR(system.integral[i], 4.0 * integral[i], 1e-12);
  }
}
