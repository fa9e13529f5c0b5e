#include "AccuracyPeers.h"

#include "AlgebraicMultigrid.h"
#include "Base/LargeMemory.h"
#include "Equations/Poisson.h"
#include "Measure.h"
#include "PointAreas.h"
#include "Problems.h"
#include "Spaces/GridSpace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gridfem::benchmarks
{

namespace
{

constexpr int Repetitions = 3;

/// Seconds of the parts, and of the whole.
struct Way
{
  double setup = 0.0; // to a hierarchy that is ready to solve; assembly included
  double load = 0.0;
  double solve = 0.0;
  double evaluate = 0.0;
  int iterations = 0;
  double error = 0.0;

  double Seconds() const { return setup + load + solve + evaluate; }
};

struct Equation
{
  const TriangleMesh& mesh;
  const MultiVector& f;
  Eigen::VectorXd areas; // of the points
  Eigen::VectorXd truth;

  double Lambda() const { return 100.0 / areas.sum(); }

  /// Relative to the truth without its mean.
  double Error(const Eigen::VectorXd& u) const
  {
    const auto norm = [this](const Eigen::VectorXd& v)
    { return std::sqrt(areas.dot(v.cwiseAbs2())); };
    return norm(u - truth) / norm(truth.array() - areas.dot(truth) / areas.sum());
  }
};

struct GridAnswer
{
  Way way;
  Eigen::VectorXd atPoints;
};

/// @param accuracy  0: to the tolerance
GridAnswer OnGrid(
  const Equation& equation, int depth, int threads, double accuracy, double tolerance)
{
  const MemoryReuse reuse;
  GridAnswer answer;
  Way& way = answer.way;
  const auto time = [](double& seconds, auto&& run)
  {
    const Stopwatch watch;
    auto result = run();
    seconds += watch.Seconds();
    return result;
  };
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.threads = threads;
  const Job job{ threads, {} };
  PoissonOptions poisson;
  poisson.accuracy = accuracy;
  poisson.solve.tolerance = tolerance;
  poisson.multigrid.threads = threads;
  const GridSpace space =
    time(way.setup, [&] { return BuildGridSpace(equation.mesh, options, job.progress); });
  poisson.screeningWeight = equation.Lambda() * std::pow(space.UnitLength(), 2);
  const Multigrid multigrid = time(way.setup,
    [&] { return BuildMultigrid(space, poisson.screeningWeight, 1.0, poisson.multigrid); });
  const MultiVector load = time(way.load,
    [&] {
      return space.LoadOfValues({ FieldAssociation::Points, equation.f }, job);
    });
  const PoissonSolution solution =
    time(way.solve, [&] { return SolvePoisson(space, multigrid, load, {}, poisson); });
  answer.atPoints =
    time(way.evaluate, [&] { return space.ValuesAtPoints(solution.coefficients, job); });
  way.iterations = solution.report.iterations;
  way.error = equation.truth.size() > 0 ? equation.Error(answer.atPoints) : 0.0;
  return answer;
}

/// The best of several runs.
template<class Run>
Way Best(Run&& run)
{
  Way best = run();
  for (int k = 1; k < Repetitions; ++k)
  {
    const Way way = run();
    best = way.Seconds() < best.Seconds() ? way : best;
  }
  return best;
}

using MakeAmg = std::unique_ptr<AlgebraicMultigrid> (*)(const SymmetricMatrix& A, AmgUse use);

/// To `error`, or as near to it as hat functions come.
Way OnHats(const Equation& equation, MakeAmg make, double error)
{
  const auto prepare = [&](Way& way, CotangentSystem& hats, SymmetricMatrix& A, Eigen::VectorXd& b)
  {
    Stopwatch watch;
    hats = AssembleCotangents(equation.mesh);
    A = Combine(hats, equation.Lambda());
    way.setup = watch.Seconds();
    watch = Stopwatch();
    b = equation.Lambda() * (hats.mass * ToRows(hats, equation.f).col(0));
    way.load = watch.Seconds();
  };
  Way way;
  CotangentSystem hats;
  SymmetricMatrix A;
  Eigen::VectorXd b;
  prepare(way, hats, A, b);
  const Eigen::VectorXd truth = ToRows(hats, equation.truth).col(0);
  const Equation ofRows{ equation.mesh, equation.f, ToRows(hats, equation.areas).col(0), truth };
  const auto amg = make(A, AmgUse::Preconditioner);
  amg->Setup();
  Eigen::VectorXd x;
  amg->Solve(b, x, 1e-10, 200);
  const double enough = std::max(error, 1.01 * ofRows.Error(x));
  const int iterations = IterationsToError(
    [&](int most)
    {
      amg->Solve(b, x, 0.0, most);
      return ofRows.Error(x);
    },
    enough);
  return Best(
    [&]
    {
      Way timed;
      prepare(timed, hats, A, b);
      const auto again = make(A, AmgUse::Preconditioner);
      Stopwatch watch;
      again->Setup();
      timed.setup += watch.Seconds();
      watch = Stopwatch();
      timed.iterations = again->Solve(b, x, 0.0, iterations);
      timed.solve = watch.Seconds();
      timed.error = ofRows.Error(x);
      return timed;
    });
}

void PrintWay(const Table& table, const std::string& name, const Way& way)
{
  table.Row({ name, Text("%.2f", way.setup), Text("%.2f", way.load), Text("%.2f", way.solve),
    Text("%.3f", way.evaluate), Text("%.2f", way.Seconds()), std::to_string(way.iterations),
    Text("%.2e", way.error) });
}

} // namespace

void ComparePeers(const char* name, const TriangleMesh& mesh, int depth, const MultiVector& f)
{
  Equation equation{ mesh, f, testing::AreasOfPoints(mesh), {} };
  equation.truth = OnGrid(equation, depth + 2, 2, 0.0, 1e-7).atPoints;
  std::printf("\n%s, %zu vertices, depth %d, from the mesh to values at its points; seconds\n",
    name, mesh.points.size(), depth);
  const auto grid = [&](int threads)
  { return Best([&] { return OnGrid(equation, depth, threads, 0.1, 0.0).way; }); };
  const Way one = grid(1);
  const Way two = grid(2);
  const Way boomer = OnHats(equation, MakeBoomerAmg, one.error);
  const Way gamg = OnHats(equation, MakeGamg, one.error);
  const Table table(
    { "solver", "set-up", "load", "solve", "values", "all", "iterations", "error" });
  PrintWay(table, "grid, 1 thread", one);
  PrintWay(table, "grid, 2 threads", two);
  PrintWay(table, "BoomerAMG-CG, 1 process", boomer);
  PrintWay(table, "GAMG-CG, 1 process", gamg);
  PrintAtMost(std::string("accuracy_mesh_to_values_over_faster_amg_one_thread_") + name,
    one.Seconds() / std::min(boomer.Seconds(), gamg.Seconds()), 1.0);
}

} // namespace gridfem::benchmarks
