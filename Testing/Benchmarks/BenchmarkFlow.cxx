// Mean-curvature flow: the savings of tracking the metric over clipping again. A step is compared
// with the steps of CHOLMOD and of algebraic multigrid on hat functions. [T Table 5.4, Figure 5.4]
//
// "set-up" is from triangles to a hierarchy that is ready to solve. "update" is the metric of the
// embedding, element matrices and the hierarchy, in a running flow. "step" is a whole step, up to
// the points. A step of the peers is the assembly on the moved mesh, their numeric work, and three
// columns; CHOLMOD's symbolic work is done once. Algebraic multigrid starts from the last points,
// as ours does, and takes the fewest iterations to the algebraic error of our step.
#include "AlgebraicMultigrid.h"
#include "Cholmod.h"
#include "FlowComparison.h"
#include "Measure.h"
#include "Meshes.h"
#include "Problems.h"
#include "SetupCost.h"
#include "SurfaceDistance.h"

#include "Base/LargeMemory.h"
#include "Shape/MeanCurvatureFlow.h"
#include "Spaces/GridSpace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Threads = 2;
constexpr int Repetitions = 3;
constexpr double TimeStep = 1e-5; // of the surface's area

struct Subject
{
  const char* name;
  const char* file;
  int subdivisions;
  int depth;
};

constexpr Subject Subjects[] = { { "brain", "brain_mni_LR.ply", 1, 7 },
  { "dragon", "dragon_871k.ply", 0, 8 }, { "rocker", "rocker_arm.ply", 3, 8 },
  { "large", "brain_mni_LR.ply", 2, 8 } };
constexpr Subject Compared{ "distance", "rocker_arm.ply", 1, 7 };

TriangleMesh MeshOf(const Subject& subject)
{
  return RealMesh(subject.name, subject.file, subject.subdivisions).mesh;
}

template<class Body>
double SecondsOf(Body&& body)
{
  return LeastSeconds(Repetitions, [&](int) { body(); });
}

Eigen::MatrixXd AsColumns(const std::vector<Vec3>& points)
{
  Eigen::MatrixXd columns(static_cast<Id>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      columns(static_cast<Id>(k), axis) = points[k][axis];
    }
  }
  return columns;
}

/// |x - exact| / |exact - its mean|
double ShapeError(const Eigen::MatrixXd& x, const Eigen::MatrixXd& exact)
{
  return (x - exact).norm() / (exact.rowwise() - exact.colwise().mean()).norm();
}

/// Our side of a flow.
struct GridFlow
{
  GridFlow(const TriangleMesh& surface, int depth)
    : mesh(std::make_shared<const TriangleMesh>(surface))
  {
    spaceOptions.functions.depth = depth;
    spaceOptions.functions.threads = Threads;
    options.multigrid.threads = Threads;
  }

  void SetUp()
  {
    space = std::make_shared<const GridSpace>(BuildGridSpace(*mesh, spaceOptions));
    options.timeStep = TimeStep * SurfaceArea(*mesh) / std::pow(space->UnitLength(), 2);
  }

  void ClipAgain()
  {
    options.rebuild = [this](const TriangleMesh& moved, const Job&)
    { return std::make_unique<GridSpace>(BuildGridSpace(moved, spaceOptions)); };
  }

  MeanCurvatureFlow Make() const { return { space, mesh, options }; }

  std::shared_ptr<const TriangleMesh> mesh;
  GridSpaceOptions spaceOptions;
  FlowOptions options;
  std::shared_ptr<const GridSpace> space;
};

struct FlowTimes
{
  double vertices = 0.0;
  double functions = 0.0;
  double setup = 0.0;
  double update = 0.0;
  double step = 0.0;
  double stepOfOneThread = 0.0;
  double iterations = 0.0;
  double error = 0.0;   // algebraic, of the step
  double tracked = 0.0; // ten steps with their set-up
  double rebuilt = 0.0;
};

