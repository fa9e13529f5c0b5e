// Detail against dense solutions of the equation, and its invariants, on both kinds of space.
#include "Shape/SurfaceDetail.h"

#include "Base/Errors.h"
#include "EitherSpace.h"
#include "Shape/MovedSurface.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Lambda = 0.05; // per squared cell

/// A space and the curvatures of its mesh.
struct DetailCase
{
  DetailCase(const TriangleMesh& inputMesh, bool isOnHats) : mesh(inputMesh)
  {
    GridSpaceOptions options;
    options.functions.depth = 4;
    options.coarsestSize = 32;
    options.normalStabilization = 1e-2;
    space = BuildEither(mesh, isOnHats, options);
    const HatFunctions around = NumberHatFunctions(mesh);
    curvatures =
      CurvaturesOnTriangles(mesh, ComputeCurvatures(mesh, around, PointNormals(mesh, around)));
  }

  std::unique_ptr<FiniteElementSpace> Weighted(const TransferFunction& alpha) const
  {
    auto weighted = space->Copy();
    weighted->SplitStiffness(curvatures.direction);
    weighted->Weigh(WeightsOfMetric(space->MeansOnElements(curvatures.values), alpha));
    return weighted;
  }

  TriangleMesh mesh;
  std::unique_ptr<FiniteElementSpace> space;
  TriangleCurvatures curvatures;
};

/// Solves for the change of the shape.
PoissonSolution Solve(const FiniteElementSpace& space, const std::vector<double>& scaleLessOne)
{
  PoissonOptions options;
  options.screeningWeight = Lambda;
  options.solve.tolerance = 1e-11;
  options.solve.maximumIterations = 200;
  const MultiVector load = space.StiffnessTimes(ShapeInSpace(space).coefficients, scaleLessOne);
  return SolvePoisson(space, BuildMultigrid(space, Lambda, 1.0, options.multigrid),
    MultiVector::Zero(load.rows(), load.cols()), load, options);
}

Id NumberOfElements(const DetailCase& on)
{
  return on.space->MeansOnElements(on.curvatures.values).rows();
}

PoissonSolution Solve(const DetailCase& on, const FiniteElementSpace& space, double scale)
{
  return Solve(space, std::vector<double>(NumberOfElements(on), scale - 1.0));
}

double DirichletEnergy(const FiniteElementSpace& space, const MultiVector& u)
{
  return u.cwiseProduct(space.StiffnessTimes(u, {})).sum();
}

double LengthsOfCurvature(double curvature)
{
  return 1.0 + 3.0 * std::abs(std::tanh(curvature));
}

std::vector<TriangleMesh> Meshes()
{
  return { Torus(40, 16, 1.0, 0.3), Transform(GeodesicSphere(8), { 1, 2, 3 }, 0.4, 5.0),
    Transform(FlatRectangle(12, 8, 2.0, 1.0), { 1, 2, -1 }, 0.6),
    Unweld(Transform(Box(5), { 1, 1, 1 }, 0.3)) };
}

class SurfaceDetail : public ::testing::TestWithParam<bool>
{
};

} // namespace

TEST_P(SurfaceDetail, SolvesTheEquation)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const DetailCase on(mesh, GetParam());
    const auto space = on.Weighted(LengthsOfCurvature);
    const MultiVector random = RandomValues(NumberOfElements(on), 1);
    const std::vector<double> scale(random.data(), random.data() + random.size());
    const PoissonSolution change = Solve(*space, scale);
    ASSERT_TRUE(change.report.converged);
    // Another way to the same solution: (λM + L) u = λ M f + L σ f.
    const MultiVector f = ShapeInSpace(*space).coefficients;
    const MultiVector u = f + change.coefficients;
    std::vector<double> sigma = scale;
    for (double& s : sigma)
    {
      s += 1.0;
    }
    const MultiVector right = space->StiffnessTimes(f, sigma);
    const MultiVector residual = Lambda * Dense(space->Matrix(0, 1.0, 0.0)) * change.coefficients +
                                 space->StiffnessTimes(u, {}) - right;
    EXPECT_LE(residual.norm(), 1e-8 * right.norm());
  }
}

TEST_P(SurfaceDetail, OfScaleOneIsTheInputForEveryMetric)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const DetailCase on(mesh, GetParam());
    for (const double power : { 0.0, 1.0, -1.0 })
    {
      const auto space =
        on.Weighted([=](double k) { return std::pow(LengthsOfCurvature(k), power); });
      EXPECT_TRUE(Solve(on, *space, 1.0).coefficients.isZero(0.0));
    }
  }
}

