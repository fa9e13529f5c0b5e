// Iterations and seconds of the solver: rotated cubes, and the peers on the same
// surface.
#include "AlgebraicMultigrid.h"
#include "Base/Parallel.h"
#include "Discretization.h"
#include "Hierarchy.h"
#include "Largest.h"
#include "Measure.h"
#include "Meshes.h"
#include "PeerTimes.h"
#include "Problems.h"
#include "SetupCost.h"

#include <algorithm>
#include <cstdio>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr double Degree = 3.14159265358979323846 / 180.0;
constexpr int Threads = 2;
constexpr int Never = 1000; // counts as iterations where a target is not reached: beyond any bound

struct Bound
{
  std::string name;
  double measured;
  double bound;
};

void Print(const std::vector<Bound>& bounds)
{
  for (const Bound& bound : bounds)
  {
    PrintAtMost(bound.name, bound.measured, bound.bound);
  }
}

/// First iteration whose measure is below 1e-8.
int IterationsTo(const std::vector<IterationRecord>& history, double IterationRecord::*measure)
{
  const auto found = std::find_if(history.begin(), history.end(),
    [&](const IterationRecord& record) { return record.*measure <= 1e-8; });
  return found == history.end() ? Never : found->iteration;
}

/// Conjugate gradients until the residual is 1e-8 of its start.
struct Convergence
{
  double functions = 0.0;
  double seconds = 0.0;
  double energy = 0.0;   // iterations until sqrt(rᵀBr) is 1e-8 of its start
  double residual = 0.0; // until |r| is

  explicit Convergence(const GridProblem& grid)
  {
    PoissonOptions options = grid.options;
    options.solve.tolerance = 1e-8;
    options.solve.maximumIterations = 200;
    options.solve.measure = SolveOptions::Measure::Residual;
    const Stopwatch watch;
    const std::vector<IterationRecord> history =
      SolvePoisson(testing::ViewOf(grid.space, grid.system), *grid.multigrid, grid.values,
        grid.gradients, options)
        .report.history;
    seconds = watch.Seconds();
    functions = grid.space.Finest().numberOfFunctions;
    energy = IterationsTo(history, &IterationRecord::energy);
    residual = IterationsTo(history, &IterationRecord::residual);
  }
};

GridProblem Build(const TriangleMesh& mesh, int depth)
{
  GridProblem grid = SetUp(mesh, depth, Threads);
  ChooseColors(grid, 1);
  return grid;
}

std::vector<Bound> RunCubes()
{
  std::printf("\nCube of 12 triangles rotated about (1,1,1): iterations to 1e-8 of the start\n");
  const Table table(
    { "angle, degrees", "depth", "functions", "energy", "residual", "s", "ms / iteration" });
  std::vector<Bound> bounds;
  for (const auto& [depth, bound] : { std::pair{ 5, 12 }, std::pair{ 6, 16 }, std::pair{ 7, 20 } })
  {
    double worst = 0.0;
    for (const double angle : { 0.0, 0.01, 0.1, 1.0, 5.0, 15.0, 30.0, 45.0 })
    {
      const TriangleMesh cube = testing::Transform(testing::Box(1), { 1, 1, 1 }, angle * Degree);
      const Convergence cg(Build(cube, depth));
      table.Row({ Text("%g", angle), std::to_string(depth), Text("%.0f", cg.functions),
        Text("%.0f", cg.energy), Text("%.0f", cg.residual), Text("%.3f", cg.seconds),
        Text("%.1f", 1e3 * cg.seconds / cg.residual) });
      worst = testing::Larger(worst, cg.residual);
    }
    bounds.push_back({ "cube_worst_angle_iterations_to_residual_1e-8_depth" + std::to_string(depth),
      worst, double(bound) });
  }
  return bounds;
}

