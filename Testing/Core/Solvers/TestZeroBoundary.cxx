// Modes that vanish on the boundary: the eigenvalues of a square, a disk and a hemisphere, their
// order of convergence, and components without a boundary.
#include "AtDepth.h"
#include "ExpectOne.h"
#include "Largest.h"
#include "Meshes.h"

#include "Solvers/SignatureSolver.h"
#include "Solvers/SpectrumSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

constexpr double OwnPi = 3.14159265358979323846;

TriangleMesh Turned(const TriangleMesh& mesh)
{
  return Transform(mesh, { 1, 2, 3 }, 0.7);
}

struct Drum
{
  std::string name;
  std::function<TriangleMesh(int fineness)> make;
  std::vector<double> exact;

  friend std::ostream& operator<<(std::ostream& os, const Drum& drum) { return os << drum.name; }
};

const Drum Drums[] = {
  { "Square", [](int n) { return Turned(FlatRectangle(n, n)); },
    { 2 * OwnPi * OwnPi, 5 * OwnPi* OwnPi, 5 * OwnPi* OwnPi, 8 * OwnPi* OwnPi, 10 * OwnPi* OwnPi,
      10 * OwnPi* OwnPi } },
  // The squares of zeros of Bessel functions: j_01, j_11, j_21, j_02.
  { "Disk", [](int n) { return Turned(Disk(n)); },
    { 5.783185962946785, 14.681970642123893, 14.681970642123893, 26.374616427163390,
      26.374616427163390, 30.471262343662087 } },
  // l (l + 1), for the spherical harmonics that are odd in z.
  { "Hemisphere",
    [](int n)
    {
      return Turned(Mapped(Disk(n),
        [](const Vec3& q)
        {
          const double angle = 0.5 * OwnPi * q.norm();
          const Vec3 side = q.norm() > 0.0 ? Vec3(q.normalized()) : q;
          return Vec3(std::sin(angle) * side + Vec3(0, 0, std::cos(angle)));
        }));
    },
    { 2, 6, 6, 12, 12, 12 } },
};

double LargestError(const std::vector<double>& found, const std::vector<double>& exact)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k)
  {
    largest = Larger(largest, std::abs(found[k] / exact[k] - 1.0));
  }
  return largest;
}

class ZeroBoundary : public ::testing::TestWithParam<Drum>
{
protected:
  ZeroBoundary() { options.zeroBoundaryValues = true; }

  SpectrumSolver::Result Solve(const TriangleMesh& mesh) const
  {
    return SpectrumSolver::Solve(std::make_shared<const TriangleMesh>(mesh), {}, options, asked);
  }

  SpectrumSolver::Options options;
  SurfaceOptions asked = SpectrumSolver::SurfaceDefaults();
};

/// Errors fall with the square of a cell, and the estimates follow them. The facets of the
/// hemisphere leave a rest.
TEST_P(ZeroBoundary, HasTheEigenvaluesOfTheDrum)
{
  const Drum& drum = this->GetParam();
  options.numberOfModes = static_cast<int>(drum.exact.size());
  const TriangleMesh mesh = drum.make(96);
  constexpr double Most[] = { 0.015, 0.004, 0.001 };
  for (int k = 0; k < 3; ++k)
  {
    asked.space.depth = 4 + k;
    const SpectrumSolver::Result found = this->Solve(mesh);
    EXPECT_TRUE(found.spectrum.converged);
    EXPECT_TRUE(found.warnings.empty());
    EXPECT_EQ(found.spectrum.numberOfConstants, 0);
    const double error = LargestError(found.eigenvalues, drum.exact);
    EXPECT_LT(error, Most[k]) << asked.space.depth;
    const std::vector<double>& said = found.spectrum.estimatedErrors;
    const double estimate = *std::max_element(said.begin(), said.end());
    EXPECT_GT(estimate, error / 2.0) << asked.space.depth;
    EXPECT_LT(estimate, error * 3.0) << asked.space.depth;
  }
}

TEST_P(ZeroBoundary, HasTheEigenvaluesOnHatFunctions)
{
  const Drum& drum = this->GetParam();
  options.numberOfModes = static_cast<int>(drum.exact.size());
  asked.choice.kind = FunctionKind::Hats;
  asked.space.depth = 5;
  double before = 0.3;
  for (const int fineness : { 16, 32, 64 })
  {
    const SpectrumSolver::Result found = this->Solve(drum.make(fineness));
    EXPECT_TRUE(found.spectrum.converged);
    const double error = LargestError(found.eigenvalues, drum.exact);
    EXPECT_LT(error, before / 3.5) << fineness;
    before = error;
  }
}

