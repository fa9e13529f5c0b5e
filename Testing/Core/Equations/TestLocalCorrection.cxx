// Values that are made harmonic on the mesh.
#include "Equations/LocalCorrection.h"

#include "Largest.h"
#include "Meshes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

/// Two sides of a square are given, so the harmonic function is linear between them. The mesh has
/// far more edges from side to side than sweeps over the values could bridge. Small weights across
/// diagonals make it differ a little.
TEST(LocalCorrection, IsHarmonicOnFineMeshes)
{
  const TriangleMesh mesh = FlatRectangle(150, 150);
  std::vector<Id> points;
  for (Id point = 0; point < static_cast<Id>(mesh.points.size()); ++point)
  {
    const double x = mesh.points[point][0];
    if (x < 1e-9 || x > 1.0 - 1e-9)
    {
      points.push_back(point);
    }
  }
  MultiVector values(static_cast<Id>(points.size()), 2);
  for (Id row = 0; row < values.rows(); ++row)
  {
    const double x = std::round(mesh.points[points[row]][0]);
    values.row(row) << x, 3.0 - 2.0 * x;
  }
  const LocalCorrection correction(mesh, true, points, values);
  MultiVector atPoints = MultiVector::Constant(static_cast<Id>(mesh.points.size()), 2, 7.0);
  correction.Apply(2.0, atPoints);
  double error = 0.0;
  for (Id point = 0; point < atPoints.rows(); ++point)
  {
    const double x = mesh.points[point][0];
    error = Larger(error, std::abs(atPoints(point, 0) - x));
    error = Larger(error, std::abs(atPoints(point, 1) - (3.0 - 2.0 * x)));
  }
  EXPECT_LT(error, 0.005);
}

/// Nothing is given around the values within reach of one that is off: they stay in the range. A
/// point without a value has none afterwards.
TEST(LocalCorrection, KeepsValuesWithoutAnythingGivenAround)
{
  TriangleMesh mesh =
    Join(FlatRectangle(6, 6), Transform(FlatRectangle(6, 6), { 0, 0, 1 }, 0.0, 1.0, { 5, 0, 0 }));
  MultiVector values(2, 1);
  values << 1.0, 2.0;
  const LocalCorrection correction(mesh, true, { 0, 3 }, values);
  MultiVector atPoints = MultiVector::Constant(static_cast<Id>(mesh.points.size()), 1, 9.0);
  atPoints(30, 0) = std::nan("");
  correction.Apply(20.0, atPoints);
  EXPECT_TRUE(std::isnan(atPoints(30, 0)));
  for (Id point = 0; point < atPoints.rows(); ++point)
  {
    EXPECT_TRUE(point == 30 || (atPoints(point, 0) >= 1.0 && atPoints(point, 0) <= 2.0)) << point;
  }
  EXPECT_EQ(atPoints(0, 0), 1.0);
  EXPECT_EQ(atPoints(3, 0), 2.0);
}
