// Eigenpairs on hat functions against dense and shift-inverted references.
#include "Spectrum/Spectrum.h"

#include "Dense.h"
#include "Discretization.h"
#include "Spaces.h"
#include "Spaces/HatSpace.h"
#include "Support/HatSystem.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

struct Modes
{
  Modes(const TriangleMesh& mesh, int depth, SpectrumOptions options, int threads = 0)
  {
    GridSpaceOptions spaceOptions;
    spaceOptions.functions.depth = depth;
    spaceOptions.functions.threads = threads;
    const HatSpace space = BuildHatSpace(mesh, spaceOptions);
    options.multigrid.threads = threads;
    matrices = space.Matrices();
    spectrum = ComputeSpectrum(space, options);
    unit2 = std::pow(space.UnitLength(), 2);
  }

  /// Eigenvalue of a mode, in world units.
  double Value(int mode) const { return spectrum.eigenvalues[mode] / unit2; }

  HatMatrices matrices;
  Spectrum spectrum;
  double unit2;
};

SpectrumOptions Options(int modes, double tolerance = 1e-10)
{
  SpectrumOptions options;
  options.numberOfModes = modes;
  options.tolerance = tolerance;
  return options;
}

std::vector<double> DenseEigenvalues(const TriangleMesh& mesh)
{
  const HatSystem reference = BuildHatSystem(mesh);
  const Eigen::VectorXd values =
    DenseEigen(Eigen::MatrixXd(reference.stiffness), Eigen::MatrixXd(reference.mass)).values;
  return { values.begin(), values.end() };
}

} // namespace

TEST(UnnestedSpectrum, IsThatOfADenseSolver)
{
  for (const TriangleMesh& mesh : { Transform(GeodesicSphere(10), { 1, 2, 0 }, 1.0, 5.0),
         Join(Torus(20, 10, 1.0, 0.3), GeodesicSphere(5, 0.2)), TwoSheets(8, 0.02) })
  {
    const std::vector<double> expected = DenseEigenvalues(mesh);
    for (const int depth : { 3, 5 }) // grids coarser and finer than the mesh
    {
      const Modes modes(mesh, depth, Options(25));
      ASSERT_TRUE(modes.spectrum.converged);
      ASSERT_EQ(modes.spectrum.eigenvalues.size(), 25u);
      for (int k = 0; k < 25; ++k)
      {
        // The error of a value is the square of the measure, which is the tolerance.
        EXPECT_NEAR(modes.Value(k), expected[k], 1e-8 * expected[24]) << k;
      }
    }
  }
}

TEST(UnnestedSpectrum, ABoxOfWholeNumbersHasOneConstantOnly)
{
  // Nothing is rounded there: the rest of the constant is constant to the last bit.
  for (const int n : { 4, 8 })
  {
    const TriangleMesh mesh = Box(n, { 0, 0, 0 }, Vec3::Constant(n));
    const std::vector<double> expected = DenseEigenvalues(mesh);
    for (const int depth : { 3, 4, 5, 6 })
    {
      const Modes modes(mesh, depth, Options(5));
      for (int k = 0; k < 5; ++k)
      {
        EXPECT_NEAR(modes.Value(k), expected[k], 1e-8 * expected[4]) << n << " " << depth;
      }
    }
  }
}

TEST(UnnestedSpectrum, VectorsAreEigenvectors)
{
  const Modes modes(Transform(Torus(30, 20, 1.0, 0.4), { 1, 2, 3 }, 0.4), 4, Options(15));
  const MultiVector& X = modes.spectrum.vectors;
  MultiVector MX;
  MultiVector LX;
  Multiply(modes.matrices.mass, X, MX);
  Multiply(modes.matrices.stiffness, X, LX);
  EXPECT_LT((X.transpose() * MX - Eigen::MatrixXd::Identity(15, 15))
              .cwiseAbs()
              .maxCoeff<Eigen::PropagateNaN>(),
    1e-10);
  for (int k = 0; k < 15; ++k)
  {
    const double value = modes.spectrum.eigenvalues[k];
    // The residual is the square root of the value's error, 1e-10, times the largest value.
    EXPECT_LT((LX.col(k) - value * MX.col(k)).norm(), 1e-4 * LX.col(14).norm()) << k;
  }
}

TEST(UnnestedSpectrum, GoesOnToTheEndOfAMultipletOrSaysThatItIsCut)
{
  // Its eigenvalues are equal in groups of 1, 3, 5, ...
  const TriangleMesh mesh = Transform(GeodesicSphere(24), { 1, 2, 3 }, 0.4);
  SpectrumOptions options = Options(6, 1e-8);
  const Modes cut(mesh, 5, options);
  EXPECT_EQ(cut.spectrum.eigenvalues.size(), 6u);
  EXPECT_TRUE(cut.spectrum.cutsMultiplet);
  options.completeMultiplets = true;
  const Modes whole(mesh, 5, options);
  EXPECT_EQ(whole.spectrum.eigenvalues.size(), 9u);
  EXPECT_FALSE(whole.spectrum.cutsMultiplet);
}

