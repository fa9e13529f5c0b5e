// Fields with some unknown values, against sums over the triangles.
#include "Equations/PartialField.h"

#include "Base/Errors.h"
#include "EitherSpace.h"
#include "Grid/TriangleArea.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

/// Three spheres: the first is known, the second in part, the third is unknown.
TriangleMesh Spheres()
{
  const TriangleMesh sphere = GeodesicSphere(12);
  const auto moved = [&](double x) {
    return Transform(sphere, { 1, 2, 3 }, 0.3, 1.0, { x, 0, 0 });
  };
  return Join(Join(sphere, moved(3.0)), moved(6.0));
}

/// Two columns; an unknown value in one makes the row unknown. Islands of known points have no
/// known triangle.
Field PartlyKnown(const TriangleMesh& mesh)
{
  Field f{ FieldAssociation::Points, PointCoordinates(mesh).leftCols(2) };
  for (Id k = 0; k < f.values.rows(); ++k)
  {
    const Vec3& p = mesh.points[k];
    if (p[0] > 4.5 || (p[0] > 3.0 && std::sin(37.0 * p[0] + 53.0 * p[1] + 71.0 * p[2]) < 0.5))
    {
      f.values(k, k % 2) = Unknown;
    }
  }
  return f;
}

Field Weights(const TriangleMesh& mesh)
{
  return { FieldAssociation::Points, PointCoordinates(mesh).col(2).cwiseAbs() };
}

} // namespace

TEST(PartialField, KnowsTheTrianglesWhoseCornersAre)
{
  const TriangleMesh mesh = Spheres();
  const Field f = PartlyKnown(mesh);
  const Field weight = Weights(mesh);
  const PartialField split = SplitField(f, &weight, mesh);
  const Field scale = ScaleOfKnown(split, &weight, mesh);
  EXPECT_TRUE(split.values.values.allFinite());
  Id known = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    double mean = 0.0;
    bool isKnown = true;
    for (const Id point : mesh.triangles[t])
    {
      isKnown = isKnown && f.values.row(point).allFinite();
      mean += weight.values(point, 0) / 3.0;
    }
    known += isKnown;
    ASSERT_EQ(split.isKnown[t] != 0, isKnown);
    ASSERT_NEAR(split.weight[t], isKnown ? mean : 0.0, 1e-15);
    ASSERT_NEAR(scale.values(static_cast<Id>(t), 0), split.weight[t], 1e-15);
  }
  EXPECT_GT(known, Id(mesh.triangles.size()) / 3);
  EXPECT_LT(known, Id(mesh.triangles.size()) / 2);
  for (Id k = 0; k < f.values.rows(); ++k)
  {
    ASSERT_EQ(split.hasValue[k] != 0, f.values.row(k).allFinite());
    const MultiVector none = MultiVector::Zero(1, 2);
    const MultiVector expected = split.hasValue[k] ? MultiVector(f.values.row(k)) : none;
    ASSERT_EQ(MultiVector(split.values.values.row(k)), expected);
  }
}

TEST(PartialField, CountsKnownPointsWithoutAKnownTriangle)
{
  const TriangleMesh mesh = Spheres();
  PartialField split = SplitField(PartlyKnown(mesh), nullptr, mesh);
  std::vector<char> counts(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const Id point : mesh.triangles[t])
    {
      counts[point] |= split.isKnown[t];
    }
  }
  Id ignored = 0;
  for (std::size_t k = 0; k < counts.size(); ++k)
  {
    ignored += split.hasValue[k] && !counts[k];
  }
  const auto space = BuildEither(mesh, false, 4, 1e-2);
  EXPECT_GT(ignored, 10);
  EXPECT_EQ(CountIgnoredPoints(*space, split, mesh), ignored);
  split.values.association = FieldAssociation::Triangles; // each triangle counts by itself
  EXPECT_EQ(CountIgnoredPoints(*space, split, mesh), 0);
}

/// Values are linear on triangles, so their means are known. Weights do not count.
TEST(PartialField, HasTheMeansOfWhatIsKnownOnEachComponent)
{
  const TriangleMesh mesh = Spheres();
  const Field weight = Weights(mesh);
  const PartialField split = SplitField(PartlyKnown(mesh), &weight, mesh);
  for (const bool isOnHats : { false, true })
  {
    const auto space = BuildEither(mesh, isOnHats, 4, 1e-2);
    MultiVector means = MeansOfKnown(*space, split);
    ASSERT_EQ(means.rows(), 3);
    Id found = 0;
    for (const double x : { 0.0, 3.0, 6.0 })
    {
      Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
      double area = 0.0;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      {
        const auto& corner = mesh.triangles[t];
        if (split.isKnown[t] && std::abs(mesh.points[corner[0]][0] - x) < 1.2)
        {
          const double part = AreaOf(mesh, static_cast<Id>(t));
          area += part;
          for (const Id point : corner)
          {
            sum += part / 3.0 * split.values.values.row(point);
          }
        }
      }
      for (Id c = 0; c < means.rows(); ++c) // components in any order
      {
        found += area > 0.0 ? (means.row(c) - sum / area).norm() < 1e-12 : means.row(c).hasNaN();
      }
    }
    EXPECT_EQ(found, 3) << means;
  }
}

TEST(PartialField, RefusesWeightsThatAreNone)
{
  const TriangleMesh mesh = Box(3);
  const Field f{ FieldAssociation::Points, PointCoordinates(mesh) };
  Field weight = Weights(mesh);
  for (const double wrong : { -1.0, Unknown, std::numeric_limits<double>::infinity() })
  {
    weight.values(5, 0) = wrong;
    EXPECT_THROW(SplitField(f, &weight, mesh), InvalidInput) << wrong;
  }
  weight.values.resize(3, 1);
  EXPECT_THROW(SplitField(f, &weight, mesh), InvalidInput);
}
