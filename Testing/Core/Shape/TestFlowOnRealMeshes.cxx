// Flows of scans and parts over many steps: nothing breaks down, and sphere-like surfaces become
// spheres. [T Figures 5.2, 5.3, 6.8]
#include "Shape/MeanCurvatureFlow.h"

#include "Base/LargeMemory.h"
#include "Grid/TriangleArea.h"
#include "Meshes.h"
#include "Shape/MovedSurface.h"
#include "Spaces/GridSpace.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

struct RealFlow
{
  RealFlow(TriangleMesh surface, int depth) : mesh(std::make_shared<TriangleMesh>(surface))
  {
    GridSpaceOptions grid;
    grid.functions.depth = depth;
    space = std::make_shared<const GridSpace>(BuildGridSpace(surface, grid));
  }

  /// @param share  the time step relative to the area
  MeanCurvatureFlow Make(double share)
  {
    options.timeStep = share * SurfaceArea(*mesh) / std::pow(space->UnitLength(), 2);
    return { space, mesh, options };
  }

  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const GridSpace> space;
  FlowOptions options;
};

/// Variance of the distances of the surface from its centroid, relative to their mean.
double RadiusVariance(const TriangleMesh& mesh, const std::vector<Vec3>& points)
{
  const Vec3 centroid = SizeOf(points, mesh.triangles).centroid;
  double area = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const auto& corner : mesh.triangles)
  {
    const double own = AreaVector(points, corner).norm();
    const double radius =
      ((points[corner[0]] + points[corner[1]] + points[corner[2]]) / 3.0 - centroid).norm();
    area += own;
    sum += own * radius;
    squares += own * radius * radius;
  }
  return squares * area / (sum * sum) - 1.0;
}

struct Scan
{
  const char* name;
  int depth;
  double distortion; // largest mean over the surface
};

void PrintTo(const Scan& scan, std::ostream* stream)
{
  *stream << scan.name;
}

class ConformalFlow : public ::testing::TestWithParam<Scan>
{
};

/// The first step may lengthen limbs before they are drawn in.
TEST_P(ConformalFlow, OfARealMeshWithoutHandlesEndsRound)
{
  const std::string path = RealMesh(GetParam().name);
  if (path.empty())
  {
    GTEST_SKIP() << "the folder of real meshes is not there";
  }
  const MemoryReuse reuse;
  RealFlow on(ReadMesh(path), GetParam().depth);
  ASSERT_TRUE(IsLikeASphere(*on.mesh));
  on.options.conformalized = true;
  on.options.rescaling = Rescaling::ConstantArea;
  MeanCurvatureFlow flow = on.Make(0.01);
  double variance = INFINITY;
  FlowStep step;
  for (int k = 1; k <= 30; ++k)
  {
    step = flow.Advance({});
    ASSERT_EQ(step.end, FlowEnd::None);
    EXPECT_EQ(step.lockedSamples, 0);
    if (k == 1 || k == 3 || k == 5 || k == 10 || k == 30)
    {
      const double now = RadiusVariance(*on.mesh, flow.Points());
      EXPECT_LT(now, variance) << k;
      variance = now;
    }
  }
  EXPECT_LT(variance, 1e-3);
  EXPECT_GT(step.sphericity, 0.99);
  const MapDistortion map = DistortionOf(*on.mesh, flow.Points());
  EXPECT_LT(MeanOverSurface(*on.mesh, map.stretchRatio), GetParam().distortion);
}

// Limbs end in parts of the sphere smaller than the resolution of the start's functions. The
// armadillo's mean therefore exceeds the mean of a part, and the raptor's mean comes from its claws
// alone.
INSTANTIATE_TEST_SUITE_P(Scans, ConformalFlow,
  ::testing::Values(Scan{ "fandisk_32k.ply", 6, 1.05 }, Scan{ "armadillo_100k.ply", 6, 1.2 },
    Scan{ "raptor_18k.ply", 6, INFINITY }));

struct LongFlow
{
  const char* name;
  bool isSoup;
  double timeStep; // relative to the area
  int steps;
};

void PrintTo(const LongFlow& flow, std::ostream* stream)
{
  *stream << flow.name << (flow.isSoup ? ", a soup" : "");
}

class ManySteps : public ::testing::TestWithParam<LongFlow>
{
};

/// A sphere vanishes at 1 / 16 π of its area, which is the fortieth step of 5e-4. The flow may end
/// there.
TEST_P(ManySteps, TakeAreaAwayUntilNothingIsLeft)
{
  const std::string path = RealMesh(GetParam().name);
  if (path.empty())
  {
    GTEST_SKIP() << "the folder of real meshes is not there";
  }
  const MemoryReuse reuse;
  const TriangleMesh mesh = ReadMesh(path);
  RealFlow on(GetParam().isSoup ? Unweld(mesh) : mesh, 5);
  MeanCurvatureFlow flow = on.Make(GetParam().timeStep);
  const double start = flow.Start().area;
  double area = start;
  for (int k = 0; k < GetParam().steps; ++k)
  {
    const FlowStep step = flow.Advance({});
    if (step.end != FlowEnd::None)
    {
      EXPECT_LT(area, 2e-3 * start) << k;
      break;
    }
    EXPECT_LT(step.area, area * (1.0 + 1e-3)) << k;
    area = step.area;
  }
  for (const Vec3& p : flow.Points())
  {
    ASSERT_TRUE(p.allFinite());
  }
}

INSTANTIATE_TEST_SUITE_P(Scans, ManySteps,
  ::testing::Values(LongFlow{ "rocker_arm.ply", false, 1e-5, 200 },
    LongFlow{ "neptune_30k.ply", false, 1e-5, 200 }, LongFlow{ "rocker_arm.ply", true, 5e-4, 80 },
    LongFlow{ "neptune_30k.ply", false, 5e-4, 80 },
    LongFlow{ "stanford_bunny.ply", false, 5e-4, 80 },
    LongFlow{ "armadillo_100k.ply", false, 5e-4, 80 }));

} // namespace