TEST(UnnestedSpectrum, ZerosOfEqualComponentsAreAMultiplet)
{
  const TriangleMesh one = GeodesicSphere(6);
  const TriangleMesh two = Join(one, Transform(one, { 0, 0, 1 }, 0.0, 1.0, { 3, 0, 0 }));
  const TriangleMesh mesh = Join(two, Transform(two, { 0, 0, 1 }, 0.0, 1.0, { 0, 3, 0 }));
  SpectrumOptions options = Options(2);
  const Modes cut(mesh, 4, options);
  EXPECT_EQ(cut.spectrum.eigenvalues, std::vector<double>(2, 0.0));
  EXPECT_TRUE(cut.spectrum.cutsMultiplet);
  options.completeMultiplets = true;
  EXPECT_EQ(Modes(mesh, 4, options).spectrum.eigenvalues, std::vector<double>(2, 0.0));
  options.numberOfModes = 5; // 4 zeros, and l = 1 of four equal spheres: more than the guards
  const Modes whole(mesh, 4, options);
  EXPECT_EQ(whole.spectrum.eigenvalues.size(), 16u);
  EXPECT_FALSE(whole.spectrum.cutsMultiplet);
}

TEST(UnnestedSpectrum, EstimatesTheErrorOfTheWorseOfBothSpaces)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(5), { 1, 2, 3 }, 0.4);
  // The same surface with hats of an eighth of the size has a 64th of the error.
  TriangleMesh fine = mesh;
  for (int k = 0; k < 3; ++k)
  {
    fine = SubdivideInPlane(fine);
  }
  const std::vector<double> exact = HatEigenvalues(BuildHatSystem(fine), 17);
  const std::vector<double> hats = HatEigenvalues(BuildHatSystem(mesh), 17);
  SpaceOptions spaceOptions;
  for (const int depth : { 4, 6 }) // grids worse and better than the hats
  {
    spaceOptions.depth = depth;
    const GridFunctions space = BuildGridFunctions(mesh, spaceOptions);
    const Spectrum grid = ComputeSpectrum(
      ViewOf(space, BuildLevelOperators(space, TriangleRule(2))), Options(17, 1e-8));
    const Modes modes(mesh, depth, Options(17));
    for (int k = 1; k < 17; ++k)
    {
      const double hatError = hats[k] / exact[k] - 1.0;
      const double gridError = grid.eigenvalues[k] / modes.unit2 / exact[k] - 1.0;
      const double estimate = modes.spectrum.estimatedErrors[k];
      // The grid's part is known to a quarter, and its loose start adds 1e-4.
      EXPECT_GT(estimate, 0.75 * std::max(hatError, gridError)) << depth << " " << k;
      EXPECT_LT(estimate, 1.25 * std::max(hatError, gridError) + 2e-4) << depth << " " << k;
    }
  }
}

TEST(UnnestedSpectrum, HasNoMoreModesThanFunctions)
{
  const TriangleMesh mesh = GeodesicSphere(1); // 6 points
  const Modes modes(mesh, 4, Options(10));
  EXPECT_EQ(modes.spectrum.eigenvalues.size(), 6u);
  EXPECT_TRUE(modes.spectrum.truncated);
  const std::vector<double> expected = DenseEigenvalues(mesh);
  for (int k = 0; k < 6; ++k)
  {
    EXPECT_NEAR(modes.Value(k), expected[k], 1e-8 * expected[5]);
  }
}

TEST(UnnestedSpectrum, DoesNotDependOnThreads)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(30), { 1, 2, 3 }, 0.5);
  const Modes one(mesh, 5, Options(12, 1e-8), 1);
  const Modes three(mesh, 5, Options(12, 1e-8), 3);
  EXPECT_EQ(one.spectrum.eigenvalues, three.spectrum.eigenvalues);
  EXPECT_EQ(one.spectrum.vectors, three.spectrum.vectors);
}

TEST(UnnestedSpectrum, OfRealMeshesIsThatOfShiftInvertIteration)
{
  for (const char* name : { "rocker_arm.ply", "bones_26comp_4k.ply" })
  {
    const std::string path = RealMesh(name);
    if (path.empty())
    {
      GTEST_SKIP() << "The folder of real meshes is not there.";
    }
    const TriangleMesh mesh = ReadMesh(path);
    const Modes modes(mesh, 5, Options(40));
    ASSERT_TRUE(modes.spectrum.converged) << name;
    const std::vector<double> expected = HatEigenvalues(BuildHatSystem(mesh), 40);
    for (int k = 0; k < 40; ++k)
    {
      EXPECT_NEAR(modes.Value(k), expected[k], 1e-6 * expected[39]) << name << " " << k;
    }
  }
}
