// Time and memory of everything before a solve, and of one solve: their distribution, their growth,
// and the peers' needs for the same surface.
#include "Cholmod.h"
#include "Measure.h"
#include "PeerTimes.h"
#include "Problems.h"
#include "SetupCost.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Repetitions = 5;

struct Measurement
{
  double vertices = 0.0;
  SetupCost first; // with its memory, in a fresh process
  SetupCost best;  // the fastest of the repetitions
};

Measurement Measure(int subdivisions, int depth, int threads)
{
  return MeasureInOwnProcess<Measurement>(
    [&]
    {
      const TriangleMesh mesh = RockerArm(subdivisions).mesh;
      Measurement result;
      result.vertices = static_cast<double>(mesh.points.size());
      ReleaseFreeMemory();
      result.first = MeasureSetup(mesh, depth, threads);
      result.best = result.first;
      for (int k = 1; k < Repetitions; ++k)
      {
        const SetupCost next = MeasureSetup(mesh, depth, threads);
        result.best = next.Seconds() < result.best.Seconds() ? next : result.best;
      }
      return result;
    });
}

void PrintStages(const Measurement& one, const Measurement& two)
{
  std::printf("\nSet-up on %s, %.0f vertices, depth 8; best of %d runs, memory of the first\n",
    RockerArm(0).name.c_str(), two.vertices, Repetitions);
  const Table table({ "stage", "s, 1 thread", "s, 2 threads", "MB held", "MB peak" });
  for (int stage = 0; stage < SetupStages; ++stage)
  {
    const StageCost& memory = two.first.stages[stage];
    table.Row({ SetupStageNames[stage], Text("%.2f", one.best.stages[stage].seconds),
      Text("%.2f", two.best.stages[stage].seconds), Text("%.0f", 1e-6 * memory.held),
      Text("%.0f", 1e-6 * memory.peak) });
  }
  table.Row({ "all (mesh: " + Text("%.0f MB more)", 1e-6 * two.first.before),
    Text("%.2f", one.best.Seconds()), Text("%.2f", two.best.Seconds()),
    Text("%.0f", 1e-6 * two.first.stages.back().held), Text("%.0f", 1e-6 * two.first.Peak()) });
}

double MicrosecondsPerTriangle(const Measurement& size)
{
  return 1e6 * size.best.Seconds() / size.best.clippedTriangles;
}

/// Two threads.
void PrintScaling(const char* title, const std::vector<std::pair<int, Measurement>>& sizes)
{
  std::printf("\n%s, 2 threads\n", title);
  const Table table(
    { "vertices", "depth", "clipped", "patches", "functions", "s", "us / clipped", "clip alone" });
  for (const auto& [depth, size] : sizes)
  {
    table.Row({ Text("%.0f", size.vertices), std::to_string(depth),
      Text("%.0f", size.best.clippedTriangles), Text("%.0f", size.best.patches),
      Text("%.0f", size.best.functions), Text("%.2f", size.best.Seconds()),
      Text("%.3f", MicrosecondsPerTriangle(size)),
      Text("%.3f", 1e6 * size.best.stages.front().seconds / size.best.clippedTriangles) });
  }
}

/// The slowest of the sizes against the fastest, per clipped triangle.
double Spread(const std::vector<std::pair<int, Measurement>>& sizes)
{
  const auto [low, high] = std::minmax_element(sizes.begin(), sizes.end(),
    [](const auto& a, const auto& b)
    { return MicrosecondsPerTriangle(a.second) < MicrosecondsPerTriangle(b.second); });
  return MicrosecondsPerTriangle(high->second) / MicrosecondsPerTriangle(low->second);
}

/// The same for the additional triangles of each size. At a fixed depth these triangles no longer
/// pay for the grid.
double SpreadOfFurther(const std::vector<std::pair<int, Measurement>>& sizes)
{
  std::vector<double> cost;
  for (std::size_t k = 1; k < sizes.size(); ++k)
  {
    const auto& less = sizes[k - 1].second.best;
    const auto& more = sizes[k].second.best;
    cost.push_back(
      (more.Seconds() - less.Seconds()) / (more.clippedTriangles - less.clippedTriangles));
  }
  const auto [low, high] = std::minmax_element(cost.begin(), cost.end());
  return *high / *low;
}

struct Peaks
{
  double grid = 0.0;
  double cholmod = 0.0;
};

