// Shows the effect of the weight of the normal derivative. Prints the iterations to an energy of
// 1e-8 at depths 5 to 8, and the difference from the solutions of depth 8 without the weight.
// [NUMERICS §6]
#include "Hybrid.h"
#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Measure.h"
#include "Meshes.h"
#include "SetupCost.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr std::array<double, 4> Weights{ 1e-12, 1e-3, 1e-2, 1e-1 };
constexpr int CoarsestDepth = 5;
constexpr int FinestDepth = 8;

struct Surface
{
  std::string name;
  TriangleMesh mesh;
};

std::vector<Surface> Surfaces()
{
  std::vector<Surface> surfaces = { { "sphere",
    testing::Transform(testing::GeodesicSphere(160), { 1, 2, 3 }, 0.4) } };
  for (const auto& [name, file] :
    { std::pair{ "rocker arm", "rocker_arm.ply" }, std::pair{ "armadillo", "armadillo_100k.ply" },
      std::pair{ "fandisk", "fandisk_32k.ply" }, std::pair{ "turbine", "turbine_cad_18k.ply" } })
  {
    surfaces.push_back({ name, benchmarks::RealMesh(name, file).mesh });
  }
  for (const double angle : { 0.1, 1.0, 45.0 })
  {
    constexpr double Degree = 3.14159265358979323846 / 180.0;
    surfaces.push_back({ Text("cube of %g degrees", angle),
      testing::Transform(testing::Box(40), { 1, 1, 1 }, angle * Degree) });
  }
  return surfaces;
}

struct Answer
{
  int iterations = 0;
  bool converged = false;
  MultiVector atPoints;
};

Answer Solve(
  const TriangleMesh& mesh, const GridFunctions& space, double normalWeight, double tolerance)
{
  const LevelOperators system = BuildLevelOperators(space, TriangleRule(2), 0, 256, normalWeight);
  PoissonOptions options;
  options.screeningWeight = 100.0 / SurfaceArea(mesh) * std::pow(space.GetGrid().spacing, 2);
  options.solve.tolerance = tolerance;
  options.solve.maximumIterations = 300;
  const Multigrid multigrid =
    BuildMultigrid(testing::ViewOf(space, system), options.screeningWeight, 1.0, options.multigrid);
  const MultiVector load = IntegrateValues(
    space, mesh, { FieldAssociation::Points, testing::Waves(mesh) }, TriangleRule(2));
  const PoissonSolution solution =
    SolvePoisson(testing::ViewOf(space, system), multigrid, load, {}, options);
  return { solution.report.iterations, solution.report.converged,
    EvaluateAtPoints(space, solution.coefficients) };
}

GridFunctions SpaceOf(const TriangleMesh& mesh, int depth)
{
  SpaceOptions options;
  options.depth = depth;
  return BuildGridFunctions(mesh, options);
}

/// A row of the table per depth. Returns the iterations with the recommended weight at most.
int RunSurface(const Surface& surface, const Table& table)
{
  const MultiVector reference =
    Solve(surface.mesh, SpaceOf(surface.mesh, FinestDepth), Weights[0], 1e-10).atPoints;
  int most = 0;
  for (int depth = CoarsestDepth; depth <= FinestDepth; ++depth)
  {
    const GridFunctions space = SpaceOf(surface.mesh, depth);
    std::vector<std::string> cells = { surface.name, std::to_string(depth),
      std::to_string(space.Finest().numberOfFunctions) };
    for (const double weight : Weights)
    {
      const Answer answer = Solve(surface.mesh, space, weight, 1e-8);
      const double difference = (answer.atPoints - reference).norm() / reference.norm();
      cells.push_back((answer.converged ? "" : ">") + std::to_string(answer.iterations) + " / " +
                      Text("%.1e", difference));
      most = weight == 1e-2 ? std::max(most, answer.iterations) : most;
    }
    table.Row(cells);
  }
  return most;
}

} // namespace

int main()
{
  std::printf(
    "\nWeight s of the normal derivative, lambda = 100 / area: iterations to energy 1e-8 / "
    "L2 difference at the points to depth 8 with s = 1e-12\n");
  const Table table({ "surface", "depth", "functions", "s = 1e-12", "1e-3", "1e-2", "1e-1" });
  int most = 0;
  for (const Surface& surface : Surfaces())
  {
    most = std::max(most, RunSurface(surface, table));
  }
  PrintAtMost("normal_stabilization_1e-2_worst_iterations_to_energy_1e-8", most, 12.0);
}
