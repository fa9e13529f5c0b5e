#include "SetupCost.h"
#include "Discretization.h"

#include "Base/LargeMemory.h"
#include "Measure.h"
#include "Meshes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gridfem::benchmarks
{

NamedMesh RealMesh(const std::string& name, const std::string& file, int subdivisions)
{
  const std::string path = testing::RealMesh(file);
  if (path.empty())
  {
    throw std::runtime_error(file + " is not there: GRIDFEM_DATA_DIR names the folder.");
  }
  NamedMesh result = { name, testing::ReadMesh(path) };
  for (int k = 0; k < subdivisions; ++k)
  {
    result.mesh = testing::SubdivideInPlane(result.mesh);
  }
  return result;
}

NamedMesh RockerArm(int subdivisions)
{
  return RealMesh("rocker arm", "rocker_arm.ply", subdivisions);
}

double SetupCost::Seconds() const
{
  double sum = 0.0;
  for (const StageCost& stage : stages)
  {
    sum += stage.seconds;
  }
  return sum;
}

double SetupCost::Peak() const
{
  double peak = 0.0;
  for (const StageCost& stage : stages)
  {
    peak = std::max(peak, stage.peak);
  }
  return peak;
}

SetupCost MeasureSetup(const TriangleMesh& mesh, int depth, int threads)
{
  const MemoryReuse reuse;
  SetupCost cost;
  cost.before = ResidentBytes();
  auto measure = [&, stage = cost.stages.begin()](auto&& run) mutable
  {
    ResetPeak();
    const Stopwatch watch;
    auto result = run();
    stage->seconds = watch.Seconds();
    stage->peak = PeakBytes() - cost.before;
    stage->held = ResidentBytes() - cost.before;
    ++stage;
    return result;
  };
  ClipOptions clip;
  clip.depth = depth;
  clip.threads = threads;
  ClippedMesh clipped = measure([&] { return Clip(mesh, clip); });
  cost.clippedTriangles = static_cast<double>(clipped.NumberOfTriangles());
  cost.pieces = static_cast<double>(clipped.NumberOfPieces());
  const GridFunctions space = measure(
    [&] {
      return BuildGridFunctions(std::move(clipped), FunctionSupport::ConnectivityAware, threads);
    });
  cost.patches = static_cast<double>(space.Finest().NumberOfPatches());
  cost.functions = static_cast<double>(space.Finest().numberOfFunctions);
  const LevelOperators system =
    measure([&] { return BuildLevelOperators(space, TriangleRule(2), threads); });
  MultigridOptions options;
  options.threads = threads;
  // λ = 0.01 for a mesh scaled to longest side 1.
  const double lambda = 0.01 * std::pow(0.25, depth);
  const Multigrid multigrid =
    measure([&] { return BuildMultigrid(testing::ViewOf(space, system), lambda, 1.0, options); });
  return cost;
}

} // namespace gridfem::benchmarks