void RunPeers()
{
  const PeerJob job{ RockerArm(3), 8, 1e-4, 3 };
  const PeerTimes times = MeasurePeers(job);
  PrintPeers(job, times);
  const auto& [one, two] = times.grid;
  PrintAtMost("solve_over_faster_amg_one_thread", one.solve / times.FasterSolve().solve, 0.3);
  PrintAtMost("solve_seconds_two_threads", two.solve, 0.2);
  PrintAtMost("solve_three_columns_over_one", two.solve3 / two.solve, 1.6);
  PrintAtMost("solve_three_columns_over_cholmod_substitutions",
    two.solve3 / std::min(times.cholmod[0].solve3, times.cholmod[1].solve3), 1.0);
  PrintAtLeast("cycle_second_thread", one.cycle / two.cycle, 1.6);
}

constexpr double HatTolerance = 1e-8;

/// Iterations of conjugate gradients on a hat system to a residual of 1e-8.
struct HatSolve
{
  double iterations = Never;
  double seconds = 0.0; // without set-up
};

struct HatIterations
{
  HatSolve hybrid;
  HatSolve pseudo; // its values from the grid by pseudo-evaluation
  HatSolve boomerAmg;
  HatSolve gamg;
  // Cycles of the hybrid alone: W with ten Gauss-Seidel sweeps everywhere, as in the thesis, and
  // with sweeps over the hats that also relax their groups.
  double thesisCycles = Never;
  double groupedCycles = Never;
};

HatSolve Solve(AlgebraicMultigrid& amg, const HatProblem& problem)
{
  constexpr int Most = 200;
  amg.Setup();
  const Eigen::VectorXd b = problem.b.col(0);
  Eigen::VectorXd x;
  const Stopwatch watch;
  const int iterations = amg.Solve(b, x, HatTolerance, Most);
  return { double(iterations < Most ? iterations : Never), watch.Seconds() };
}

int Iterations(const SolveReport& report)
{
  return report.converged ? report.iterations : Never;
}

/// Cycles of the hybrid alone, to the same residual as conjugate gradients.
int CyclesAlone(const TriangleMesh& mesh, const HybridProblem& hybrid, double weight,
  const testing::HybridCycle& options)
{
  SolveOptions solve;
  solve.tolerance = HatTolerance;
  solve.maximumIterations = 30;
  solve.measure = SolveOptions::Measure::Residual;
  const Multigrid cycle = hybrid.BuildCycle(weight, options);
  MultiVector b;
  Multiply(cycle.Matrix(), hybrid.ToFunctions(ColorsAtPoints(mesh, 1)), b);
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  return Iterations(SolveCycles(OperatorOf(cycle), CycleOf(cycle), b, x, solve));
}

HatSolve Solve(const TriangleMesh& mesh, const HybridProblem& hybrid, double weight)
{
  SolveOptions solve;
  solve.tolerance = HatTolerance;
  solve.maximumIterations = 200;
  solve.measure = SolveOptions::Measure::Residual;
  testing::HybridCycle options;
  options.grid.threads = 1; // as the peers
  const Multigrid cycle = hybrid.BuildCycle(weight, options);
  MultiVector b;
  Multiply(cycle.Matrix(), hybrid.ToFunctions(ColorsAtPoints(mesh, 1)), b);
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  const Stopwatch watch;
  const int iterations =
    Iterations(SolveConjugateGradients(OperatorOf(cycle), CycleOf(cycle), b, x, solve));
  return { double(iterations), watch.Seconds() };
}

HatIterations RunHats(
  const TriangleMesh& mesh, const HybridProblem& hybrid, const HybridProblem& pseudo, double weight)
{
  HatIterations result;
  HatProblem problem = AssembleProblem(mesh, weight);
  ChooseColors(mesh, problem, 1);
  result.boomerAmg = Solve(*MakeBoomerAmg(problem.A), problem);
  result.gamg = Solve(*MakeGamg(problem.A), problem);
  result.hybrid = Solve(mesh, hybrid, weight);
  result.pseudo = Solve(mesh, pseudo, weight);

  testing::HybridCycle tenSweeps = ThesisHybrid();
  result.thesisCycles = CyclesAlone(mesh, hybrid, weight, tenSweeps);
  tenSweeps.relaxGroups = true;
  result.groupedCycles = CyclesAlone(mesh, hybrid, weight, tenSweeps);
  return result;
}

