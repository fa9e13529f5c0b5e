// Times of cycles and solves on the CPU and on the GPU of this machine, as a table.
//   MeasureDevice [FOLDER]   folder of the real meshes, see GRIDFEM_DATA_DIR
#include "Krylov/PrecisionFallback.h"
#include "Largest.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/SpectrumSolver.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace
{

using namespace gridfem;

struct Job
{
  const char* mesh;
  int subdivisions;
  int depth;
  FunctionKind kind;
};

class Stopwatch
{
public:
  double Milliseconds() const
  {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_)
      .count();
  }

private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

struct Times
{
  std::string where;
  double setUp = 0.0;     // ms, from levels to a hierarchy
  double newValues = 0.0; // ms, for a new weight
  double cycle[3] = {};   // ms, for 1, 3 and 32 columns, with copies
  double onDevice[3] = {};
  double solve = 0.0; // ms, to 1e-9 of the residual
  int iterations = 0;
  double bytesPerFunction = 0.0;
  MultiVector values; // of the solution at points
};

constexpr int Columns[3] = { 1, 3, 32 };

void MeasureCycles(const Multigrid& multigrid, Times& times)
{
  for (int k = 0; k < 3; ++k)
  {
    const MultiVector b = MultiVector::Random(multigrid.Matrix().rows, Columns[k]);
    MultiVector x;
    multigrid.Precondition(b, x); // the first one takes memory
    constexpr int Repeats = 10;
    const Stopwatch watch;
    for (int repeat = 0; repeat < Repeats; ++repeat)
    {
      multigrid.Precondition(b, x);
      times.onDevice[k] +=
        multigrid.OnDevice() ? 1e3 * multigrid.OnDevice()->Seconds() / Repeats : 0.0;
    }
    times.cycle[k] = watch.Milliseconds() / Repeats;
  }
}

Times Measure(const LocalSurface& surface, DeviceChoice device)
{
  MultigridOptions options;
  options.device = device;
  const SurfaceSpace& space = surface.Space();
  const double weight = surface.WeightInSpaceUnits(100.0);
  Times times;
  std::vector<MultigridLevel> levels = BuildMultigridLevels(space, weight, 1.0, options);
  const Stopwatch ofSetUp;
  Multigrid multigrid(std::move(levels), options);
  times.setUp = ofSetUp.Milliseconds();
  UpdateMultigrid(space, 2.0 * weight, 1.0, multigrid);
  const Stopwatch ofUpdate;
  UpdateMultigrid(space, weight, 1.0, multigrid);
  times.newValues = ofUpdate.Milliseconds();
  MeasureCycles(multigrid, times);
  MultiVector b(multigrid.Matrix().rows, 1);
  MultiVector x = b;
  for (Id i = 0; i < x.rows(); ++i)
  {
    x(i, 0) = std::sin(12.9898 * double(i % 10007));
  }
  Multiply(multigrid.Matrix(), x, b);
  x.setZero();
  SolveOptions solve;
  solve.measure = SolveOptions::Measure::Residual;
  solve.tolerance = 1e-9;
  const Stopwatch ofSolve;
  const SolveReport report = SolveWithFallback(IterationType::ConjugateGradients,
    OperatorOf(multigrid), CycleWithFallback(multigrid), b, x, solve);
  times.solve = ofSolve.Milliseconds();
  times.iterations = report.iterations;
  times.where = report.where;
  times.bytesPerFunction =
    multigrid.OnDevice() ? double(multigrid.OnDevice()->Memory()) / double(b.rows()) : 0.0;
  times.values = surface.ValuesAtPoints(x);
  return times;
}

void Print(const Job& job, Id functions, const Times& times)
{
  std::printf(
    "| %s, depth %d | %lld | %s | %.0f | %.1f | %.2f (%.2f) | %.2f (%.2f) | %.2f (%.2f) | %.0f "
    "(%d) | %.0f |\n",
    job.mesh, job.depth, static_cast<long long>(functions), times.where.c_str(), times.setUp,
    times.newValues, times.cycle[0], times.onDevice[0], times.cycle[1], times.onDevice[1],
    times.cycle[2], times.onDevice[2], times.solve, times.iterations, times.bytesPerFunction);
  std::fflush(stdout);
}

void PrintAtMost(const char* name, double measured, double bound)
{
  std::printf("RATIO %s %.3g <= %.3g\n", name, measured, bound);
}

/// A solve on both devices.
/// @param boundOfCycle  ms on the device; 0: none
void Compare(const std::string& folder, const Job& job, double boundOfCycle)
{
  TriangleMesh mesh = testing::ReadMesh(folder + "/" + job.mesh);
  for (int k = 0; k < job.subdivisions; ++k)
  {
    mesh = testing::SubdivideInPlane(mesh);
  }
  SurfaceOptions options = StabilizedSurface();
  options.space.depth = job.depth;
  options.choice.kind = job.kind;
  Stages stages;
  LocalSurface surface(stages, std::make_shared<const TriangleMesh>(std::move(mesh)), options);
  surface.Prepare({});
  const Id functions = surface.Space().NumberOfFunctions(0);
  const Times onCpu = Measure(surface, DeviceChoice::Cpu);
  const Times onGpu = Measure(surface, DeviceChoice::Gpu);
  Print(job, functions, onCpu);
  Print(job, functions, onGpu);
  const double range =
    onCpu.values.maxCoeff<Eigen::PropagateNaN>() - onCpu.values.minCoeff<Eigen::PropagateNaN>();
  PrintAtMost("device_solution_difference",
    (onCpu.values - onGpu.values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() / range, 1e-6);
  PrintAtMost("device_solve_over_cpu", onGpu.solve / onCpu.solve, 1.0);
  if (boundOfCycle > 0.0)
  {
    PrintAtMost("device_cycle_ms", onGpu.onDevice[0], boundOfCycle);
  }
}

/// Seconds for modes on a device, without the functions.
double ModesOn(const std::shared_ptr<const TriangleMesh>& mesh, DeviceChoice device,
  std::vector<double>& eigenvalues)
{
  SurfaceOptions options = SpectrumSolver::SurfaceDefaults();
  options.space.depth = 8;
  Stages stages;
  LocalSurface surface(stages, mesh, options);
  surface.Prepare({});
  SpectrumSolver::Options modes;
  modes.numberOfModes = 100;
  modes.equation.multigrid.device = device;
  SpectrumSolver solver;
  const Stopwatch watch;
  eigenvalues = solver.Update(surface, {}, modes, 0).eigenvalues;
  return 1e-3 * watch.Milliseconds();
}

void CompareModes(const std::string& folder)
{
  const auto mesh =
    std::make_shared<const TriangleMesh>(testing::ReadMesh(folder + "/dragon_871k.ply"));
  std::vector<double> onCpu;
  std::vector<double> onGpu;
  const double cpu = ModesOn(mesh, DeviceChoice::Cpu, onCpu);
  const double gpu = ModesOn(mesh, DeviceChoice::Gpu, onGpu);
  double difference = 0.0;
  for (std::size_t k = 1; k < onCpu.size(); ++k)
  {
    difference = testing::Larger(difference, std::abs(onGpu[k] / onCpu[k] - 1.0));
  }
  std::printf(
    "\n100 modes of the dragon, depth 8: %.2f s on the CPU, %.2f s on the GPU\n", cpu, gpu);
  PrintAtMost("device_modes_difference", difference, 2e-6); // the tolerance of both is 1e-6
  PrintAtMost("device_modes_s", gpu, 0.5);
}

} // namespace

int main(int count, char** arguments)
{
  const char* const given = std::getenv("GRIDFEM_DATA_DIR");
  const std::string folder = count > 1 ? arguments[1] : given ? given : "../shared/data";
  std::printf(
    "| mesh | functions | where | set-up | new values | cycle, 1 column (on the device) | "
    "3 columns | 32 columns | solve (iterations) | bytes per function |\n"
    "|---|---|---|---|---|---|---|---|---|---|\n");
  Compare(folder, { "rocker_arm.ply", 2, 8, FunctionKind::Grid }, 0.6);
  Compare(folder, { "dragon_871k.ply", 0, 9, FunctionKind::Grid }, 2.5);
  Compare(folder, { "armadillo_100k.ply", 0, 7, FunctionKind::Grid }, 0.0);
  Compare(folder, { "armadillo_100k.ply", 0, 7, FunctionKind::Hats }, 0.0);
  Compare(folder, { "armadillo_100k.ply", 0, 6, FunctionKind::SmoothGrid }, 0.0);
  CompareModes(folder);
  return 0;
}
