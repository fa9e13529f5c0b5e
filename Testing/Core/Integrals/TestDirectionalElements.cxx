// Tests element matrices split by direction. The parts add up, each part depends only on its own
// derivative, and weights give the same result as the metric that they represent.
#include "Integrals/DirectionalElements.h"

#include "Base/Errors.h"
#include "ElementSums.h"
#include "Integrals/SurfaceMetric.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Returns random directions. Some are zero, some are normal to the surface.
std::vector<Vec3> RandomDirections(const TriangleMesh& mesh)
{
  const MultiVector values = RandomValues(static_cast<Id>(mesh.triangles.size()), 3);
  std::vector<Vec3> directions;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 normal =
      (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).eval();
    const Vec3 random = 1e3 * values.row(static_cast<Id>(t)).transpose();
    directions.push_back(t % 7 == 0 ? Vec3(Vec3::Zero()) : t % 7 == 1 ? normal : random);
  }
  return directions;
}

/// A tilted rectangle of 2 x 1, with the directions of its sides.
struct TiltedRectangle
{
  Eigen::Matrix3d turn = Eigen::AngleAxisd(0.6, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  TriangleMesh mesh = Transform(FlatRectangle(9, 5, 2.0, 1.0), Vec3(1, 2, -1), 0.6);
  GridFunctions space = BuildGridFunctions(mesh, { { 4 } });
  Vec3 along = turn.col(0);
  Vec3 across = turn.col(1);
  DirectionalElements elements = IntegrateElements(
    space, TriangleRule(2), std::vector<Vec3>(mesh.triangles.size(), 5.0 * along));

  /// Returns the coefficients of the distance along a direction.
  MultiVector Distance(const Vec3& direction) const
  {
    return CoordinateCoefficients(space) * direction;
  }
};

class DirectionsOfSpaces : public ::testing::TestWithParam<SpaceCase>
{
};

} // namespace

TEST_P(DirectionsOfSpaces, AddUpToTheStiffness)
{
  const GridFunctions space = GetParam().Build();
  const ElementMatrices whole = IntegrateElements(space, TriangleRule(2));
  const DirectionalElements parts =
    IntegrateElements(space, TriangleRule(2), RandomDirections(GetParam().mesh));
  ElementMatrices sum;
  Weigh(parts, std::vector<ElementWeights>(whole.mass.size()), sum);
  EXPECT_LE(LargestDifference(sum.mass, whole.mass), 1e-14);
  EXPECT_LE(LargestDifference(sum.stiffness, whole.stiffness), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Spaces, DirectionsOfSpaces, ::testing::ValuesIn(AllSpaces(3)));

TEST(DirectionalElements, SeeTheSlopeAlongTheirDirectionOnly)
{
  const TiltedRectangle rectangle;
  const GridFunctions& space = rectangle.space;
  const auto& stiffness = rectangle.elements.stiffness;
  const double area = 2.0;
  EXPECT_NEAR(Energy(space, stiffness[0], rectangle.Distance(rectangle.along)), area, 1e-10);
  EXPECT_NEAR(Energy(space, stiffness[1], rectangle.Distance(rectangle.along)), 0.0, 1e-10);
  EXPECT_NEAR(Energy(space, stiffness[0], rectangle.Distance(rectangle.across)), 0.0, 1e-10);
  EXPECT_NEAR(Energy(space, stiffness[1], rectangle.Distance(rectangle.across)), area, 1e-10);
}

/// Compares two ways: weights of the metric diag(α₁², α₂²), and the metric of the stretched
/// rectangle at samples.
TEST(DirectionalElements, WeightsAreTheMetricTheyStandFor)
{
  const TiltedRectangle rectangle;
  const double alpha1 = 3.0;
  const double alpha2 = 0.25;
  const double spacing = rectangle.space.GetGrid().spacing;
  const Eigen::Matrix3d stretch =
    rectangle.turn * Vec3(alpha1, alpha2, 1.0).asDiagonal() * rectangle.turn.transpose();
  const MultiVector embedding =
    CoordinateCoefficients(rectangle.space) * stretch.transpose() / spacing;
  ElementMatrices stretched;
  IntegrateElements(rectangle.space, TriangleRule(2),
    MetricOfEmbedding(rectangle.space, TriangleRule(2), embedding), stretched);

  const ElementWeights weights{ alpha1 * alpha2, { alpha2 / alpha1, alpha1 / alpha2 } };
  ElementMatrices weighted;
  Weigh(rectangle.elements, std::vector<ElementWeights>(rectangle.elements.mass.size(), weights),
    weighted);
  EXPECT_LE(LargestDifference(weighted.mass, stretched.mass), 1e-12);
  // The normal's weight of 1e-12 is stretched like the directions in one way, but not in the other.
  EXPECT_LE(LargestDifference(weighted.stiffness, stretched.stiffness), 1e-10);
}

TEST(DirectionalElements, EachPatchHasItsOwnWeights)
{
  const TiltedRectangle rectangle;
  const auto& elements = rectangle.elements;
  std::vector<ElementWeights> weights(elements.mass.size(), { 0.0, { 0.0, 0.0 } });
  weights[3] = { 2.0, { 3.0, 5.0 } };
  ElementMatrices weighted;
  Weigh(elements, weights, weighted);
  for (std::size_t patch = 0; patch < weights.size(); ++patch)
  {
    const auto& [mass, stiffness] = weights[patch];
    for (int k = 0; k < ElementEntries; ++k)
    {
      EXPECT_EQ(weighted.mass[patch][k], mass * elements.mass[patch][k]);
      EXPECT_DOUBLE_EQ(
        weighted.stiffness[patch][k], stiffness[0] * elements.stiffness[0][patch][k] +
                                        stiffness[1] * elements.stiffness[1][patch][k]);
    }
  }
}

TEST(DirectionalElements, RefuseWhatDoesNotFit)
{
  const TiltedRectangle rectangle;
  EXPECT_THROW(
    IntegrateElements(rectangle.space, TriangleRule(2), std::vector<Vec3>(3)), InvalidInput);
  ElementMatrices weighted;
  std::vector<ElementWeights> weights(rectangle.elements.mass.size() - 1);
  EXPECT_THROW(Weigh(rectangle.elements, weights, weighted), InvalidInput);
  for (const double bad :
    { -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    weights.assign(rectangle.elements.mass.size(), {});
    weights.back().stiffness[1] = bad;
    EXPECT_THROW(Weigh(rectangle.elements, weights, weighted), InvalidInput);
  }
}
