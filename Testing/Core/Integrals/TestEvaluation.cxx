// Tests values and surface gradients at points: the function space contains the linear functions in
// space.
#include "Integrals/Evaluation.h"

#include "Integrals/TrilinearBasis.h"
#include "Spaces.h"

#include "Integrals/ElementMatrices.h"
#include "Integrals/QuadratureSamples.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

class EvaluationOnSpaces : public ::testing::TestWithParam<SpaceCase>
{
protected:
  GridFunctions space = GetParam().Build();
  MultiVector coordinates = CoordinateCoefficients(space);
  /// Rounding of world coordinates, from which grid coordinates and spacing are computed.
  double tolerance = 1e-14 * coordinates.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
};

/// Returns the value at a point (in grid units) of a patch of the finest level.
Eigen::RowVectorXd ValueInPatch(
  const GridFunctions& space, Id patch, const Vec3& position, const MultiVector& coefficients)
{
  const PatchLevel& level = space.Finest();
  std::array<double, FunctionsPerPatch> b;
  TrilinearValues(position - CellCorner(level.cell[patch]), b);
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(coefficients.cols());
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    result += b[c] * coefficients.row(level.dof[patch][c]);
  }
  return result;
}

} // namespace

TEST_P(EvaluationOnSpaces, CoordinatesAreReproducedAtTheInputsPoints)
{
  const MultiVector values = EvaluateAtPoints(space, coordinates);
  const MultiVector points = PointCoordinates(GetParam().mesh);
  ASSERT_EQ(values.rows(), points.rows());
  EXPECT_LT((values - points).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), tolerance);
}

TEST_P(EvaluationOnSpaces, CoordinatesAreReproducedAtAllClippedPoints)
{
  const MultiVector values = EvaluateAtClippedPoints(space, coordinates);
  ASSERT_EQ(values.rows(), static_cast<Id>(space.clipped.position.size()));
  for (Id k = 0; k < values.rows(); ++k)
  {
    const Vec3 expected = space.GetGrid().ToWorld(space.clipped.position[k]);
    ASSERT_LT((values.row(k).transpose() - expected).norm(), tolerance);
  }
}

TEST_P(EvaluationOnSpaces, FunctionsAreContinuousAcrossPieces)
{
  // A shared point has a single value for the patches of all its pieces.
  const MultiVector coefficients = RandomValues(space.Finest().numberOfFunctions, 2);
  const MultiVector values = EvaluateAtClippedPoints(space, coefficients);
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    for (Id k = space.clipped.pieceBegin[piece]; k < space.clipped.pieceBegin[piece + 1]; ++k)
    {
      const Id point = space.clipped.corners[k];
      const Eigen::RowVectorXd value =
        ValueInPatch(space, space.piecePatch[piece], space.clipped.position[point], coefficients);
      // Points within the clipper's 1e-10 of a cell face lie on it for both cells.
      ASSERT_LT((values.row(point) - value).norm(), 1e-9);
    }
  }
}

TEST_P(EvaluationOnSpaces, GradientsOfTheCoordinatesSpanTheTangentPlane)
{
  const auto triangles = static_cast<Id>(GetParam().mesh.triangles.size());
  const MultiVector gradients = MeanGradients(space, triangles, coordinates);
  const std::vector<double> area = AreasOfPieces(space, triangles);
  for (Id t = 0; t < triangles; ++t)
  {
    const Eigen::Map<const Eigen::Matrix3d> gradient(gradients.row(t).data());
    if (area[t] == 0.0)
    {
      ASSERT_TRUE(gradient.isZero(0.0));
      continue;
    }
    // The columns of the projection I - n nᵀ, which is idempotent, symmetric and of trace 2.
    // Differences of coordinates are divided by the spacing.
    const double error = 16.0 * tolerance / space.GetGrid().spacing;
    ASSERT_LT((gradient * gradient - gradient).norm(), error);
    ASSERT_LT((gradient - gradient.transpose()).norm(), error);
    ASSERT_NEAR(gradient.trace(), 2.0, error);
  }
}

