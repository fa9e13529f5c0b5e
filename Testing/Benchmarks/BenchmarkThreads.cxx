// The gain by more threads: seconds of every step on 1, 2, 4, ... threads, up to the number of
// processors. The gain in reading memory is measured for comparison.
#include "Discretization.h"
#include "Measure.h"
#include "Problems.h"
#include "SetupCost.h"

#include "Base/LargeMemory.h"
#include "Base/Parallel.h"
#include "Distance/GeodesicDistance.h"
#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Spaces/GridSpace.h"
#include "Spectrum/Spectrum.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Repetitions = 3;
constexpr int Modes = 100;

/// Least seconds of every step, in the order in which they were first measured.
class Steps
{
public:
  template<class Body>
  void Time(const std::string& step, Body&& body)
  {
    const Stopwatch watch;
    body();
    this->Add(step, watch.Seconds());
  }

  void Add(const std::string& step, double seconds)
  {
    const auto found = std::find_if(
      steps_.begin(), steps_.end(), [&](const auto& other) { return other.first == step; });
    if (found == steps_.end())
    {
      steps_.emplace_back(step, seconds);
      return;
    }
    found->second = std::min(found->second, seconds);
  }

  const std::vector<std::pair<std::string, double>>& All() const { return steps_; }

private:
  std::vector<std::pair<std::string, double>> steps_;
};

/// The sum of 256 MB.
void MeasureMemory(int threads, Steps& steps)
{
  const std::vector<double> numbers(32 << 20, 1.0);
  const auto sum = [&](Id begin, Id end)
  {
    using Range = Eigen::Map<const Eigen::ArrayXd>;
    return Range(numbers.data() + begin, end - begin).sum();
  };
  for (int k = 0; k < 3 * Repetitions; ++k)
  {
    double total = 0.0;
    steps.Time("reading 256 MB",
      [&] { total = ParallelSum(static_cast<Id>(numbers.size()), threads, 0.0, sum, 1 << 16); });
    if (total != static_cast<double>(numbers.size()))
    {
      std::printf("The sum of ones is %g.\n", total);
    }
  }
}

void MeasurePoisson(const TriangleMesh& mesh, int depth, int threads, Steps& steps)
{
  const MemoryReuse reuse;
  for (int k = 0; k < Repetitions; ++k)
  {
    const SetupCost setup = MeasureSetup(mesh, depth, threads);
    for (int stage = 0; stage < SetupStages; ++stage)
    {
      steps.Add(SetupStageNames[stage], setup.stages[stage].seconds);
    }
    steps.Add("set-up, all of these", setup.Seconds());
  }
  GridProblem grid = SetUp(mesh, depth, threads);
  ChooseColors(grid, 1);
  const Field field{ FieldAssociation::Points, ColorsAtPoints(mesh, 1) };
  const MultiVector b = grid.gradients;
  MultiVector x;
  for (int k = 0; k < Repetitions; ++k)
  {
    steps.Time("load",
      [&]
      {
        IntegrateValues(grid.space, mesh, field, TriangleRule(2), threads);
        IntegrateGradientsOf(grid.space, mesh, field, nullptr, TriangleRule(2), threads);
      });
    steps.Time("new weight",
      [&]
      {
        UpdateMultigrid(testing::ViewOf(grid.space, grid.system), grid.options.screeningWeight, 1.0,
          *grid.multigrid);
      });
    steps.Time("one cycle", [&] { grid.multigrid->Precondition(b, x); });
    steps.Time("solve, 5 iterations", [&] { x = grid.Solve(1, 5); });
    steps.Time("values at points", [&] { EvaluateAtPoints(grid.space, x, threads); });
  }
}

void MeasureDistance(const TriangleMesh& mesh, int depth, int threads, Steps& steps)
{
  const MemoryReuse reuse;
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.threads = threads;
  options.functions.joinAtPoints = true;
  options.normalStabilization = 0.1; // as the filter has it
  DistanceOptions distances;
  distances.multigrid.threads = threads;
  distances.multigrid.cycle = CycleType::V;
  const auto shared = std::make_shared<const TriangleMesh>(mesh);
  for (int k = 0; k < Repetitions; ++k)
  {
    std::shared_ptr<const GridSpace> space;
    steps.Time(
      "space", [&] { space = std::make_shared<const GridSpace>(BuildGridSpace(mesh, options)); });
    std::unique_ptr<GeodesicDistance> distance;
    steps.Time("hierarchies of heat and distance",
      [&] { distance = std::make_unique<GeodesicDistance>(space, shared, distances, threads); });
    SolveOptions solve;
    solve.tolerance = 1e-4;
    steps.Time("distance from a point", [&] { distance->From({ 0 }, solve, threads); });
  }
}

