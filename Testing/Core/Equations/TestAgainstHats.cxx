// Solutions and spectra on real meshes against an independent discretization of the same equations:
// hat functions with cotangent weights, factored directly.
#include "Equations/Poisson.h"
#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Spectrum/Spectrum.h"
#include "Support/Discretization.h"
#include "Support/HatSystem.h"
#include "Support/Meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A smooth function of the position that is not a polynomial and has no symmetry.
MultiVector Waves(const TriangleMesh& mesh)
{
  const Grid grid = EmbedInGrid(mesh.points, UsedPoints(mesh), 2);
  MultiVector f(mesh.points.size(), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3 p = grid.ToGrid(mesh.points[i]) / grid.CellsPerSide();
    f(i, 0) = std::sin(9.0 * p[0]) * std::cos(7.0 * p[1]) + std::sin(5.0 * p[2] + 3.0 * p[0]);
  }
  return f;
}

MultiVector SolveGridPoisson(
  const TriangleMesh& mesh, const Discretization& d, double lambda, const MultiVector& f)
{
  const double spacing = d.space.GetGrid().spacing;
  PoissonOptions options;
  options.screeningWeight = lambda * spacing * spacing;
  options.solve.tolerance = 1e-7;
  const Multigrid multigrid =
    BuildMultigrid(ViewOf(d.space, d.system), options.screeningWeight, 1.0, options.multigrid);
  const Field field{ FieldAssociation::Points, f };
  const PoissonSolution solution = SolvePoisson(ViewOf(d.space, d.system), multigrid,
    IntegrateValues(d.space, mesh, field, TriangleRule(2)), {}, options);
  EXPECT_TRUE(solution.report.converged);
  return EvaluateAtPoints(d.space, solution.coefficients);
}

/// L2 norm over the surface of a function with these hat coefficients.
double SurfaceNorm(const HatSystem& hats, const TriangleMesh& mesh, const Eigen::MatrixXd& values)
{
  Eigen::VectorXd x = Eigen::VectorXd::Zero(hats.mass.rows());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    if (hats.row[i] >= 0)
    {
      x[hats.row[i]] = values(i, 0);
    }
  }
  return std::sqrt(x.dot(hats.mass * x));
}

} // namespace

/// A real mesh, the number of refinements of its hats in the plane, and the number of eigenvalues
/// to compare.
struct HatCase
{
  const char* file;
  int subdivisions;
  int modes;
};

void PrintTo(const HatCase& hatCase, std::ostream* stream)
{
  *stream << hatCase.file;
}

class AgainstHats : public ::testing::TestWithParam<HatCase>
{
protected:
  void SetUp() override
  {
    const std::string path = RealMesh(GetParam().file);
    if (path.empty())
    {
      GTEST_SKIP() << "The folder of real meshes is not there.";
    }
    this->mesh = ReadMesh(path);
    for (int k = 0; k < GetParam().subdivisions; ++k)
    {
      this->mesh = SubdivideInPlane(this->mesh);
    }
  }

  TriangleMesh mesh;
};

TEST_P(AgainstHats, Poisson)
{
  const HatSystem hats = BuildHatSystem(mesh);
  const MultiVector f = Waves(mesh);
  const double lambda = 50.0 / SurfaceArea(mesh);
  const Eigen::MatrixXd reference = SolveHatPoisson(mesh, hats, lambda, f);
  double coarse = 0.0;
  for (const int depth : { 6, 7 })
  {
    const MultiVector u = SolveGridPoisson(mesh, Discretize(mesh, depth), lambda, f);
    const double error =
      SurfaceNorm(hats, mesh, u - reference) /
      SurfaceNorm(hats, mesh, Eigen::MatrixXd(reference.array() - reference.mean()));
    // Two second-order discretizations of a function that varies over about a tenth of the mesh.
    EXPECT_LT(error, depth == 6 ? 2e-2 : 1e-2) << depth;
    // At depth 7 the error of the hat functions themselves can be the larger part.
    EXPECT_TRUE(depth == 6 || error < 1.05 * coarse) << coarse << " " << error;
    coarse = error;
  }
}

TEST_P(AgainstHats, Spectrum)
{
  const int count = GetParam().modes;
  const std::vector<double> reference = HatEigenvalues(BuildHatSystem(mesh), count);
  const Discretization d = Discretize(mesh, 7);
  SpectrumOptions options;
  options.numberOfModes = count;
  const Spectrum spectrum = ComputeSpectrum(ViewOf(d.space, d.system), options);
  ASSERT_TRUE(spectrum.converged);
  const double spacing = d.space.GetGrid().spacing;
  for (int k = 0; k < count; ++k)
  {
    EXPECT_NEAR(spectrum.eigenvalues[k] / (spacing * spacing), reference[k],
      0.01 * reference[k] + 1e-6 * reference[count - 1])
      << k;
  }
}

// The hats of the original neptune mesh are off by 3 % at the twentieth eigenvalue. The bones mesh
// has 26 components.
INSTANTIATE_TEST_SUITE_P(RealMeshes, AgainstHats,
  ::testing::Values(HatCase{ "rocker_arm.ply", 0, 20 }, HatCase{ "genus3_13k.ply", 0, 20 },
    HatCase{ "knot2_12k.ply", 0, 20 }, HatCase{ "fandisk_32k.ply", 0, 20 },
    HatCase{ "neptune_30k.ply", 1, 20 }, HatCase{ "bones_26comp_4k.ply", 2, 40 }));