TEST_P(SurfaceDetail, LowersTheDirichletEnergyBelowOneAndRaisesItAbove)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const DetailCase on(mesh, GetParam());
    for (const bool isWeighted : { false, true })
    {
      const auto space = isWeighted ? on.Weighted(LengthsOfCurvature) : on.space->Copy();
      const MultiVector f = ShapeInSpace(*space).coefficients;
      double last = 0.0;
      for (const double scale : { 0.0, 0.5, 1.0, 1.5, 3.0 })
      {
        const double energy = DirichletEnergy(*space, f + Solve(on, *space, scale).coefficients);
        EXPECT_GT(energy, last) << scale;
        last = energy;
      }
    }
  }
}

TEST_P(SurfaceDetail, OfConstantLengthsScalesTheMassOnly)
{
  const DetailCase on(Torus(40, 16, 1.0, 0.3), GetParam());
  for (const double length : { 1.0, 2.5 })
  {
    const auto space = on.Weighted([=](double) { return length; });
    const SparseMatrix M = space->Matrix(0, 1.0, 0.0);
    const SparseMatrix L = space->Matrix(0, 0.0, 1.0);
    EXPECT_LE(
      RelativeDifference(Dense(M), length * length * Dense(on.space->Matrix(0, 1.0, 0.0))), 1e-13);
    EXPECT_LE(RelativeDifference(Dense(L), Dense(on.space->Matrix(0, 0.0, 1.0))), 1e-13);
  }
}

/// On a sphere both curvatures are the same, so no direction matters.
TEST_P(SurfaceDetail, DoesNotSeeDirectionsAtUmbilics)
{
  DetailCase on(GeodesicSphere(8), GetParam());
  on.curvatures.values.setConstant(1.0);
  const MultiVector change = Solve(on, *on.Weighted(LengthsOfCurvature), 2.0).coefficients;
  for (Vec3& direction : on.curvatures.direction)
  {
    direction = Vec3(direction[1] + 0.3, -direction[0], 0.1);
  }
  const MultiVector other = Solve(on, *on.Weighted(LengthsOfCurvature), 2.0).coefficients;
  EXPECT_LE(RelativeDifference(other, change), 1e-9);
}

TEST_P(SurfaceDetail, ProjectsAnArrayAndKeepsWhatNoFunctionHas)
{
  const DetailCase on(Torus(80, 32, 1.0, 0.3), GetParam());
  const Field f{ FieldAssociation::Points,
    RandomValues(static_cast<Id>(on.mesh.points.size()), 2) };
  SolveOptions solve;
  solve.maximumIterations = 200;
  const SignalInSpace signal = ProjectSignal(*on.space, f, {}, solve);
  EXPECT_TRUE(signal.report.converged);
  const MultiVector sum = on.space->ValuesAtPoints(signal.coefficients) + signal.remainder;
  EXPECT_LE((sum - f.values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-13);

  const Field smooth{ FieldAssociation::Points, PointCoordinates(on.mesh) };
  const SignalInSpace shape = ProjectSignal(*on.space, smooth, {}, solve);
  // A tenth of a squared cell times the curvature of the tube.
  const double cell = on.space->UnitLength();
  EXPECT_LE(shape.remainder.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 0.1 * cell * cell / 0.3);
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, SurfaceDetail, ::testing::Bool());

TEST(TriangleCurvatures, OfATorus)
{
  const TriangleMesh mesh = Torus(120, 60, 1.0, 0.25);
  const HatFunctions around = NumberHatFunctions(mesh);
  const TriangleCurvatures curvatures =
    CurvaturesOnTriangles(mesh, ComputeCurvatures(mesh, around, PointNormals(mesh, around)));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto row = static_cast<Id>(t);
    EXPECT_NEAR(curvatures.values(row, 0), 4.0, 0.04);
    const Vec3 p = mesh.points[mesh.triangles[t][0]];
    const Vec3 alongTheRing = Vec3(-p[1], p[0], 0.0).normalized();
    EXPECT_NEAR(curvatures.direction[t].normalized().dot(alongTheRing), 0.0, 0.06);
  }
  EXPECT_NEAR(UsualCurvature(mesh, curvatures), 4.0, 0.04);
}

TEST(TriangleCurvatures, OfAPlaneHaveNoSize)
{
  const TriangleMesh mesh = FlatRectangle(4, 4);
  const HatFunctions around = NumberHatFunctions(mesh);
  const TriangleCurvatures curvatures =
    CurvaturesOnTriangles(mesh, ComputeCurvatures(mesh, around, PointNormals(mesh, around)));
  EXPECT_EQ(UsualCurvature(mesh, curvatures), 0.0);
}