TEST_P(EvaluationOnSpaces, IsTheSameForAnyNumberOfThreads)
{
  const MultiVector coefficients = RandomValues(space.Finest().numberOfFunctions, 3);
  EXPECT_EQ(EvaluateAtPoints(space, coefficients, 1), EvaluateAtPoints(space, coefficients, 2));
}

INSTANTIATE_TEST_SUITE_P(Spaces, EvaluationOnSpaces, ::testing::ValuesIn(AllSpaces()));

TEST(Evaluation, GivesZeroAtPointsThatNoTriangleUses)
{
  TriangleMesh mesh = Box(2);
  mesh.points.push_back({ 0.5, 0.5, 0.5 });
  const GridFunctions space = BuildGridFunctions(mesh, {});
  const MultiVector ones = MultiVector::Ones(space.Finest().numberOfFunctions, 1);
  const MultiVector values = EvaluateAtPoints(space, ones);
  EXPECT_EQ(values(values.rows() - 1, 0), 0.0);
  EXPECT_NEAR(values.topRows(values.rows() - 1).minCoeff(), 1.0, 1e-15);
}

// A line without area reaches point 6 through a cell that contains nothing else. The line's piece
// there belongs to a patch in another cell.
TEST(Evaluation, TakesTheFunctionsOfPiecesWithAnArea)
{
  TriangleMesh mesh;
  mesh.points = { Vec3(4, 0, 0), Vec3(4, 4, 0.5), Vec3(3.5, 4, 0), Vec3(0, 0.25, 2),
    Vec3(1.5, 0.25, 2), Vec3(1.5, 0.25, 3), Vec3(2.5, 1.75, 3), Vec3(1.5, 1.25, 4),
    Vec3(2.5, 2.25, 4) };
  mesh.triangles = { { 0, 1, 2 }, { 3, 4, 5 }, { 6, 7, 8 }, { 3, 3, 6 } };
  for (const bool connectivityAware : { false, true })
  {
    SpaceOptions options;
    options.depth = 2;
    options.connectivityAware = connectivityAware;
    const GridFunctions space = BuildGridFunctions(mesh, options);
    for (std::size_t point = 0; point < mesh.points.size(); ++point)
    {
      const CellIndex cell = MortonDecode(space.Finest().cell[space.pointPatch[point]]);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_LE(cell[axis], mesh.points[point][axis]) << point;
        EXPECT_GE(cell[axis] + 1, mesh.points[point][axis]) << point;
      }
    }
  }
}

TEST(Evaluation, OfAFunctionOnTheSideOfASquareHasTheHandMadeGradient)
{
  // u = x y on the plane z = 0 has the surface gradient (y, x, 0). The mean is the value at the
  // centroid.
  const TriangleMesh mesh = FlatRectangle(4, 4);
  const GridFunctions space = BuildGridFunctions(mesh, {});
  const MultiVector corner = CoordinateCoefficients(space);
  const MultiVector product = corner.col(0).cwiseProduct(corner.col(1));
  const auto triangles = static_cast<Id>(mesh.triangles.size());
  const MultiVector gradients = MeanGradients(space, triangles, product);
  for (Id t = 0; t < triangles; ++t)
  {
    const auto& [p, q, r] = mesh.triangles[t];
    const Vec3 centroid = (mesh.points[p] + mesh.points[q] + mesh.points[r]) / 3.0;
    const Vec3 gradient = gradients.row(t).transpose();
    EXPECT_LT((gradient - Vec3(centroid[1], centroid[0], 0.0)).norm(), 1e-12);
  }
}

TEST(Evaluation, RefusesCoefficientsOfAnotherSpace)
{
  const GridFunctions space = BuildGridFunctions(Box(2), {});
  EXPECT_THROW(EvaluateAtPoints(space, MultiVector::Ones(5, 1)), InvalidInput);
}
