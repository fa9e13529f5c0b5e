#include "SpectrumJobs.h"
#include "Discretization.h"

#include "AlgebraicMultigrid.h"
#include "Base/LargeMemory.h"
#include "Cholmod.h"
#include "Integrals/Evaluation.h"
#include "Measure.h"
#include "Solvers/SpectrumSolver.h"
#include "Spectrum/Spectrum.h"

#include <functional>
#include <memory>

namespace gridfem::benchmarks
{

namespace
{

/// Bytes that a job takes, more or less.
constexpr double UsualPeak = 2e9;

/// The numbers of a job through the pipe of its process.
SpectrumJob InOwnProcessWithPeak(const std::function<SpectrumJob()>& body, double limit = HUGE_VAL)
{
  const LimitedRun run = InOwnProcess(
    [&]
    {
      WarmMemory(UsualPeak);
      ReleaseFreeMemory();
      const double before = ResidentBytes();
      ResetPeak();
      const Stopwatch watch;
      const SpectrumJob job = body();
      std::vector<double> packed{ watch.Seconds(), PeakBytes() - before, job.unknowns, job.setup,
        job.steps, job.converged };
      packed.insert(packed.end(), job.eigenvalues.begin(), job.eigenvalues.end());
      return packed;
    },
    limit);
  SpectrumJob job;
  if (run.isStopped)
  {
    job.isStopped = true;
    job.seconds = limit;
    job.peak = run.peak;
    return job;
  }
  auto next = run.numbers.begin();
  for (double* field :
    { &job.seconds, &job.peak, &job.unknowns, &job.setup, &job.steps, &job.converged })
  {
    *field = *next++;
  }
  job.eigenvalues.assign(next, run.numbers.end());
  return job;
}

} // namespace

SpectrumJob GridSpectrum(
  const TriangleMesh& mesh, int depth, int modes, int threads, FunctionSupport support)
{
  return InOwnProcessWithPeak(
    [&]
    {
      SpectrumJob job;
      const MemoryReuse reuse; // as around every filter
      const Stopwatch setup;
      SpaceOptions options;
      options.depth = depth;
      options.threads = threads;
      options.connectivityAware = support == FunctionSupport::ConnectivityAware;
      const GridFunctions space = BuildGridFunctions(mesh, options);
      const LevelOperators system = BuildLevelOperators(space, TriangleRule(2), threads);
      job.setup = setup.Seconds();
      SpectrumOptions spectrum;
      spectrum.numberOfModes = modes;
      spectrum.multigrid.threads = threads;
      const Spectrum result = ComputeSpectrum(testing::ViewOf(space, system), spectrum);
      EvaluateAtPoints(space, result.vectors, threads);
      job.unknowns = space.Finest().numberOfFunctions;
      job.steps = result.iterations;
      job.converged = result.numberOfConverged;
      const double spacing = space.GetGrid().spacing;
      for (const double value : result.eigenvalues)
      {
        job.eigenvalues.push_back(value / (spacing * spacing));
      }
      return job;
    });
}

SpectrumJob SolverSpectrum(
  const TriangleMesh& mesh, FunctionKind kind, int depth, int modes, int threads)
{
  return InOwnProcessWithPeak(
    [&]
    {
      const MemoryReuse reuse; // as around every filter
      SurfaceOptions surface = SpectrumSolver::SurfaceDefaults();
      surface.space.depth = depth;
      surface.space.threads = threads;
      surface.choice.kind = kind;
      SpectrumSolver::Options options;
      options.numberOfModes = modes;
      const SpectrumSolver::Result result =
        SpectrumSolver::Solve(std::make_shared<const TriangleMesh>(mesh), {}, options, surface);
      SpectrumJob job;
      job.unknowns = static_cast<double>(result.spectrum.vectors.rows());
      job.steps = result.spectrum.iterations;
      job.converged = result.spectrum.numberOfConverged;
      job.eigenvalues = result.eigenvalues;
      return job;
    });
}

SpectrumJob ShiftInvertSpectrum(HatEigensolver solver, const TriangleMesh& mesh, int modes,
  int blasThreads, double tolerance, double limit)
{
  return InOwnProcessWithPeak(
    [&]
    {
      const MessagePassing libraries;
      SetBlasThreads(blasThreads);
      SpectrumJob job;
      const Stopwatch setup;
      const CotangentSystem hats = AssembleCotangents(mesh);
      job.setup = setup.Seconds();
      const HatSpectrum result = solver(hats, modes, tolerance);
      job.unknowns = static_cast<double>(hats.mass.rows());
      job.steps = result.solves;
      job.converged = static_cast<double>(result.eigenvalues.size());
      job.eigenvalues = result.eigenvalues;
      return job;
    },
    limit);
}

std::vector<double> SphereEigenvalues(std::size_t count)
{
  std::vector<double> values;
  for (int l = 0; values.size() < count; ++l)
  {
    values.insert(values.end(), 2 * l + 1, l * (l + 1.0));
  }
  values.resize(count);
  return values;
}

} // namespace gridfem::benchmarks