double SecondsOfTenSteps(const TriangleMesh& mesh, int depth, bool isTracked)
{
  const Stopwatch watch;
  GridFlow grid(mesh, depth);
  grid.SetUp();
  if (!isTracked)
  {
    grid.ClipAgain();
  }
  MeanCurvatureFlow flow = grid.Make();
  for (int step = 0; step < 10; ++step)
  {
    flow.Advance(Threads);
  }
  return watch.Seconds();
}

/// @param moved  the points before the step that is timed
FlowTimes MeasureGrid(const TriangleMesh& mesh, int depth, std::vector<Vec3>& moved)
{
  const MemoryReuse reuse; // as around a flow in the filter
  FlowTimes times;
  GridFlow grid(mesh, depth);
  std::unique_ptr<Multigrid> hierarchy;
  times.setup = SecondsOf(
    [&]
    {
      hierarchy.reset();
      grid.SetUp();
      hierarchy = std::make_unique<Multigrid>(
        BuildMultigrid(*grid.space, 1.0, grid.options.timeStep, grid.options.multigrid));
    });
  times.vertices = static_cast<double>(mesh.points.size());
  times.functions = static_cast<double>(grid.space->NumberOfFunctions(0));
  {
    MeanCurvatureFlow flow = grid.Make();
    flow.Advance(Threads);
    flow.Advance(Threads); // touches the memory of an update
    const MultiVector before = flow.Shape();
    moved = flow.Points();
    times.step = SecondsOf(
      [&]
      {
        flow.GoTo(2, before);
        times.iterations = flow.Advance(Threads).iterations;
      });
    GridFlow exact = grid;
    exact.options.solve.tolerance = 1e-10;
    MeanCurvatureFlow truth = exact.Make();
    truth.GoTo(2, before);
    truth.Advance(Threads);
    times.error = ShapeError(AsColumns(flow.Points()), AsColumns(truth.Points()));
    GridFlow alone = grid;
    alone.options.multigrid.threads = 1;
    MeanCurvatureFlow onOneThread = alone.Make();
    times.stepOfOneThread = SecondsOf(
      [&]
      {
        onOneThread.GoTo(2, before);
        onOneThread.Advance(1);
      });

    const std::unique_ptr<FiniteElementSpace> copy = grid.space->Copy();
    SparseMatrix mass;
    const auto update = [&]
    {
      copy->SetMetric(before, Threads);
      UpdateMultigrid(*copy, 1.0, grid.options.timeStep, *hierarchy);
      copy->FillMatrix(0, 1.0, 0.0, mass, Threads);
    };
    update();
    times.update = SecondsOf(update);
  }
  hierarchy.reset();
  times.tracked = SecondsOfTenSteps(mesh, depth, true);
  times.rebuilt = SecondsOfTenSteps(mesh, depth, false);
  return times;
}

/// The system of a step on hats, and its start.
struct HatStep
{
  CotangentSystem hats;
  SymmetricMatrix A;
  Eigen::MatrixXd points;

  HatStep(const TriangleMesh& mesh, double timeStep) : hats(AssembleCotangents(mesh))
  {
    A = hats.mass + timeStep * hats.stiffness;
    MultiVector given(static_cast<Id>(mesh.points.size()), 3);
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        given(static_cast<Id>(k), axis) = mesh.points[k][axis];
      }
    }
    points = ToRows(hats, given);
  }
};

struct PeerSteps
{
  double assembly = 0.0;
  double analyze = 0.0;
  double factor = 0.0;
  double solve = 0.0; // three columns
  double amgSetup = 0.0;
  double amgSolve = 0.0; // three columns
  double amgIterations = 0.0;
  double isGamg = 0.0;

  double Cholmod() const { return assembly + factor + solve; }
  double Amg() const { return assembly + amgSetup + amgSolve; }
};

