// The kernels one by one, on the rocker arm at depth 7: google-benchmark, its options apply.
// Arguments: threads; columns where there are two.
#include "Discretization.h"
#include "Integrals/LoadVector.h"
#include "SetupCost.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

namespace
{

using namespace gridfem;

constexpr int Depth = 7;

/// The data of all kernels, built once.
struct Problem
{
  TriangleMesh mesh = benchmarks::RockerArm(2).mesh;
  GridFunctions space;
  LevelOperators system;
  double lambda = 0.01 * std::pow(0.25, Depth);
  std::unique_ptr<Multigrid> multigrid;

  Problem()
  {
    SpaceOptions options;
    options.depth = Depth;
    space = BuildGridFunctions(mesh, options);
    system = BuildLevelOperators(space, TriangleRule(2));
    multigrid = std::make_unique<Multigrid>(
      BuildMultigrid(testing::ViewOf(space, system), lambda, 1.0, MultigridOptions{}));
  }
};

const Problem& TheProblem()
{
  static const Problem problem;
  return problem;
}

const MultigridLevel& FinestLevel()
{
  return TheProblem().multigrid->Levels().front();
}

int Threads(const benchmark::State& state)
{
  return static_cast<int>(state.range(0));
}

/// Smooth and rough parts, the same every time.
MultiVector Vectors(Id rows, Id columns)
{
  MultiVector x(rows, columns);
  for (Id i = 0; i < x.size(); ++i)
  {
    x.data()[i] = std::sin(0.1 * double(i)) + 0.1 * std::cos(2.0 * double(i));
  }
  return x;
}

void SetItems(benchmark::State& state, Id items)
{
  state.SetItemsProcessed(state.iterations() * items);
}

/// Items: triangles after the clip.
void ClipMesh(benchmark::State& state)
{
  ClipOptions options;
  options.depth = Depth;
  options.threads = Threads(state);
  const Problem& problem = TheProblem(); // built before the clock runs
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(Clip(problem.mesh, options));
  }
  SetItems(state, problem.space.clipped.NumberOfTriangles());
}

/// Items: triangles after the clip.
void IntegrateElementMatrices(benchmark::State& state)
{
  const GridFunctions& space = TheProblem().space;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(IntegrateElements(space, TriangleRule(2), Threads(state)));
  }
  SetItems(state, space.clipped.NumberOfTriangles());
}

/// Items: entries of the matrix.
void Assemble(benchmark::State& state)
{
  const Problem& problem = TheProblem();
  SparseMatrix matrix = problem.system.pattern.front();
  const ElementMatrices& elements = problem.system.elements.front();
  for (auto _ : state)
  {
    AssembleValues(problem.space.Finest(), problem.system.places.front(), elements.mass,
      problem.lambda, elements.stiffness, 1.0, matrix, Threads(state));
    benchmark::DoNotOptimize(matrix.value.data());
  }
  SetItems(state, matrix.NonZeros());
}

/// Items of all that follow: unknowns times columns.
void SmootherSweep(benchmark::State& state)
{
  const MultigridLevel& level = FinestLevel();
  const MultiVector b = Vectors(level.A.rows, state.range(1));
  MultiVector x = MultiVector::Zero(b.rows(), b.cols());
  for (auto _ : state)
  {
    level.smoother->Sweep(level.A, b, x, SweepDirection::Forward, Threads(state));
    benchmark::DoNotOptimize(x.data());
  }
  SetItems(state, b.size());
}

void ComputeResidual(benchmark::State& state)
{
  const MultigridLevel& level = FinestLevel();
  const MultiVector b = Vectors(level.A.rows, state.range(1));
  MultiVector r;
  for (auto _ : state)
  {
    Residual(level.A, b, b, r, Threads(state));
    benchmark::DoNotOptimize(r.data());
  }
  SetItems(state, b.size());
}

void Prolongate(benchmark::State& state)
{
  const MultigridLevel& level = FinestLevel();
  const MultiVector coarse = Vectors(level.prolongation->columns, state.range(1));
  MultiVector x = Vectors(level.A.rows, state.range(1));
  for (auto _ : state)
  {
    MultiplyAdd(level.prolongation, coarse, x, Threads(state));
    benchmark::DoNotOptimize(x.data());
  }
  SetItems(state, x.size());
}

/// One W(1,1) cycle from zero.
void Cycle(benchmark::State& state)
{
  const Problem& problem = TheProblem();
  MultigridOptions options;
  options.threads = Threads(state);
  const Multigrid multigrid =
    BuildMultigrid(testing::ViewOf(problem.space, problem.system), problem.lambda, 1.0, options);
  const MultiVector b = Vectors(multigrid.Matrix().rows, state.range(1));
  MultiVector x;
  for (auto _ : state)
  {
    multigrid.Precondition(b, x);
    benchmark::DoNotOptimize(x.data());
  }
  SetItems(state, b.size());
}

void ForThreads(benchmark::internal::Benchmark* kernel)
{
  kernel->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void ForThreadsAndColumns(benchmark::internal::Benchmark* kernel)
{
  kernel->ArgNames({ "threads", "columns" })
    ->ArgsProduct({ { 1, 2 }, { 1, 3, 8 } })
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
}

BENCHMARK(ClipMesh)->Apply(ForThreads);
BENCHMARK(IntegrateElementMatrices)->Apply(ForThreads);
BENCHMARK(Assemble)->Apply(ForThreads);
BENCHMARK(SmootherSweep)->Apply(ForThreadsAndColumns);
BENCHMARK(ComputeResidual)->Apply(ForThreadsAndColumns);
BENCHMARK(Prolongate)->Apply(ForThreadsAndColumns);
BENCHMARK(Cycle)->Apply(ForThreadsAndColumns);

} // namespace

BENCHMARK_MAIN();