void MeasureHats(const TriangleMesh& mesh, int depth, int threads, Steps& steps)
{
  const MemoryReuse reuse;
  for (int k = 0; k < Repetitions; ++k)
  {
    std::unique_ptr<HybridProblem> hats;
    steps.Time("hats, space",
      [&] { hats = std::make_unique<HybridProblem>(SetUpHybrid(mesh, depth, threads)); });
    testing::HybridCycle options;
    options.grid.threads = threads;
    std::unique_ptr<Multigrid> multigrid;
    steps.Time("hats, hierarchy",
      [&] { multigrid = std::make_unique<Multigrid>(hats->BuildCycle(ScreeningWeight, options)); });
    const MultiVector b = hats->ToFunctions(ColorsAtPoints(mesh, 1));
    MultiVector x;
    steps.Time("hats, one cycle", [&] { multigrid->Precondition(b, x); });
  }
}

void MeasureSpectrum(const TriangleMesh& mesh, int depth, int threads, Steps& steps)
{
  const MemoryReuse reuse;
  SpaceOptions options;
  options.depth = depth;
  options.threads = threads;
  const GridFunctions space = BuildGridFunctions(mesh, options);
  const LevelOperators system = BuildLevelOperators(space, TriangleRule(2), threads);
  SpectrumOptions spectrum;
  spectrum.numberOfModes = Modes;
  spectrum.multigrid.threads = threads;
  for (int k = 0; k < Repetitions; ++k)
  {
    steps.Time(std::to_string(Modes) + " eigenpairs",
      [&] { ComputeSpectrum(testing::ViewOf(space, system), spectrum); });
  }
}

} // namespace

/// Parts: memory, poisson, distance, hats, spectrum; numbers are the numbers of threads.
int main(int argc, char** argv)
{
  std::vector<char*> names(argv, argv + 1);
  std::vector<int> threads;
  for (int k = 1; k < argc; ++k)
  {
    const int number = std::atoi(argv[k]);
    if (number > 0)
    {
      threads.push_back(number);
    }
    else
    {
      names.push_back(argv[k]);
    }
  }
  const Parts parts(static_cast<int>(names.size()), names.data());
  if (threads.empty())
  {
    const int most = NumberOfThreads(0);
    for (int k = 1; k < most; k *= 2)
    {
      threads.push_back(k);
    }
    threads.push_back(most);
  }

  const TriangleMesh large = RockerArm(3).mesh;
  const TriangleMesh small = RockerArm(2).mesh;
  std::vector<std::string> header{ "step" };
  std::map<int, Steps> steps;
  for (const int k : threads)
  {
    header.push_back(std::to_string(k) + (k == 1 ? " thread" : " threads"));
    Steps& own = steps[k];
    if (parts.Want("memory"))
    {
      MeasureMemory(k, own);
    }
    if (parts.Want("poisson"))
    {
      MeasurePoisson(large, 8, k, own);
    }
    if (parts.Want("distance"))
    {
      MeasureDistance(small, 7, k, own);
    }
    if (parts.Want("hats"))
    {
      MeasureHats(small, 7, k, own);
    }
    if (parts.Want("spectrum"))
    {
      MeasureSpectrum(small, 7, k, own);
    }
  }
  header.push_back("times as fast");
  std::printf("\nSeconds, best of %d; rocker arm, 642,816 vertices and depth 8 to \"values at "
              "points\", 160,704 and 7 after it\n",
    Repetitions);
  const Table table(header);
  for (std::size_t row = 0; row < steps[threads.front()].All().size(); ++row)
  {
    std::vector<std::string> cells{ steps[threads.front()].All()[row].first };
    for (const int k : threads)
    {
      cells.push_back(Text("%.4f", steps[k].All()[row].second));
    }
    cells.push_back(Text(
      "%.1f", steps[threads.front()].All()[row].second / steps[threads.back()].All()[row].second));
    table.Row(cells);
  }
}