/// The better of the two in set-up and solve together, in one process, which is one thread. Columns
/// are solved one by one, because neither library iterates on several with a preconditioner.
void MeasureAmg(const HatStep& step, const Eigen::MatrixXd& exact, double error, PeerSteps& times)
{
  const Eigen::MatrixXd residual = step.hats.mass * step.points - step.A * step.points;
  for (const bool isGamg : { false, true })
  {
    const auto amg = isGamg ? MakeGamg(step.A) : MakeBoomerAmg(step.A);
    const double setup = SecondsOf([&] { amg->Setup(); });
    Eigen::MatrixXd x = step.points;
    const auto solve = [&](int iterations)
    {
      for (int c = 0; c < 3; ++c)
      {
        Eigen::VectorXd change;
        amg->Solve(residual.col(c), change, 0.0, iterations);
        x.col(c) = step.points.col(c) + change;
      }
    };
    const int iterations = IterationsToError(
      [&](int count)
      {
        solve(count);
        return ShapeError(x, exact);
      },
      error);
    const double seconds = SecondsOf([&] { solve(iterations); });
    if (!isGamg || setup + seconds < times.amgSetup + times.amgSolve)
    {
      times.amgSetup = setup;
      times.amgSolve = seconds;
      times.amgIterations = iterations;
      times.isGamg = isGamg;
    }
  }
}

PeerSteps MeasurePeers(const TriangleMesh& moved, double timeStep, double error)
{
  const MessagePassing libraries;
  PeerSteps times;
  const HatStep step(moved, timeStep);
  times.assembly = SecondsOf([&] { HatStep(moved, timeStep); });
  SetBlasThreads(Threads);
  Cholmod cholmod;
  const Stopwatch watch;
  cholmod.Analyze(step.A);
  times.analyze = watch.Seconds();
  times.factor = SecondsOf([&] { cholmod.Factor(step.A); });
  const Eigen::MatrixXd b = step.hats.mass * step.points;
  Eigen::MatrixXd exact;
  times.solve = SecondsOf([&] { exact = cholmod.Solve(b); });
  SetBlasThreads(1);
  MeasureAmg(step, exact, error, times);
  return times;
}

void MeasureSubject(const Subject& subject, const Table& table)
{
  TriangleMesh mesh = MeshOf(subject);
  // Numbers and points of another process come back as one list.
  const std::vector<double> numbers = InOwnProcess(
    [&]
    {
      std::vector<Vec3> moved;
      const FlowTimes times = MeasureGrid(mesh, subject.depth, moved);
      std::vector<double> packed(sizeof times / sizeof(double));
      std::memcpy(packed.data(), &times, sizeof times);
      for (const Vec3& p : moved)
      {
        packed.insert(packed.end(), p.data(), p.data() + 3);
      }
      return packed;
    });
  FlowTimes times;
  std::memcpy(static_cast<void*>(&times), numbers.data(), sizeof times);
  const double timeStep = TimeStep * SurfaceArea(mesh);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    mesh.points[k] = Eigen::Map<const Vec3>(&numbers[sizeof times / sizeof(double) + 3 * k]);
  }
  const auto peers =
    MeasureInOwnProcess<PeerSteps>([&] { return MeasurePeers(mesh, timeStep, times.error); });
  table.Row({ subject.name, Text("%.0f", times.vertices), Text("%.0f", times.functions),
    Text("%.2f", times.setup), Text("%.2f", times.update), Text("%.2f", times.step - times.update),
    Text("%.2f", times.stepOfOneThread), Text("%.0f", times.iterations), Text("%.1e", times.error),
    Text("%.1f", times.tracked), Text("%.1f", times.rebuilt), Text("%.2f", peers.assembly),
    Text("%.2f", peers.factor), Text("%.2f", peers.solve),
    Text("%.2f", peers.amgSetup) + (peers.isGamg != 0.0 ? " GAMG" : " BoomerAMG"),
    Text("%.2f", peers.amgSolve) + Text(" (%.0f)", peers.amgIterations) });
  const std::string name = std::string("flow-") + subject.name;
  PrintAtMost(name + "-update-over-setup", times.update / times.setup, 0.3);
  PrintAtMost(name + "-tracked-over-rebuilt", times.tracked / times.rebuilt, 0.45);
  PrintAtLeast(name + "-cholmod-over-step", peers.Cholmod() / times.step, 3.0);
  PrintAtLeast(name + "-amg-over-step-one-thread", peers.Amg() / times.stepOfOneThread, 1.5);
}

