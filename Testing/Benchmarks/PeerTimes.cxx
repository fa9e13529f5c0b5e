#include "PeerTimes.h"
#include "Discretization.h"

#include "AlgebraicMultigrid.h"
#include "Base/LargeMemory.h"
#include "Cholmod.h"
#include "Integrals/DirectionalElements.h"
#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Integrals/SurfaceMetric.h"
#include "Measure.h"
#include "Problems.h"
#include "Spaces.h"

#include <algorithm>
#include <cstdio>

namespace gridfem::benchmarks
{

namespace
{

constexpr int Columns = 3;

/// Keeps the least of the seconds that `body` took so far; 0 counts as not run yet.
template<class Body>
void Time(double& best, Body&& body)
{
  const Stopwatch watch;
  body();
  const double seconds = watch.Seconds();
  best = best > 0.0 ? std::min(best, seconds) : seconds;
}

/// Everybody's state between the repetitions.
class Contest
{
public:
  explicit Contest(const PeerJob& job) : job_(job), mesh_(job.mesh.mesh)
  {
    hats_ = AssembleProblem(mesh_);
    ChooseColors(mesh_, hats_, Columns);
    times_.vertices = static_cast<double>(mesh_.points.size());
    points_.values = Colors(mesh_.points, Vec3::Zero(), 1.0, Columns);
  }

  PeerTimes Run()
  {
    const auto boomerAmg = MakeBoomerAmg(hats_.A);
    const auto gamg = MakeGamg(hats_.A);
    for (int k = 0; k < job_.repetitions; ++k)
    {
      Time(times_.assembly, [&] { AssembleProblem(mesh_); });
      Time(times_.load, [&] { hats_.b.col(0) = hats_.A * hats_.exact.col(0); });
      this->RunAmg(*boomerAmg, times_.boomerAmg);
      this->RunAmg(*gamg, times_.gamg);
      for (const int threads : { 1, 2 })
      {
        this->RunGrid(threads, times_.grid[threads - 1]);
        this->RunCholmod(threads, times_.cholmod[threads - 1]);
      }
    }
    return times_;
  }

private:
  void RunAmg(AlgebraicMultigrid& amg, AmgTimes& times)
  {
    Time(times.setup, [&] { amg.Setup(); });
    const Eigen::VectorXd b = hats_.b.col(0);
    Eigen::VectorXd x;
    if (times.iterations == 0.0)
    {
      times.iterations = IterationsToError(
        [&](int iterations)
        {
          amg.Solve(b, x, 0.0, iterations);
          return hats_.Error(x);
        },
        job_.error);
    }
    Time(times.solve, [&] { amg.Solve(b, x, 0.0, static_cast<int>(times.iterations)); });
  }

  void RunCholmod(int threads, CholmodTimes& times)
  {
    SetBlasThreads(threads);
    Cholmod cholmod;
    Time(times.analyze, [&] { cholmod.Analyze(hats_.A); });
    Time(times.factor, [&] { cholmod.Factor(hats_.A); });
    Time(times.solve, [&] { cholmod.Solve(hats_.b.leftCols(1)); });
    Time(times.solve3, [&] { cholmod.Solve(hats_.b); });
    SetBlasThreads(1);
  }

  void RunGrid(int threads, GridTimes& times)
  {
    Time(times.plain, [&] { SetUp(mesh_, job_.depth, threads, FunctionSupport::Plain); });
    GridProblem grid;
    Time(times.setup, [&] { grid = SetUp(mesh_, job_.depth, threads); });
    times.functions = grid.space.Finest().numberOfFunctions;
    times.clippedTriangles = static_cast<double>(grid.space.clipped.NumberOfTriangles());
    this->RunUpdates(threads, grid, times);
    const auto load = [&](const Field& field)
    {
      IntegrateValues(grid.space, mesh_, field, TriangleRule(2), threads);
      IntegrateGradientsOf(grid.space, mesh_, field, nullptr, TriangleRule(2), threads);
    };
    Time(times.load, [&] { load({ points_.association, points_.values.leftCols(1) }); });
    Time(times.load3, [&] { load(points_); });
    ChooseColors(grid, Columns);
    if (times.iterations < 0.0)
    {
      times.iterations = this->GridIterations(grid, 1);
      times.iterations3 = this->GridIterations(grid, Columns);
    }
    MultiVector x;
    Time(times.solve, [&] { x = grid.Solve(1, static_cast<int>(times.iterations)); });
    Time(times.solve3, [&] { x = grid.Solve(Columns, static_cast<int>(times.iterations3)); });
    const MultiVector column = x.leftCols(1);
    Time(times.evaluate, [&] { EvaluateAtPoints(grid.space, column, threads); });
    const MultiVector b = grid.gradients.leftCols(1);
    Time(times.cycle, [&] { grid.multigrid->Precondition(b, x); });
  }

