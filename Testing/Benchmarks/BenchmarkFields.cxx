// Fields on surfaces: steps of reactions that spread, and samples of random fields, on two threads.
// Set-up is told beside the times and not counted in them, because an animation or a series of
// samples pays for it once.
#include "Dense.h"
#include "Equations/MaternField.h"
#include "Equations/ReactionDiffusion.h"
#include "Measure.h"
#include "Meshes.h"
#include "Spaces/SpaceChoice.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Threads = 2;

std::shared_ptr<const FiniteElementSpace> SpaceOn(
  const TriangleMesh& mesh, FunctionKind kind, int depth)
{
  SpaceOptions options;
  options.depth = depth;
  options.threads = Threads;
  SpaceChoice choice;
  choice.kind = kind;
  choice.normalStabilization = 1e-2;
  return BuildSpace(mesh, options, choice, {});
}

/// The root of the area, in units of length of the space.
double SideOf(const FiniteElementSpace& space)
{
  const std::vector<double>& integrals = space.Integrals();
  return std::sqrt(std::accumulate(integrals.begin(), integrals.end(), 0.0));
}

/// Steps of Gray-Scott from noise. A pattern is ten functions long.
/// @return  seconds of a step
double MeasureSteps(const TriangleMesh& mesh, const std::string& name, FunctionKind kind, int depth,
  const Table& table)
{
  constexpr int Warm = 10;
  constexpr int Runs = 20;
  const Stopwatch watch;
  const auto space = SpaceOn(mesh, kind, depth);
  const Id functions = space->NumberOfFunctions(0);
  const ReactionSystem system = GrayScott(0.037, 0.06);
  const double spacing = SideOf(*space) / std::sqrt(double(functions));
  const double scale = 10.0 * spacing / system.patternLength;
  ReactionTerms terms{ system.diffusion, system.react, nullptr };
  for (double& diffusion : terms.diffusion)
  {
    diffusion *= scale * scale;
  }
  EquationOptions equation;
  equation.solve.tolerance = 1e-4;
  equation.multigrid.threads = Threads;
  ReactionDiffusion evolution(space, terms, equation, system.step, Threads);
  MultiVector start(functions, 2);
  const MultiVector noise = gridfem::testing::RandomValues(functions, 1);
  for (Id k = 0; k < functions; ++k)
  {
    system.startOfDisturbance(0.5 * (1.0 + noise(k, 0)), &start(k, 0));
  }
  evolution.Start(std::move(start));
  int iterations = 0;
  const auto step = [&](int)
  {
    const SolveReport report = evolution.Advance(Threads);
    if (!report.converged)
    {
      throw std::runtime_error("a step has not converged");
    }
    iterations = report.iterations;
  };
  for (int k = 0; k < Warm; ++k)
  {
    step(k);
  }
  const double setUp = watch.Seconds();
  const double seconds = LeastSeconds(Runs, step);
  table.Row({ name, kind == FunctionKind::Hats ? "hats" : "grid, depth " + std::to_string(depth),
    std::to_string(functions), Text("%.2f", setUp), std::to_string(iterations),
    Text("%.1f", 1e3 * seconds) });
  return seconds;
}

/// A hundred samples of a Matérn field, with their values at the points.
/// @return  seconds of all, for each million functions
double MeasureSamples(const TriangleMesh& mesh, int depth, int smoothness, const Table& table)
{
  constexpr Id Samples = 100;
  constexpr Id AtOnce = 8;      // as GaussianFieldSolver
  constexpr double Range = 0.1; // of the root of the area
  const Stopwatch watch;
  const auto space = SpaceOn(mesh, FunctionKind::Grid, depth);
  MaternOptions options;
  options.smoothness = smoothness;
  options.kappa = std::sqrt(8.0 * smoothness) / (Range * SideOf(*space));
  options.solve.tolerance = 1e-6;
  options.multigrid.threads = Threads;
  const MaternField field(space, options, Threads);
  const double setUp = watch.Seconds();
  const Stopwatch ofSamples;
  int iterations = 0;
  for (Id first = 0; first < Samples; first += AtOnce)
  {
    const FieldSamples samples = field.Sample(1, first, std::min(AtOnce, Samples - first), Threads);
    if (!samples.report.converged)
    {
      throw std::runtime_error("a sample has not converged");
    }
    iterations = samples.report.iterations;
    space->ValuesAtPoints(samples.coefficients, Threads);
  }
  const double seconds = ofSamples.Seconds();
  table.Row({ std::to_string(smoothness), std::to_string(space->NumberOfFunctions(0)),
    std::to_string(mesh.points.size()), Text("%.1f", setUp), std::to_string(iterations),
    Text("%.1f", seconds) });
  return seconds * 1e6 / static_cast<double>(space->NumberOfFunctions(0));
}

} // namespace

int main()
{
  std::printf("Steps of two species (Gray-Scott)\n\n");
  const Table steps({ "on", "by", "functions", "set-up, s", "iterations", "ms a step" });
  const double hats =
    MeasureSteps(gridfem::testing::GeodesicSphere(142), "sphere", FunctionKind::Hats, 7, steps);
  const TriangleMesh scan =
    gridfem::testing::ReadMesh(gridfem::testing::RealMesh("armadillo_100k.ply"));
  const double grid = MeasureSteps(scan, "armadillo", FunctionKind::Grid, 7, steps);
  std::printf("\nA hundred samples of a random field on the armadillo\n\n");
  const Table samples({ "smoothness", "functions", "points", "set-up, s", "iterations", "s" });
  const double first = MeasureSamples(scan, 9, 1, samples);
  const double second = MeasureSamples(scan, 9, 2, samples);
  std::printf("\n");
  PrintAtMost("fields/ms-a-step-hats", 1e3 * hats, 60.0);
  PrintAtMost("fields/ms-a-step-grid", 1e3 * grid, 60.0);
  PrintAtMost("fields/seconds-of-100-samples-per-million-functions-1", first, 60.0);
  PrintAtMost("fields/seconds-of-100-samples-per-million-functions-2", second, 60.0);
  return 0;
}