/// The flow on hats by CHOLMOD, a step further.
void AdvanceHats(const HatStep& step, Cholmod& cholmod, TriangleMesh& mesh)
{
  cholmod.Factor(step.A);
  const Eigen::MatrixXd next = cholmod.Solve(step.hats.mass * step.points);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    const int row = step.hats.row[k];
    for (int axis = 0; row >= 0 && axis < 3; ++axis)
    {
      mesh.points[k][axis] = next(row, axis);
    }
  }
}

/// Figure 5.4. Distances are relative to the root of the area.
void MeasureDistances()
{
  const TriangleMesh mesh = MeshOf(Compared);
  const double length = std::sqrt(SurfaceArea(mesh));
  const double timeStep = TimeStep * length * length;
  GridFlow tracking(mesh, Compared.depth);
  tracking.options.solve.tolerance = 1e-6; // so that the functions alone make the difference
  tracking.SetUp();
  GridFlow clipping(mesh, Compared.depth);
  clipping.options.solve.tolerance = 1e-6;
  clipping.SetUp();
  clipping.ClipAgain();
  const MemoryReuse reuse;
  MeanCurvatureFlow tracked = tracking.Make();
  MeanCurvatureFlow rebuilt = clipping.Make();
  TriangleMesh hats = mesh;
  SetBlasThreads(Threads);
  Cholmod cholmod;
  cholmod.Analyze(HatStep(mesh, timeStep).A);
  std::printf("\nDistance to the flow on hats, %s, %zu vertices, depth %d, in roots of the area "
              "[T Figure 5.4]\n",
    Compared.file, mesh.points.size(), Compared.depth);
  const Table table(
    { "steps", "tracked, largest", "tracked, RMS", "clipped again, largest", "RMS" });
  for (int step = 1; step <= 100; ++step)
  {
    tracked.Advance(Threads);
    rebuilt.Advance(Threads);
    AdvanceHats(HatStep(hats, timeStep), cholmod, hats);
    if (step == 1 || step == 10 || step == 100)
    {
      const SurfaceDistance ofTracked = DistanceBetween(tracked.Points(), hats.points, mesh);
      const SurfaceDistance ofRebuilt = DistanceBetween(rebuilt.Points(), hats.points, mesh);
      table.Row({ std::to_string(step), Text("%.2e", ofTracked.largest / length),
        Text("%.2e", ofTracked.rms / length), Text("%.2e", ofRebuilt.largest / length),
        Text("%.2e", ofRebuilt.rms / length) });
      const std::string name = "flow-distance-" + std::to_string(step);
      PrintAtMost(name + "-largest-over-rebuilt", ofTracked.largest / ofRebuilt.largest, 1.0);
      PrintAtMost(name + "-rms-over-rebuilt", ofTracked.rms / ofRebuilt.rms, 1.0);
    }
  }
}

} // namespace

/// Parts: the names of the subjects, "distance", "budget" (ten minutes); "large" (1.3 million
/// vertices) only where named.
int main(int argc, char** argv)
{
  const Parts parts(argc, argv);
  std::printf("\nSeconds of a step of the flow, %d threads, time step %g of the area, to 5e-4 "
              "[T Table 5.4]\n",
    Threads, TimeStep);
  const Table table({ "mesh", "vertices", "functions", "set-up", "update", "solve, points",
    "step, 1 thread", "iterations", "error", "ten steps tracked", "clipped again", "hat assembly",
    "CHOLMOD factor", "solve 3", "AMG set-up", "solve 3 (iterations)" });
  for (const Subject& subject : Subjects)
  {
    const bool isLarge = std::string(subject.name) == "large";
    if (isLarge ? parts.IsNamed(subject.name) : parts.Want(subject.name))
    {
      MeasureSubject(subject, table);
    }
  }
  if (parts.Want("distance"))
  {
    MeasureDistances();
  }
  if (parts.Want("budget"))
  {
    const MessagePassing libraries;
    const FlowComparisonOptions options;
    PrintComparison(options, CompareFlows(options));
  }
}