  /// Times changes of the values of the system on the same patches. The last change restores the
  /// values of the mesh.
  void RunUpdates(int threads, GridProblem& grid, GridTimes& times) const
  {
    const MemoryReuse reuse; // as around a flow of many updates
    const GridFunctions& space = grid.space;
    const QuadratureRule& rule = TriangleRule(2);
    ElementMatrices& elements = grid.system.elements.front();
    const auto update = [&]
    {
      UpdateMultigrid(
        testing::ViewOf(space, grid.system), grid.options.screeningWeight, 1.0, *grid.multigrid);
    };

    Time(times.lambda, update);
    {
      const MultiVector embedding = testing::GridCoordinates(space);
      SampleMetric metric;
      // In a flow, the first two steps touch fresh memory: for the new metric and for the old one.
      for (int step = 0; step < 2; ++step)
      {
        metric = MetricOfEmbedding(space, rule, embedding, threads);
      }
      Time(times.metric, [&] { metric = MetricOfEmbedding(space, rule, embedding, threads); });
      Time(times.values,
        [&]
        {
          IntegrateElements(space, rule, metric, elements, threads);
          UpdateOperators(space, grid.system, threads);
          update();
        });
    }
    const std::vector<Vec3> directions(mesh_.triangles.size(), Vec3::UnitX());
    const DirectionalElements parts = IntegrateElements(space, rule, directions, threads);
    const std::vector<ElementWeights> weights(parts.mass.size());
    Time(times.weights,
      [&]
      {
        Weigh(parts, weights, elements, threads);
        UpdateOperators(space, grid.system, threads);
        update();
      });
  }

  int GridIterations(const GridProblem& grid, int columns) const
  {
    const auto error = [&](int iterations) { return grid.Error(grid.Solve(columns, iterations)); };
    return error(0) <= job_.error ? 0 : IterationsToError(error, job_.error);
  }

  const PeerJob& job_;
  const TriangleMesh& mesh_;
  HatProblem hats_;
  Field points_;
  PeerTimes times_;
};

void PrintGrid(const Table& table, const char* name, const GridTimes& grid)
{
  table.Row(
    { name, Text("%.3f", grid.setup), Text("%.3f", grid.solve), Text("%.0f", grid.iterations),
      Text("%.3f", grid.solve3), Text("%.3f", grid.FromMesh()), Text("%.0f", grid.functions) });
}

void PrintAmg(const Table& table, const char* name, const PeerTimes& times, const AmgTimes& amg)
{
  table.Row({ name, Text("%.3f", amg.setup), Text("%.3f", amg.solve), Text("%.0f", amg.iterations),
    "", Text("%.3f", times.assembly + times.load + amg.setup + amg.solve),
    Text("%.0f", times.vertices) });
}

void PrintCholmod(
  const Table& table, const char* name, const PeerTimes& times, const CholmodTimes& cholmod)
{
  const double setup = cholmod.analyze + cholmod.factor;
  table.Row({ name, Text("%.3f", setup), Text("%.3f", cholmod.solve), "",
    Text("%.3f", cholmod.solve3), Text("%.3f", times.assembly + times.load + setup + cholmod.solve),
    Text("%.0f", times.vertices) });
}

} // namespace

const AmgTimes& PeerTimes::FasterSolve() const
{
  return boomerAmg.solve < gamg.solve ? boomerAmg : gamg;
}

double PeerTimes::FasterFromMesh() const
{
  return assembly + load + std::min(boomerAmg.setup + boomerAmg.solve, gamg.setup + gamg.solve);
}

PeerTimes MeasurePeers(const PeerJob& job)
{
  return MeasureInOwnProcess<PeerTimes>(
    [&]
    {
      const MessagePassing libraries;
      SetBlasThreads(1);
      return Contest(job).Run();
    });
}

void PrintPeers(const PeerJob& job, const PeerTimes& times)
{
  std::printf("\n%s, %.0f vertices, depth %d, to L2 error %g; seconds, best of %d\n",
    job.mesh.name.c_str(), times.vertices, job.depth, job.error, job.repetitions);
  const Table table(
    { "solver", "set-up", "solve", "iterations", "solve 3", "from mesh", "unknowns" });
  PrintGrid(table, "grid, 1 thread", times.grid[0]);
  PrintGrid(table, "grid, 2 threads", times.grid[1]);
  PrintAmg(table, "BoomerAMG-CG, 1 process", times, times.boomerAmg);
  PrintAmg(table, "GAMG-CG, 1 process", times, times.gamg);
  PrintCholmod(table, "CHOLMOD, 1 thread", times, times.cholmod[0]);
  PrintCholmod(table, "CHOLMOD, 2 threads", times, times.cholmod[1]);
  std::printf("Hat assembly %.3f; ours, 1 / 2 threads: plain set-up %.3f / %.3f, metric of "
              "an embedding %.3f / %.3f, new metric %.3f / %.3f, new weights %.3f / %.3f, new "
              "screening %.3f / %.3f, right-hand side %.3f / %.3f, three %.3f / %.3f, cycle %.4f / "
              "%.4f, values at points %.4f / %.4f\n",
    times.assembly, times.grid[0].plain, times.grid[1].plain, times.grid[0].metric,
    times.grid[1].metric, times.grid[0].values, times.grid[1].values, times.grid[0].weights,
    times.grid[1].weights, times.grid[0].lambda, times.grid[1].lambda, times.grid[0].load,
    times.grid[1].load, times.grid[0].load3, times.grid[1].load3, times.grid[0].cycle,
    times.grid[1].cycle, times.grid[0].evaluate, times.grid[1].evaluate);
}

} // namespace gridfem::benchmarks
