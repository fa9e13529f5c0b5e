// Compares the estimate of memory with the real peak, and the expected sizes with the real sizes.
#include "Discretization.h"
#include "Measure.h"
#include "Meshes.h"
#include "SetupCost.h"
#include "Solvers/MemoryEstimate.h"
#include "Solvers/Requirements.h"
#include "Spaces/SpaceChoice.h"
#include "Spectrum/Spectrum.h"

#include <algorithm>
#include <cstdio>
#include <functional>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

struct Case
{
  std::string name;
  std::function<TriangleMesh()> mesh;
  int depth;
};

std::vector<Case> Cases()
{
  std::vector<Case> cases{
    { "rocker arm 16x", [] { return RockerArm(2).mesh; }, 7 },
    { "rocker arm 64x", [] { return RockerArm(3).mesh; }, 8 },
    { "rocker arm 16x soup", [] { return testing::Unweld(RockerArm(2).mesh); }, 7 },
    { "cube of 12 triangles", [] { return testing::Box(1); }, 8 },
    { "cube rotated by 5 degrees",
      [] {
        return testing::Transform(testing::Box(1), { 1, 1, 1 }, 0.0873);
      },
      8 },
    { "sphere of 1.3 M triangles", [] { return testing::GeodesicSphere(400); }, 5 },
  };
  for (const auto& [file, depth] : { std::pair{ "brain_mni_LR.ply", 7 },
         std::pair{ "armadillo_100k.ply", 6 }, std::pair{ "dragon_871k.ply", 9 } })
  {
    cases.push_back({ file, [name = file] { return RealMesh(name, name).mesh; }, depth });
  }
  return cases;
}

struct EstimateAndCost
{
  MemoryEstimate estimate;
  SetupCost cost;
};

struct SpectrumCase
{
  NamedMesh mesh;
  int depth;
  int modes;
};

struct EstimateAndPeak
{
  double functions;
  double estimated;
  double real; // growth of the process from the system on
};

/// From the mesh to the hierarchy over its hats, with the grid that filters choose below them.
EstimateAndPeak MeasureHats(const TriangleMesh& mesh)
{
  ReleaseFreeMemory();
  const double before = ResidentBytes();
  ResetPeak();
  SpaceChoice choice;
  choice.kind = FunctionKind::Hats;
  SpaceOptions options;
  options.depth = ChooseDepth(mesh, AutomaticDepth, choice.kind, 1.0);
  const MemoryEstimate grid = EstimateMemory(mesh, options.depth);
  const auto space = BuildSpace(mesh, options, choice, {});
  const Multigrid multigrid = BuildMultigrid(*space, 1e-4, 1.0, {});
  return { double(space->NumberOfFunctions(0)),
    grid.bytes + EstimateHatMemory(mesh, grid.functions), PeakBytes() - before };
}

EstimateAndPeak MeasureSpectrum(const SpectrumCase& item)
{
  SpaceOptions options;
  options.depth = item.depth;
  const GridFunctions space = BuildGridFunctions(item.mesh.mesh, options);
  const LevelOperators system = BuildLevelOperators(space, TriangleRule(2));
  const Index functions = space.Finest().numberOfFunctions;
  ReleaseFreeMemory();
  const double before = ResidentBytes();
  ResetPeak();
  SpectrumOptions spectrum;
  spectrum.numberOfModes = item.modes;
  ComputeSpectrum(testing::ViewOf(space, system), spectrum);
  return { double(functions), EstimateSpectrumMemory(functions, item.modes), PeakBytes() - before };
}

std::string Quotient(double estimate, double real)
{
  return Text("%.2f", estimate / real);
}

/// Compares the estimated memory of spectra with the growth after the system is built.
void RunSpectra()
{
  std::vector<SpectrumCase> cases{ { RockerArm(2), 7, 20 }, { RockerArm(2), 7, 100 },
    { RockerArm(2), 7, 300 }, { { "sphere", testing::GeodesicSphere(100) }, 7, 100 } };
  cases.push_back({ RealMesh("dragon", "dragon_871k.ply"), 8, 100 });
  const Table table(
    { "spectrum", "depth", "modes", "functions", "MB real", "MB estimated", "estimate / real" });
  for (const SpectrumCase& item : cases)
  {
    const auto [functions, estimated, real] =
      MeasureInOwnProcess<EstimateAndPeak>([&] { return MeasureSpectrum(item); });
    table.Row({ item.mesh.name, std::to_string(item.depth), std::to_string(item.modes),
      Text("%.0f", functions), Text("%.0f", 1e-6 * real), Text("%.0f", 1e-6 * estimated),
      Quotient(estimated, real) });
  }
}

void RunHats()
{
  std::vector<NamedMesh> meshes{ RockerArm(1), RockerArm(2) };
  for (const char* file : { "armadillo_100k.ply", "dragon_871k.ply" })
  {
    meshes.push_back(RealMesh(file, file));
  }
  const Table table({ "hats", "functions", "MB real", "MB estimated", "estimate / real" });
  for (const NamedMesh& item : meshes)
  {
    const auto [functions, estimated, real] =
      MeasureInOwnProcess<EstimateAndPeak>([&] { return MeasureHats(item.mesh); });
    table.Row({ item.name, Text("%.0f", functions), Text("%.0f", 1e-6 * real),
      Text("%.0f", 1e-6 * estimated), Quotient(estimated, real) });
  }
}

} // namespace

int main()
{
  const Table table({ "estimate / real", "depth", "triangles", "patches", "functions", "MB real",
    "MB estimated", "memory" });
  std::vector<std::pair<std::string, double>> ratios;
  for (const Case& item : Cases())
  {
    const auto [estimate, cost] = MeasureInOwnProcess<EstimateAndCost>(
      [&]
      {
        const TriangleMesh mesh = item.mesh();
        const MemoryEstimate estimated = EstimateMemory(mesh, item.depth);
        ReleaseFreeMemory();
        return EstimateAndCost{ estimated, MeasureSetup(mesh, item.depth, 0) };
      });
    table.Row({ item.name, std::to_string(item.depth),
      Quotient(estimate.clippedTriangles, cost.clippedTriangles),
      Quotient(estimate.patches, cost.patches), Quotient(estimate.functions, cost.functions),
      Text("%.0f", 1e-6 * cost.Peak()), Text("%.0f", 1e-6 * estimate.bytes),
      Quotient(estimate.bytes, cost.Peak()) });
    std::string name = "estimate_over_peak_" + item.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    ratios.emplace_back(name, estimate.bytes / cost.Peak());
  }
  std::printf("\n");
  for (const auto& [name, ratio] : ratios)
  {
    PrintAtMost(name, ratio, 1.3);
    PrintAtLeast(name, ratio, 0.8);
  }
  RunHats();
  RunSpectra();
}
