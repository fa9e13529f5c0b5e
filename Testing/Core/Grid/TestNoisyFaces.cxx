// Flat faces in planes of the grid whose points have noise. Their triangles lie in two layers of
// cells, and lines of the clip are moved onto the planes.
#include "AtDepth.h"
#include "Grid/GridFunctions.h"
#include "Largest.h"
#include "Meshes.h"
#include "Solvers/DistanceSolver.h"
#include "Solvers/SpectrumSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

constexpr int Depth = 4;
constexpr double Cell = 1.0 / (1 << Depth); // of a surface with a longest side of 1

/// Moves every coordinate by up to `noise` cells.
TriangleMesh Noisy(TriangleMesh mesh, double noise)
{
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> random(-noise * Cell, noise * Cell);
  for (Vec3& point : mesh.points)
  {
    point += Vec3(random(generator), random(generator), random(generator));
  }
  return mesh;
}

/// Surfaces with faces or edges in planes of the grid.
std::vector<TriangleMesh> Aligned()
{
  return { Box(6, { 0, 0, 0 }, { 1, 0.5, 0.5 }), Box(14, { 0, 0, 0 }, { 1, 0.5, 0.25 }), Box(5),
    FlatRectangle(14, 9, 1.0, 0.5) };
}

TriangleMesh Shifted(const TriangleMesh& mesh, double shift)
{
  return Transform(mesh, { 0, 0, 1 }, 0.0, 1.0, shift * Vec3(1, 0.5, 0.25));
}

TEST(NoisyFaces, StayInOnePiece)
{
  for (const TriangleMesh& mesh : Aligned())
  {
    // Far from the origin, rounding is larger, and so is the distance within which points are
    // moved onto planes.
    for (const double shift : { 0.0, 1e4, 1e7 })
    {
      for (const double noise : { 1e-10, 3e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4, 1e-2, 0.3 })
      {
        const TriangleMesh noisy = Shifted(Noisy(mesh, noise), shift);
        SpaceOptions options;
        options.depth = Depth;
        const GridFunctions space = BuildGridFunctions(noisy, options);
        EXPECT_EQ(space.numberOfComponents, 1) << noise << " at " << shift;
      }
    }
  }
}

// A search over all edges must find no links that the clip has left out.
TEST(NoisyFaces, HaveTheLinksOfTheirEdges)
{
  for (const TriangleMesh& mesh : Aligned())
  {
    for (const double noise : { 3e-10, 1e-9, 1e-8, 1e-7, 1e-3 })
    {
      const TriangleMesh noisy = Noisy(mesh, noise);
      ClipOptions options;
      options.depth = Depth;
      ClippedMesh clipped = Clip(noisy, options);
      const PatchPartition own = BuildPatches(clipped, FunctionSupport::ConnectivityAware);
      clipped.links = FindLinks(clipped, WeldCoincidentPoints(noisy.points));
      const PatchPartition found = BuildPatches(clipped, FunctionSupport::ConnectivityAware);
      EXPECT_EQ(own.piecePatch, found.piecePatch) << noise;
      EXPECT_EQ(own.links, found.links) << noise;
    }
  }
}

/// Eigenvalues are compared with the eigenvalues of the turned surface, none of whose faces is in a
/// plane. Both err by about two percent at this depth.
TEST(NoisyFaces, HaveTheModesOfTheTurnedSurface)
{
  SurfaceOptions surface = AtDepth<SpectrumSolver>(Depth);
  SpectrumSolver::Options options;
  options.numberOfModes = 6;
  for (const TriangleMesh& mesh : Aligned())
  {
    for (const double noise : { 1e-9, 1e-8, 1e-2 })
    {
      const TriangleMesh noisy = Noisy(mesh, noise);
      const auto modesOf = [&](const TriangleMesh& given)
      {
        return SpectrumSolver::Solve(
          std::make_shared<const TriangleMesh>(given), {}, options, surface);
      };
      const SpectrumSolver::Result modes = modesOf(noisy);
      const SpectrumSolver::Result turned = modesOf(Transform(noisy, { 1, 2, 3 }, 0.7));
      ASSERT_EQ(modes.NumberOfModes(), 6);
      EXPECT_TRUE(modes.spectrum.converged) << noise;
      for (int k = 1; k < 6; ++k)
      {
        EXPECT_NEAR(modes.eigenvalues[k], turned.eigenvalues[k], 0.03 * turned.eigenvalues[k])
          << "mode " << k << ", noise " << noise;
      }
    }
  }
}

TEST(NoisyFaces, HaveStraightDistancesFromACorner)
{
  SurfaceOptions surface = AtDepth<DistanceSolver>(Depth);
  for (const TriangleMesh& mesh : Aligned())
  {
    const auto corner = std::find(mesh.points.begin(), mesh.points.end(), Vec3(0, 0, 0));
    ASSERT_NE(corner, mesh.points.end());
    DistanceSolver::Input input;
    input.ids = { corner - mesh.points.begin() };
    for (const double noise : { 1e-9, 1e-8, 1e-3, 0.03 })
    {
      const auto noisy = std::make_shared<const TriangleMesh>(Noisy(mesh, noise));
      const DistanceSolver::Result result = DistanceSolver::Solve(noisy, input, {}, surface);
      double largest = 0.0;
      for (std::size_t point = 0; point < mesh.points.size(); ++point)
      {
        if (mesh.points[point].minCoeff() == 0.0) // on a face of the corner
        {
          const double distance = result.atPoints(static_cast<Id>(point), 0);
          largest = Larger(largest, std::abs(distance - mesh.points[point].norm()));
        }
      }
      EXPECT_LT(largest, Cell) << noise; // the length that heat spreads over
    }
  }
}

} // namespace
} // namespace gridfem
