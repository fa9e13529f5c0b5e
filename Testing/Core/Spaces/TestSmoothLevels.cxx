// Tests the levels of quadratic B-splines: partition of unity, nesting, and their element matrices.
#include "Integrals/CellBasis.h"
#include "Integrals/QuadratureSamples.h"
#include "Largest.h"
#include "Spaces.h"
#include "Spaces/SmoothSpace.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int Functions = SmoothFunctionsPerPatch;
using Matrix = Eigen::Matrix<double, Functions, Functions>;
using Vector = Eigen::Matrix<double, Functions, 1>;
using Gradients = Eigen::Matrix<double, Functions, 3>;

SmoothSpace Build(const SpaceCase& on, Index coarsestSize = 256)
{
  GridSpaceOptions options;
  options.functions = on.options;
  options.coarsestSize = coarsestSize;
  return BuildSmoothSpace(on.mesh, options);
}

Gradients GradientsAt(const Vec3& local)
{
  std::array<SmoothValues, 3> slope;
  BasisGradients(local, slope);
  Gradients gradients;
  for (int axis = 0; axis < 3; ++axis)
  {
    gradients.col(axis) = Eigen::Map<const Vector>(slope[axis].data());
  }
  return gradients;
}

/// Returns the second derivatives along n, as differences of gradients. These are exact, because
/// gradients are linear along their own axis and quadratic along the others.
Vector BendAt(const Vec3& local, const Vec3& n)
{
  Vector bend = Vector::Zero();
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vec3 half = 0.5 * Vec3::Unit(axis);
    bend += n[axis] * (GradientsAt(local + half) - GradientsAt(local - half)) * n;
  }
  return bend;
}

struct PatchMatrices
{
  Matrix mass = Matrix::Zero();
  Matrix stiffness = Matrix::Zero();
};

/// Sums the integrands of a patch at the points of the rules.
PatchMatrices SumSamples(const GridFunctions& grid, Id patch)
{
  PatchMatrices sum;
  const Vec3 origin = CellCorner(grid.Finest().cell[patch]);
  for (Id piece = 0; piece < grid.clipped.NumberOfPieces(); ++piece)
  {
    if (grid.piecePatch[piece] != patch)
    {
      continue;
    }
    const Vec3 normal = UnitNormal(grid.clipped, piece);
    const Eigen::Matrix3d tensor =
      Eigen::Matrix3d::Identity() - (1.0 - SmoothStabilization) * normal * normal.transpose();
    ForEachSample(grid.clipped, piece, origin, TriangleRule(6),
      [&](const Vec3& local, double weight)
      {
        SmoothValues value;
        BasisValues(local, value);
        const Eigen::Map<const Vector> v(value.data());
        const Gradients g = GradientsAt(local);
        sum.mass += weight * v * v.transpose();
        sum.stiffness += weight * g * tensor * g.transpose();
      });
    ForEachSample(grid.clipped, piece, origin, TriangleRule(2),
      [&](const Vec3& local, double weight)
      {
        const Vector bend = BendAt(local, normal);
        sum.stiffness += 0.2 * SmoothStabilization * weight * bend * bend.transpose();
      });
  }
  return sum;
}

Matrix Unpacked(const SmoothElementMatrix& packed)
{
  Matrix matrix;
  for (int i = 0; i < Functions; ++i)
  {
    for (int j = 0; j < Functions; ++j)
    {
      matrix(i, j) = packed[PackedIndex<Functions>(i, j)];
    }
  }
  return matrix;
}

class SmoothLevels : public ::testing::TestWithParam<SpaceCase>
{
};

} // namespace

TEST_P(SmoothLevels, SumToOne)
{
  const SmoothSpace space = Build(GetParam());
  for (const SmoothLevel& level : space.Operators().levels)
  {
    EXPECT_GT(level.numberOfFunctions, 0);
  }
  const MultiVector ones = MultiVector::Ones(space.NumberOfFunctions(0), 1);
  const MultiVector values = space.ValuesAtPoints(ones);
  const std::vector<char> reached = space.PointsWithFunctions();
  for (Id k = 0; k < values.rows(); ++k)
  {
    EXPECT_NEAR(values(k, 0), reached[k] ? 1.0 : 0.0, 1e-12);
  }
}

/// A function of a coarser level has the same values when it is prolonged.
TEST_P(SmoothLevels, AreNested)
{
  const SmoothSpace space = Build(GetParam(), 1);
  const GridFunctions& grid = space.Grid();
  ASSERT_EQ(space.NumberOfLevels(), grid.levels.size());
  const SmoothLevel& finest = space.Operators().levels[0];
  const SmoothLevel& next = space.Operators().levels[1];
  const MultiVector coarse = RandomValues(next.numberOfFunctions, 1);
  MultiVector fine;
  Multiply(space.Prolongation(0), coarse, fine);
  const MultiVector values = space.ValuesAtPoints(fine);
  double error = 0.0;
  for (Id point = 0; point < values.rows(); ++point)
  {
    const Index patch = grid.pointPatch[point];
    if (patch >= 0)
    {
      const Index parent = finest.parent[patch];
      SmoothValues b;
      BasisValues(0.5 * grid.clipped.position[point] - CellCorner(next.cell[parent]), b);
      double sum = 0.0;
      for (int k = 0; k < SmoothFunctionsPerPatch; ++k)
      {
        sum += b[k] * coarse(next.dof[parent][k], 0);
      }
      error = Larger(error, std::abs(sum - values(point, 0)));
    }
  }
  EXPECT_LT(error, 1e-12);
}

TEST_P(SmoothLevels, HaveTheMatricesOfGalerkin)
{
  const SmoothSpace space = Build(GetParam(), 1);
  for (std::size_t l = 0; l + 1 < space.NumberOfLevels() && l < 2; ++l)
  {
    const Eigen::MatrixXd P = Dense(space.Prolongation(l));
    for (const auto& [a, b] : { std::pair{ 1.0, 0.0 }, std::pair{ 0.0, 1.0 } })
    {
      const Eigen::MatrixXd expected = Congruent(Dense(space.Matrix(l, a, b)), P);
      EXPECT_LT(RelativeDifference(Dense(space.Matrix(l + 1, a, b)), expected), 1e-12);
    }
  }
}

TEST_P(SmoothLevels, HaveTheElementsOfTheirIntegrals)
{
  const SmoothSpace space = Build(GetParam());
  const GridFunctions& grid = space.Grid();
  const SmoothElementMatrices elements =
    IntegrateSmoothElements(grid, TriangleRule(6), SmoothStabilization);
  const Id patches = grid.Finest().NumberOfPatches();
  for (Id patch = 0; patch < patches; patch += 1 + patches / 8)
  {
    const PatchMatrices expected = SumSamples(grid, patch);
    EXPECT_LT(RelativeDifference(Unpacked(elements.mass[patch]), expected.mass), 1e-12) << patch;
    EXPECT_LT(RelativeDifference(Unpacked(elements.stiffness[patch]), expected.stiffness), 1e-12)
      << patch;
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SmoothLevels, ::testing::ValuesIn(AllSpaces(3)));
