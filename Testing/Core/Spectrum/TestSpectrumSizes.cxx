// Spectra whose masses are far from the usual size: metrics of any scale, and components of any
// area.
#include "EitherSpace.h"
#include "Integrals/TriangleMetric.h"
#include "Largest.h"
#include "Meshes.h"
#include "Spectrum/Spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

TriangleMesh Square()
{
  return Transform(FlatRectangle(32, 32), { 1, 2, 3 }, 0.7);
}

Spectrum SpectrumOf(const SurfaceSpace& space, int modes)
{
  SpectrumOptions options;
  options.numberOfModes = modes;
  return ComputeSpectrum(space, options);
}

/// The metric of a map that scales the plane by s.
std::shared_ptr<const TriangleMetric> Scaling(const TriangleMesh& mesh, double s)
{
  Field tensors{ FieldAssociation::Triangles,
    MultiVector::Zero(static_cast<Id>(mesh.triangles.size()), 6) };
  tensors.values.leftCols(3).setConstant(s * s);
  return std::make_shared<const TriangleMetric>(MetricOfTensors(mesh, tensors));
}

} // namespace

/// A map that scales by s divides eigenvalues by s² and modes by s. MetricOfTensors accepts metrics
/// in this range.
TEST(SpectrumSizes, AMetricOfAnyScaleHasTheEigenvaluesOfTheScaledSurface)
{
  const TriangleMesh mesh = Square();
  for (const bool isOnHats : { false, true })
  {
    const auto space = BuildEither(mesh, isOnHats, 5, 1e-12);
    const Spectrum unscaled = SpectrumOf(*space, 6);
    ASSERT_TRUE(unscaled.converged);
    for (const double s : { 0.01, 1e-5, 1e-10, 1e-30, 1e-49, 100.0, 1e5, 1e9, 1e30, 1e49 })
    {
      space->SetMetricOnTriangles(Scaling(mesh, s));
      const Spectrum scaled = SpectrumOf(*space, 6);
      EXPECT_TRUE(scaled.converged) << s;
      ASSERT_EQ(scaled.eigenvalues.size(), unscaled.eigenvalues.size()) << s;
      EXPECT_EQ(scaled.numberOfConstants, 1) << s;
      for (int k = 1; k < 6; ++k)
      {
        EXPECT_NEAR(scaled.eigenvalues[k] * s * s / unscaled.eigenvalues[k], 1.0, 1e-5)
          << k << " at " << s;
      }
      // The mass in the metric of every mode is 1.
      const Columns norms = space->SquaredNorms(scaled.vectors);
      EXPECT_LT((norms - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-6) << s;
    }
  }
}

/// A map that stretches one direction. The eigenvalues are those of a rectangle.
TEST(SpectrumSizes, AMetricThatStretchesOneDirectionHasTheEigenvaluesOfARectangle)
{
  constexpr double Pi = 3.14159265358979323846;
  const TriangleMesh mesh = FlatRectangle(32, 32);
  for (const bool isOnHats : { false, true })
  {
    for (const double stretch : { 3.0, 1e3, 1e-3 })
    {
      Field tensors{ FieldAssociation::Triangles,
        MultiVector::Zero(static_cast<Id>(mesh.triangles.size()), 6) };
      tensors.values.col(0).setConstant(stretch * stretch);
      tensors.values.col(1).setOnes();
      tensors.values.col(2).setOnes();
      const auto space = BuildEither(mesh, isOnHats, 5, 1e-12);
      space->SetMetricOnTriangles(
        std::make_shared<const TriangleMetric>(MetricOfTensors(mesh, tensors)));
      const Spectrum found = SpectrumOf(*space, 3);
      EXPECT_TRUE(found.converged) << stretch;
      const double longer = std::max(1.0, stretch);
      for (int k = 1; k < 3; ++k)
      {
        const double exact = std::pow(Pi * k / longer, 2);
        const double inWorld = found.eigenvalues[k] / std::pow(space->UnitLength(), 2);
        EXPECT_NEAR(inWorld / exact, 1.0, 0.01) << k << " at " << stretch << " " << isOnHats;
      }
    }
  }
}

/// Each connected component of a grid has a constant mode, however small its area.
TEST(SpectrumSizes, AComponentOfAnyAreaHasAConstant)
{
  for (const double size : { 1e-3, 1e-6, 1e-7, 1e-9, 1e-12 })
  {
    TriangleMesh crumb;
    crumb.points = { { 0.31, 0.52, 0.2 }, { 0.31 + size, 0.52, 0.2 }, { 0.31, 0.52 + size, 0.2 } };
    crumb.triangles = { { 0, 1, 2 } };
    const TriangleMesh mesh = Join(FlatRectangle(16, 16), crumb);
    for (const bool isOnHats : { false, true })
    {
      if (isOnHats && size < 1e-6)
      {
        continue; // hats do not tell a small area from rounding
      }
      const auto space = BuildEither(mesh, isOnHats, 4, 1e-12);
      const Spectrum found = SpectrumOf(*space, 5);
      EXPECT_EQ(found.numberOfConstants, 2) << size << " " << isOnHats;
      EXPECT_TRUE(found.converged) << size << " " << isOnHats;
      EXPECT_EQ(found.eigenvalues[1], 0.0) << size << " " << isOnHats;
      EXPECT_GT(found.eigenvalues[2], 1e-3) << size << " " << isOnHats;
      const Columns norms = space->SquaredNorms(found.vectors);
      EXPECT_LT((norms - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-6) << size;
    }
  }
}

/// A triangle without an area is no component.
TEST(SpectrumSizes, ATriangleWithoutAnAreaHasNone)
{
  TriangleMesh line;
  line.points = { { 0.25, 0.5, 0.25 }, { 0.5, 0.5, 0.25 }, { 0.75, 0.5, 0.25 } };
  line.triangles = { { 0, 1, 2 } };
  const TriangleMesh mesh = Join(FlatRectangle(16, 16), line);
  for (const bool isOnHats : { false, true })
  {
    const Spectrum found = SpectrumOf(*BuildEither(mesh, isOnHats, 4, 1e-12), 4);
    EXPECT_EQ(found.numberOfConstants, 1) << isOnHats;
  }
}

} // namespace gridfem