void RunHatTable()
{
  std::printf("\nHat functions, rocker arm: conjugate gradients to residual 1e-8, iterations and "
              "seconds without set-up, one thread or process each; sweeps over hats also relax "
              "their groups; pseudo: values from the grid by pseudo-evaluation; thesis: the hybrid "
              "alone, W, ten Gauss-Seidel sweeps, no groups, cycles to 1e-8; groups: with them\n");
  const Table table({ "vertices", "depth", "screening", "hybrid", "pseudo", "BoomerAMG", "GAMG",
    "s hybrid", "s pseudo", "s BoomerAMG", "s GAMG", "thesis", "groups" });
  double worst = 0.0;
  double againstPeers = 0.0;
  double thesis = 0.0;
  double grouped = 0.0;
  for (const int subdivisions : { 0, 1, 2, 3 })
  {
    const int depth = 5 + subdivisions;
    const TriangleMesh mesh = RockerArm(subdivisions).mesh;
    const HybridProblem hybrid = SetUpHybrid(mesh, depth, Threads);
    const HybridProblem pseudo = SetUpHybrid(
      mesh, depth, Threads, FunctionSupport::ConnectivityAware, HatTransfer::PseudoEvaluation);
    for (const double weight : { 1e-2, 1.0, 1e2, 1e4 })
    {
      const HatIterations row = RunHats(mesh, hybrid, pseudo, weight);
      const std::array<HatSolve, 4> solves{ row.hybrid, row.pseudo, row.boomerAmg, row.gamg };
      std::vector<std::string> cells{ std::to_string(mesh.points.size()), std::to_string(depth),
        Text("%g", weight) };
      for (const HatSolve& solve : solves)
      {
        cells.push_back(Text("%.0f", solve.iterations));
      }
      for (const HatSolve& solve : solves)
      {
        cells.push_back(Text("%.3f", solve.seconds));
      }
      cells.push_back(Text("%.0f", row.thesisCycles));
      cells.push_back(Text("%.0f", row.groupedCycles));
      table.Row(cells);
      worst = std::max(worst, row.hybrid.iterations);
      againstPeers = std::max(againstPeers,
        row.hybrid.iterations / std::min(row.boomerAmg.iterations, row.gamg.iterations));
      thesis = std::max(thesis, row.thesisCycles);
      grouped = std::max(grouped, row.groupedCycles);
    }
  }
  PrintAtMost("hat_hybrid_worst_iterations_to_residual_1e-8", worst, 18.0);
  PrintAtMost("hat_hybrid_worst_iterations_over_fewer_of_the_peers", againstPeers, 1.0);
  PrintAtMost("hat_hybrid_ten_sweeps_worst_cycles_to_residual_1e-8", thesis, 10.0);
  PrintAtMost("hat_hybrid_ten_sweeps_with_groups_worst_cycles_to_residual_1e-8", grouped, 10.0);
}

/// Table 4.3 of the thesis compares grids that have as many functions as the mesh has vertices.
/// Here are grids with a third as many, with 1.4 times as many, and with 5.6 times. [T Fig. 4.7]
void RunGridsOfHats()
{
  constexpr double Weight = 1e-2; // the slowest
  std::printf("\nHat functions, the thesis' ten sweeps: cycles to residual 1e-8 over grids that "
              "are one and two levels finer\n");
  const Table table({ "vertices", "depth", "functions", "thesis" });
  std::array<double, 3> worst{};
  for (const int subdivisions : { 0, 1, 2, 3 })
  {
    const TriangleMesh mesh = RockerArm(subdivisions).mesh;
    for (const int finer : { 0, 1, 2 })
    {
      const int depth = 5 + subdivisions + finer;
      const HybridProblem hybrid = SetUpHybrid(mesh, depth, Threads);
      const double cycles = CyclesAlone(mesh, hybrid, Weight, ThesisHybrid());
      table.Row({ std::to_string(mesh.points.size()), std::to_string(depth),
        std::to_string(hybrid.space.NumberOfFunctions(1)), Text("%.0f", cycles) });
      worst[finer] = std::max(worst[finer], cycles);
    }
  }
  PrintAtMost("hat_hybrid_ten_sweeps_grid_one_deeper_worst_cycles", worst[1], 10.0);
  PrintAtMost("hat_hybrid_ten_sweeps_grid_two_deeper_worst_cycles", worst[2], 10.0);
}