/// Bytes that a solve needs beyond the mesh (the grid), with the hat matrix (CHOLMOD).
Peaks MeasurePeaks(const NamedMesh& mesh, int depth)
{
  Peaks peaks;
  peaks.grid = MeasureInOwnProcess<double>(
    [&]
    {
      ReleaseFreeMemory();
      const double before = ResidentBytes();
      ResetPeak();
      GridProblem grid = SetUp(mesh.mesh, depth, 2);
      grid.values = MultiVector::Ones(grid.space.Finest().numberOfFunctions, 1);
      grid.gradients = grid.values;
      grid.Solve(1, 1);
      return PeakBytes() - before;
    });
  peaks.cholmod = MeasureInOwnProcess<double>(
    [&]
    {
      const SymmetricMatrix A = AssembleProblem(mesh.mesh).A;
      ReleaseFreeMemory();
      // The matrix counts, but of its two triangles CHOLMOD reads one only.
      const double entry = sizeof(double) + sizeof(int);
      const double before =
        ResidentBytes() - entry * 0.5 * static_cast<double>(A.nonZeros() + A.rows());
      ResetPeak();
      Cholmod cholmod;
      cholmod.Analyze(A);
      cholmod.Factor(A);
      cholmod.Solve(Eigen::MatrixXd::Ones(A.rows(), 1));
      return PeakBytes() - before;
    });
  return peaks;
}

double SetupSeconds(const CholmodTimes& cholmod)
{
  return cholmod.analyze + cholmod.factor;
}

void PrintPeerRatios(
  const std::string& name, const PeerTimes& times, const Peaks& peaks, double cholmodBound)
{
  const auto& [one, two] = times.grid;
  PrintAtMost(
    "setup_over_cholmod_" + name, two.setup / SetupSeconds(times.cholmod[1]), cholmodBound);
  PrintAtMost(
    "from_mesh_over_faster_amg_one_thread_" + name, one.FromMesh() / times.FasterFromMesh(), 0.8);
  const double metricUpdate = two.metric + two.values;
  PrintAtMost("metric_update_over_setup_" + name, metricUpdate / two.setup, 0.2);
  PrintAtMost(
    "metric_update_over_cholmod_refactor_" + name, metricUpdate / times.cholmod[1].factor, 0.25);
  PrintAtMost("weights_update_over_setup_" + name, two.weights / two.setup, 0.1);
  PrintAtMost("connectivity_aware_over_plain_" + name, two.setup / two.plain, 1.3);
  PrintAtLeast("setup_second_thread_" + name, one.setup / two.setup, 1.6);
  PrintAtMost("peak_memory_over_cholmod_" + name, peaks.grid / peaks.cholmod, 0.7);
}

struct Contest
{
  std::string name;
  NamedMesh mesh;
  int depth;
  double cholmodBound;
};

void RunContest(const Contest& contest)
{
  const PeerJob job{ contest.mesh, contest.depth, 1e-4, Repetitions };
  const PeerTimes times = MeasurePeers(job);
  const Peaks peaks = MeasurePeaks(contest.mesh, contest.depth);
  PrintPeers(job, times);
  std::printf("Peak memory beyond the mesh: grid %.0f MB, CHOLMOD %.0f MB\n", 1e-6 * peaks.grid,
    1e-6 * peaks.cholmod);
  PrintPeerRatios(contest.name, times, peaks, contest.cholmodBound);
}

void RunScaling()
{
  const Measurement large = Measure(3, 8, 2);
  PrintStages(Measure(3, 8, 1), large);
  const std::vector<std::pair<int, Measurement>> fixed{ { 8, Measure(2, 8, 2) }, { 8, large },
    { 8, Measure(4, 8, 2) } };
  const std::vector<std::pair<int, Measurement>> growing{ { 7, Measure(2, 7, 2) }, { 8, large },
    { 9, Measure(4, 9, 2) } };
  PrintScaling("Cost at a fixed depth", fixed);
  PrintScaling("Cost at a growing depth", growing);
  PrintAtMost("setup_per_clipped_triangle_fixed_depth_spread", Spread(fixed), 1.25);
  PrintAtMost(
    "setup_per_further_clipped_triangle_fixed_depth_spread", SpreadOfFurther(fixed), 1.25);
  PrintAtMost("setup_per_clipped_triangle_growing_depth_spread", Spread(growing), 1.25);
}

} // namespace

/// Arguments: parts of scaling, 160704, 642816, dragon.
int main(int argc, char** argv)
{
  const Parts parts(argc, argv);
  if (parts.Want("scaling"))
  {
    RunScaling();
  }
  if (parts.Want("160704"))
  {
    RunContest({ "160704", RockerArm(2), 7, 1.0 });
  }
  if (parts.Want("642816"))
  {
    RunContest({ "642816", RockerArm(3), 8, 0.5 });
  }
  if (parts.Want("dragon"))
  {
    RunContest({ "dragon", RealMesh("dragon", "dragon_871k.ply"), 8, 0.5 });
  }
}