TEST(WeightsOfMetric, AreThoseOfTheThesis)
{
  MultiVector curvatures(1, 2);
  curvatures << 3.0, -1.0;
  const std::vector<ElementWeights> weights =
    WeightsOfMetric(curvatures, [](double k) { return k > 0.0 ? 4.0 : 0.5; });
  EXPECT_DOUBLE_EQ(weights[0].mass, 2.0);
  EXPECT_DOUBLE_EQ(weights[0].stiffness[0], 0.125);
  EXPECT_DOUBLE_EQ(weights[0].stiffness[1], 8.0);
  for (const double length : { 0.0, -1.0, std::numeric_limits<double>::infinity(),
         std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_THROW(WeightsOfMetric(curvatures, [=](double) { return length; }), InvalidInput);
  }
}

TEST(LengthOf, RisesFromOneToTheLargestOnTheSideThatIsEnlarged)
{
  constexpr double Largest = 5.0;
  const auto lengthOf = [](CurvatureTransfer transfer, double curvature)
  { return LengthOf(transfer, curvature, Largest); };
  double last = 1.0;
  for (const double k : { 0.0, 0.2, 0.5, 0.9, 1.0, 3.0 })
  {
    const double length = lengthOf(CurvatureTransfer::LargePositive, k);
    EXPECT_TRUE(length > last || k == 0.0 || k > 1.0) << k;
    last = length;
    EXPECT_EQ(lengthOf(CurvatureTransfer::LargePositive, -k), 1.0);
    EXPECT_EQ(lengthOf(CurvatureTransfer::LargeNegative, -k), length);
    EXPECT_EQ(lengthOf(CurvatureTransfer::LargeNegative, k), 1.0);
    EXPECT_EQ(lengthOf(CurvatureTransfer::LargeAbsolute, k), length);
    EXPECT_EQ(lengthOf(CurvatureTransfer::LargeAbsolute, -k), length);
    EXPECT_EQ(lengthOf(CurvatureTransfer::Isotropic, k), 1.0);
    EXPECT_EQ(lengthOf(CurvatureTransfer::Custom, -k), 1.0 + (Largest - 1.0) * std::min(k, 1.0));
  }
  EXPECT_EQ(last, Largest);
  // It has no kinks: it leaves both ends with the square.
  constexpr double Step = 1e-3;
  EXPECT_LT(SmoothStep(Step), 3.0 * Step * Step);
  EXPECT_LT(1.0 - SmoothStep(1.0 - Step), 3.0 * Step * Step);
}

TEST(ScaleToVolume, KeepsTheCentroidAndLeavesAloneWhatHasNoVolume)
{
  const auto stretched = [](const TriangleMesh& mesh, const Vec3& factors)
  {
    std::vector<Vec3> points = mesh.points;
    for (Vec3& p : points)
    {
      p = factors.cwiseProduct(p) + Vec3(5, 0, -3);
    }
    return points;
  };
  const TriangleMesh torus = Torus(40, 16, 1.0, 0.3);
  std::vector<Vec3> points = stretched(torus, { 1.0, 2.0, 0.7 });
  const SurfaceSize before = SizeOf(points, torus.triangles);
  const std::vector<char> all(torus.points.size(), 1);
  ScaleToVolume(torus, all, points);
  const SurfaceSize after = SizeOf(points, torus.triangles);
  const double wanted = SizeOf(torus.points, torus.triangles).volume;
  EXPECT_NEAR(after.volume, wanted, 1e-12 * wanted);
  EXPECT_LT((after.centroid - before.centroid).norm(), 1e-12);
  std::vector<Vec3> ofMixed = stretched(torus, { 1.0, 2.0, 0.7 });
  ScaleToVolume(TurnSome(torus, 0.4, 1), all, ofMixed);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    EXPECT_LT((ofMixed[k] - points[k]).norm(), 1e-12) << k;
  }

  const TriangleMesh sheet = FlatRectangle(4, 4);
  for (const auto& [mesh, factors] : { std::pair<TriangleMesh, Vec3>(torus, { 1, 1, -1 }),
         std::pair<TriangleMesh, Vec3>(torus, { 1, 1, 0 }),
         std::pair<TriangleMesh, Vec3>(sheet, { 2, 2, 1 }) })
  {
    const std::vector<Vec3> given = stretched(mesh, factors);
    points = given;
    ScaleToVolume(mesh, std::vector<char>(points.size(), 1), points);
    EXPECT_EQ(points, given);
  }
}