double BytesOf(const SparseMatrix& A)
{
  return double(A.NonZeros()) * (sizeof(double) + sizeof(Index)) + double(A.rows) * sizeof(Id);
}

/// The least memory traffic of a W(1,1) cycle: the matrices, factors and vectors of every sweep,
/// residual and transfer on all levels except the coarsest, once for every visit.
double BytesOfCycle(const Multigrid& multigrid, int columns)
{
  const std::vector<MultigridLevel>& levels = multigrid.Levels();
  double bytes = 0.0;
  double visits = 1.0;
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
  {
    const MultigridLevel& level = levels[l];
    const double vector = double(columns) * sizeof(double);
    const double fine = vector * double(level.A.rows);
    const double coarse = vector * double(levels[l + 1].A.rows);
    // Single precision has the matrix in a form of its own.
    const double matrix = level.smoother->IsSingle() ? 0.0 : BytesOf(level.A);
    const double sweep = matrix + double(level.smoother->Memory()) + 3.0 * fine;
    const double residual = BytesOf(level.A) + 3.0 * fine;
    const double transfers =
      BytesOf(level.restriction) + BytesOf(level.prolongation) + 3.0 * fine + 2.0 * coarse;
    bytes += visits * (2.0 * sweep + residual + transfers);
    visits *= l + 2 < levels.size() ? 2.0 : 1.0;
  }
  return bytes;
}

constexpr int Runs = 15;

/// Bytes per second of a sum on all threads.
double ReadBandwidth()
{
  const std::vector<double> numbers(256 * 1000 * 1000 / sizeof(double), 1.0);
  const auto count = static_cast<Id>(numbers.size());
  double sum = 0.0;
  const double seconds = LeastSeconds(Runs,
    [&](int)
    {
      sum += ParallelSum(count, Threads, 0.0,
        [&](Id begin, Id end)
        { return Eigen::Map<const Eigen::ArrayXd>(&numbers[begin], end - begin).sum(); });
    });
  return sum > 0.0 ? double(count) * sizeof(double) / seconds : 0.0;
}

/// The time of a cycle over the time in which memory could deliver its data.
void RunMemory()
{
  const GridProblem grid = SetUp(RockerArm(3).mesh, 8, Threads);
  const double bandwidth = ReadBandwidth();
  std::printf("\nW cycle of %d functions, %d threads; memory delivers %.1f GB/s\n",
    grid.space.Finest().numberOfFunctions, Threads, 1e-9 * bandwidth);
  const Table table({ "columns", "ms", "MB", "ms for them" });
  for (const int columns : { 1, 3 })
  {
    const MultiVector b = MultiVector::Ones(grid.space.Finest().numberOfFunctions, columns);
    MultiVector x;
    const double seconds = LeastSeconds(Runs, [&](int) { grid.multigrid->Precondition(b, x); });
    const double bytes = BytesOfCycle(*grid.multigrid, columns);
    table.Row({ std::to_string(columns), Text("%.1f", 1e3 * seconds), Text("%.0f", 1e-6 * bytes),
      Text("%.1f", 1e3 * bytes / bandwidth) });
    PrintAtMost(
      std::string("cycle_over_memory_time_") + (columns == 1 ? "one_column" : "three_columns"),
      seconds * bandwidth / bytes, columns == 1 ? 7.0 : 10.0);
  }
}

} // namespace

/// Arguments: parts of peers, hats, grids, cubes, memory.
int main(int argc, char** argv)
{
  const Parts parts(argc, argv);
  if (parts.Want("peers")) // first: it starts processes, which must come before threads
  {
    RunPeers();
  }
  if (parts.Want("hats"))
  {
    const MessagePassing libraries;
    RunHatTable();
  }
  if (parts.Want("grids"))
  {
    RunGridsOfHats();
  }
  if (parts.Want("cubes"))
  {
    Print(RunCubes());
  }
  if (parts.Want("memory"))
  {
    RunMemory();
  }
}
