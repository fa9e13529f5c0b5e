// Time and memory of everything that comes before a solve, on 1.3 million triangles.
#include "Measure.h"
#include "Meshes.h"
#include "SetupCost.h"

#include <algorithm>
#include <cstdio>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Repetitions = 3;

struct Measurement
{
  double vertices = 0.0;
  SetupCost first; // with its memory, in a fresh process
  SetupCost best;  // the fastest of the repetitions
};

Measurement Measure(int subdivisions, int depth, int threads)
{
  const std::vector<double> numbers = InOwnProcess(
    [&]
    {
      const TriangleMesh mesh = RockerArm(subdivisions).mesh;
      const SetupCost first = MeasureSetup(mesh, depth, threads);
      SetupCost best = first;
      for (int k = 1; k < Repetitions; ++k)
      {
        const SetupCost next = MeasureSetup(mesh, depth, threads);
        best = next.Seconds() < best.Seconds() ? next : best;
      }
      std::vector<double> result = first.Pack();
      const std::vector<double> second = best.Pack();
      result.insert(result.end(), second.begin(), second.end());
      result.push_back(static_cast<double>(mesh.points.size()));
      return result;
    });
  const auto half = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  return { numbers.back(), SetupCost::Unpack({ numbers.begin(), half }),
    SetupCost::Unpack({ half, numbers.end() - 1 }) };
}

void PrintStages(const Measurement& one, const Measurement& two)
{
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

void PrintScaling(const std::vector<std::array<Measurement, 2>>& sizes)
{
  const Table table({ "vertices", "triangles after clip", "patches", "functions", "us, 1 thread",
    "us, 2 threads", "clip alone" });
  for (const auto& [one, two] : sizes)
  {
    const double scale = 1e6 / one.best.clippedTriangles;
    table.Row({ Text("%.0f", one.vertices), Text("%.0f", one.best.clippedTriangles),
      Text("%.0f", one.best.patches), Text("%.0f", one.best.functions),
      Text("%.2f", scale * one.best.Seconds()), Text("%.2f", scale * two.best.Seconds()),
      Text("%.2f", scale * two.best.stages.front().seconds) });
  }
}

} // namespace

int main()
{
  const std::array<Measurement, 2> small{ Measure(2, 7, 1), Measure(2, 7, 2) };
  const std::array<Measurement, 2> large{ Measure(3, 8, 1), Measure(3, 8, 2) };
  std::printf("\nSet-up on %s, depth 8; best of %d runs, memory of the first\n",
    RockerArm(0).name.c_str(), Repetitions);
  PrintStages(large[0], large[1]);
  std::printf("\nTime per clipped triangle, depths 7 and 8\n");
  PrintScaling({ small, large });
  std::printf("\n");
  PrintAtMost("setup_seconds_1.3M_depth8", large[1].best.Seconds(), 6.0);
  PrintAtMost("setup_seconds_1.3M_depth8_one_thread", large[0].best.Seconds(), 6.0);
  const SetupCost& memory = large[1].first;
  PrintAtMost("setup_peak_GB", 1e-9 * (memory.before + memory.Peak()), 1.5);
}