/// The first component is closed and keeps its constant. The others are drums of different size.
TEST(ZeroBoundaries, OnlyClosedComponentsHaveAConstant)
{
  const TriangleMesh small = Transform(FlatRectangle(24, 24), { 0, 0, 1 }, 0.3, 1.0, { 3, 0, 0 });
  const TriangleMesh large = Transform(FlatRectangle(24, 24), { 1, 0, 0 }, 0.5, 1.5, { 0, 3, 0 });
  const TriangleMesh mesh = Join(Join(GeodesicSphere(12), small), large);
  SpectrumSolver::Options options;
  options.zeroBoundaryValues = true;
  options.numberOfModes = 6;
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    SurfaceOptions asked = SpectrumSolver::SurfaceDefaults();
    asked.choice.kind = kind;
    asked.space.depth = 6;
    const SpectrumSolver::Result found =
      SpectrumSolver::Solve(std::make_shared<const TriangleMesh>(mesh), {}, options, asked);
    EXPECT_EQ(found.spectrum.numberOfConstants, 1);
    const double exact[] = { 2.0, 2.0, 2.0, 6.0, 2.0 * OwnPi * OwnPi / 2.25 };
    EXPECT_NEAR(found.eigenvalues[0], 0.0, 1e-12);
    for (int k = 1; k < 5; ++k)
    {
      EXPECT_NEAR(found.eigenvalues[k], exact[k - 1], 0.03 * exact[k - 1]) << k;
    }
  }
}

TEST(ZeroBoundaries, AClosedSurfaceIsToldAndUnchanged)
{
  const auto sphere = std::make_shared<const TriangleMesh>(GeodesicSphere(12));
  SpectrumSolver::Options options;
  options.numberOfModes = 5;
  SurfaceOptions asked = AtDepth<SpectrumSolver>(4);
  const SpectrumSolver::Result free = SpectrumSolver::Solve(sphere, {}, options, asked);
  options.zeroBoundaryValues = true;
  const SpectrumSolver::Result found = SpectrumSolver::Solve(sphere, {}, options, asked);
  EXPECT_EQ(found.eigenvalues, free.eigenvalues);
  ExpectOne(found.warnings, "no boundary");
}

/// Heat that leaves at the boundary: late heat kernels consist of the first mode alone.
TEST(ZeroBoundaries, SignaturesVanishOnTheBoundary)
{
  const auto mesh = std::make_shared<const TriangleMesh>(FlatRectangle(32, 32));
  SpectrumSolver::Options options;
  options.zeroBoundaryValues = true;
  options.numberOfModes = 12;
  SurfaceOptions asked = AtDepth<SpectrumSolver>(5);
  const SpectrumSolver::Result drum = SpectrumSolver::Solve(mesh, {}, options, asked);
  auto modes = std::make_shared<PointModes>();
  modes->eigenvalues = drum.eigenvalues;
  modes->values = drum.atPoints;
  modes->area = 1.0;
  SignatureSolver::Input input;
  input.modes = { mesh, modes, StageKey().Add(1) };
  const SignatureSolver::Result found = SignatureSolver::Solve(mesh, input, {}, asked);
  EXPECT_TRUE(found.warnings.empty());
  const Id late = found.heatKernel.cols() - 1;
  double error = 0.0;
  for (Id k = 0; k < found.heatKernel.rows(); ++k)
  {
    const Vec3& p = mesh->points[k];
    const double mode = 2.0 * std::sin(OwnPi * p[0]) * std::sin(OwnPi * p[1]);
    const double exact = mode * mode * std::exp(-2.0 * OwnPi * OwnPi * found.heatTimes[late]);
    error = Larger(error, std::abs(found.heatKernel(k, late) - exact));
  }
  EXPECT_LT(error, 0.05 * 4.0 * std::exp(-2.0 * OwnPi * OwnPi * found.heatTimes[late]));
}

INSTANTIATE_TEST_SUITE_P(
  Of, ZeroBoundary, ::testing::ValuesIn(Drums), [](const auto& drum) { return drum.param.name; });

} // namespace
} // namespace gridfem
