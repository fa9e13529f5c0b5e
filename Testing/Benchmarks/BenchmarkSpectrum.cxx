// The lowest 100 eigenpairs of the rocker arm, from the triangles to the vectors.
#include "Measure.h"
#include "SetupCost.h"
#include "Spectrum.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Repetitions = 3;

struct Job
{
  double setup = 0.0;    // seconds of clip, space and system
  double spectrum = 0.0; // seconds of the rest
  Spectrum result;

  double Seconds() const { return setup + spectrum; }
};

Job Run(const TriangleMesh& mesh, int depth, int modes, int threads)
{
  Job job;
  const Stopwatch setup;
  SpaceOptions options;
  options.depth = depth;
  options.threads = threads;
  const FunctionSpace space = BuildFunctionSpace(mesh, options);
  const System system = BuildSystem(space, TriangleRule(2), threads);
  job.setup = setup.Seconds();
  const Stopwatch spectrum;
  SpectrumOptions spectrumOptions;
  spectrumOptions.numberOfModes = modes;
  spectrumOptions.multigrid.threads = threads;
  job.result = ComputeSpectrum(space, system, spectrumOptions);
  job.spectrum = spectrum.Seconds();
  return job;
}

Job Best(const TriangleMesh& mesh, int depth, int modes, int threads)
{
  Job best = Run(mesh, depth, modes, threads);
  for (int k = 1; k < Repetitions; ++k)
  {
    Job next = Run(mesh, depth, modes, threads);
    if (next.Seconds() < best.Seconds())
    {
      best = std::move(next);
    }
  }
  return best;
}

} // namespace

int main()
{
  const NamedMesh mesh = RockerArm(0);
  std::printf("\nSpectra on %s, %zu triangles; best of %d runs\n", mesh.name.c_str(),
    mesh.mesh.triangles.size(), Repetitions);
  const Table table({ "job", "functions", "converged", "steps", "s set-up", "s, 1 thread",
    "s, 2 threads", "residual" });
  double bounded = std::numeric_limits<double>::infinity();
  for (const auto& [depth, modes] :
    { std::pair{ 5, 100 }, std::pair{ 6, 20 }, std::pair{ 6, 100 }, std::pair{ 7, 100 } })
  {
    const Job one = Best(mesh.mesh, depth, modes, 1);
    const Job two = Best(mesh.mesh, depth, modes, 2);
    const Spectrum& spectrum = two.result;
    table.Row({ std::to_string(modes) + " pairs, depth " + std::to_string(depth),
      std::to_string(spectrum.vectors.rows()), std::to_string(spectrum.numberOfConverged),
      std::to_string(spectrum.iterations), Text("%.2f", two.setup), Text("%.2f", one.Seconds()),
      Text("%.2f", two.Seconds()),
      Text("%.1e", *std::max_element(spectrum.residuals.begin(), spectrum.residuals.end())) });
    if (depth == 6 && modes == 100 && spectrum.converged)
    {
      bounded = two.Seconds();
    }
  }
  std::printf("\n");
  PrintAtMost("spectrum100_rocker_depth6_seconds", bounded, 3.0);
}
