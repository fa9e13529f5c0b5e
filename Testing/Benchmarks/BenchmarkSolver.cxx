// Conjugate gradients with one W(1,1) cycle of the patch smoother: iterations and seconds, on cubes
// in all positions and on smooth surfaces.
#include "LoadVector.h"
#include "Measure.h"
#include "Meshes.h"
#include "Poisson.h"
#include "SetupCost.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr double Degree = 3.14159265358979323846 / 180.0;
constexpr double Tolerance = 1e-8;

struct Solve
{
  Index functions = 0;
  double setup = 0.0;
  double solve = 0.0;
  int residualIterations = 0; // until |r| is below the tolerance; -1: never
  int energyIterations = 0;   // until sqrt(rᵀBr) is
};

/// First iteration whose measure is below the tolerance.
int IterationsTo(const std::vector<IterationRecord>& history, double IterationRecord::*measure)
{
  const auto found = std::find_if(history.begin(), history.end(),
    [&](const IterationRecord& record) { return record.*measure <= Tolerance; });
  return found == history.end() ? -1 : found->iteration;
}

/// (λM + L) u = λ f for the first coordinate as f, λ = 0.01 for a mesh of longest side 1.
Solve Run(const TriangleMesh& mesh, int depth, int threads)
{
  Solve result;
  const Stopwatch setup;
  SpaceOptions options;
  options.depth = depth;
  options.threads = threads;
  const FunctionSpace space = BuildFunctionSpace(mesh, options);
  const System system = BuildSystem(space, TriangleRule(2), threads);
  PoissonOptions poisson;
  poisson.screeningWeight = 0.01 * std::pow(0.25, depth);
  poisson.multigrid.threads = threads;
  poisson.solve.tolerance = Tolerance;
  poisson.solve.maximumIterations = 200;
  poisson.solve.measure = SolveOptions::Measure::Residual;
  const Multigrid multigrid =
    BuildMultigrid(space, system, poisson.screeningWeight, 1.0, poisson.multigrid);
  result.setup = setup.Seconds();
  Field f;
  f.values.resize(static_cast<Id>(mesh.points.size()), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    f.values(static_cast<Id>(i), 0) = mesh.points[i][0];
  }
  const MultiVector load = IntegrateValues(space, mesh, f, TriangleRule(2), threads);
  const Stopwatch solve;
  const PoissonSolution solution =
    SolvePoisson(space, system, multigrid, load, MultiVector(), poisson);
  result.solve = solve.Seconds();
  result.functions = space.Finest().numberOfFunctions;
  result.residualIterations = IterationsTo(solution.report.history, &IterationRecord::residual);
  result.energyIterations = IterationsTo(solution.report.history, &IterationRecord::energy);
  return result;
}

/// @param one  null: not run
void PrintRow(
  const Table& table, const std::string& name, int depth, const Solve* one, const Solve& two)
{
  table.Row({ name, std::to_string(depth), std::to_string(two.functions),
    std::to_string(two.energyIterations), std::to_string(two.residualIterations),
    Text("%.2f", two.setup), one ? Text("%.3f", one->solve) : "-", Text("%.3f", two.solve),
    Text("%.1f", 1e3 * two.solve / std::max(1, two.residualIterations)) });
}

Table MakeTable(const char* title)
{
  std::printf("\n%s, iterations from zero to 1e-8 of the start\n", title);
  return Table({ "surface", "depth", "functions", "energy", "residual", "s set-up", "s, 1 thread",
    "s, 2 threads", "ms / iteration" });
}

struct Bound
{
  std::string name;
  double measured;
  double bound;
};

std::vector<Bound> RunCubes()
{
  const Table table = MakeTable("Cube of 12 triangles rotated about (1,1,1)");
  std::vector<Bound> bounds;
  for (const auto& [depth, bound] : { std::pair{ 5, 12 }, std::pair{ 6, 16 }, std::pair{ 7, 20 } })
  {
    for (const double angle : { 0.0, 0.01, 0.1, 1.0, 5.0, 15.0, 45.0 })
    {
      const TriangleMesh cube = testing::Transform(testing::Box(1), { 1, 1, 1 }, angle * Degree);
      const Solve two = Run(cube, depth, 2);
      const Solve one = Run(cube, depth, 1);
      PrintRow(table, Text("%g degrees", angle), depth, &one, two);
      const auto add = [&, depth = depth, limit = bound](const char* measure, int iterations)
      {
        // Not converged is worse than any bound.
        bounds.push_back({ "solver_cube_" + Text("%g", angle) + "_degrees_depth" +
                             std::to_string(depth) + "_iterations_" + measure,
          iterations < 0 ? 1e3 : double(iterations), double(limit) });
      };
      add("residual", two.residualIterations);
      add("energy", two.energyIterations);
    }
  }
  return bounds;
}

/// How much faster two threads solve the largest system that is solved with one as well.
double RunSmoothSurfaces()
{
  constexpr int DeepestAlone = 7; // one thread takes too long beyond
  const Table table = MakeTable("Smooth surfaces");
  double speedUp = 0.0;
  for (const NamedMesh& mesh :
    { NamedMesh{ "sphere", testing::GeodesicSphere(160) }, RockerArm(2) })
  {
    for (const int depth : { 5, 6, 7, 8 })
    {
      const Solve two = Run(mesh.mesh, depth, 2);
      if (depth > DeepestAlone)
      {
        PrintRow(table, mesh.name, depth, nullptr, two);
        continue;
      }
      const Solve one = Run(mesh.mesh, depth, 1);
      PrintRow(table, mesh.name, depth, &one, two);
      speedUp = one.solve / two.solve;
    }
  }
  return speedUp;
}

} // namespace

int main()
{
  const std::vector<Bound> bounds = RunCubes();
  const double speedUp = RunSmoothSurfaces();
  std::printf("\n");
  for (const Bound& bound : bounds)
  {
    PrintAtMost(bound.name, bound.measured, bound.bound);
  }
  PrintAtLeast("solver_second_thread_depth7", speedUp, 1.6);
}
