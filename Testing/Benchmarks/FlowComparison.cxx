#include "FlowComparison.h"

#include "ConformalFlows.h"
#include "Measure.h"
#include "SetupCost.h"
#include "Support/Meshes.h"

#include "Base/LargeMemory.h"
#include "Base/SortEachOnce.h"
#include "Base/VectorRows.h"
#include "Spaces/HatSpace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <optional>
#include <tuple>

namespace gridfem::benchmarks
{

namespace
{

/// The points after each step.
std::vector<MultiVector> StepsOf(ConformalFlow& flow, double time, int steps, Id points)
{
  flow.Begin(time / steps);
  std::vector<MultiVector> frames;
  for (int step = 0; step <= steps; ++step)
  {
    if (step > 0)
    {
      flow.Step();
    }
    frames.push_back(RowsOf(flow.Points()).topRows(points));
  }
  return frames;
}

/// A flow without its error of the first order in the time step: of `steps` steps and half as many.
/// Linear between the latter.
class Truth
{
public:
  /// @param points  the first so many of the mesh
  Truth(ConformalFlow& flow, double time, int steps, Id points)
    : frameTime_(2.0 * time / steps), frames_(StepsOf(flow, time, steps / 2, points))
  {
    const std::vector<MultiVector> fine = StepsOf(flow, time, steps, points);
    beforeExtrapolation_ = fine.back();
    for (std::size_t k = 0; k < frames_.size(); ++k)
    {
      frames_[k] = 2.0 * fine[2 * k] - frames_[k];
    }
  }

  MultiVector At(double time) const
  {
    const double place = time / frameTime_;
    const std::size_t frame = std::min(static_cast<std::size_t>(place + 1e-9), frames_.size() - 1);
    const double rest = place - static_cast<double>(frame);
    return frame + 1 == frames_.size() || rest < 1e-9
             ? frames_[frame]
             : MultiVector((1.0 - rest) * frames_[frame] + rest * frames_[frame + 1]);
  }

  const MultiVector& End() const { return frames_.back(); }
  const MultiVector& BeforeExtrapolation() const { return beforeExtrapolation_; } // at the end

private:
  double frameTime_;
  std::vector<MultiVector> frames_;
  MultiVector beforeExtrapolation_;
};

/// With 1/n.
double Rms(const MultiVector& difference)
{
  return difference.norm() / std::sqrt(static_cast<double>(difference.rows()));
}

/// Over the points that have, or have not, a mark.
double Rms(const MultiVector& difference, const std::vector<char>& mark, bool isMarked)
{
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < mark.size(); ++k)
  {
    if ((mark[k] != 0) == isMarked)
    {
      sum += difference.row(static_cast<Id>(k)).squaredNorm();
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

/// Points in the support of a function that shares its corner of the grid with another one: there
/// the plain space moves several sheets as one.
std::vector<char> PointsAtPartings(const GridFunctions& space)
{
  const PatchLevel& level = space.Finest();
  std::vector<std::tuple<MortonKey, Index>> functions; // by corner
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    const CellIndex cell = MortonDecode(level.cell[patch]);
    for (int k = 0; k < FunctionsPerPatch; ++k)
    {
      const CellIndex corner{ cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2) };
      functions.emplace_back(MortonEncode(corner), level.dof[patch][k]);
    }
  }
  SortEachOnce(functions);
  std::vector<char> isParted(level.numberOfFunctions, 0);
  for (std::size_t k = 1; k < functions.size(); ++k)
  {
    if (std::get<0>(functions[k]) == std::get<0>(functions[k - 1]))
    {
      isParted[std::get<1>(functions[k])] = isParted[std::get<1>(functions[k - 1])] = 1;
    }
  }
  std::vector<char> marks(space.pointPatch.size(), 0);
  for (std::size_t point = 0; point < marks.size(); ++point)
  {
    const Index patch = space.pointPatch[point];
    marks[point] = patch >= 0 && std::any_of(level.dof[patch].begin(), level.dof[patch].end(),
                                   [&](Index function) { return isParted[function]; });
  }
  return marks;
}

/// The functions of some contestants and their reference.
struct ComparedSpace
{
  std::string name;
  std::shared_ptr<MovingSystem> system; // of the peers
  std::shared_ptr<const FiniteElementSpace> space;
  const Truth* ownTruth;
};

struct Contestant
{
  const ComparedSpace* space;
  const char* solver;
  std::unique_ptr<ConformalFlow> flow;
  double secondsOfStep = 1e30;
};

double ProcessorSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The least time of three steps, after a step with the set-up. The contestants take turns, so
/// other work on the machine meets all of them.
void TimeSteps(std::vector<Contestant>& contestants, double time)
{
  constexpr int LikelySteps = 16;
  for (Contestant& contestant : contestants)
  {
    contestant.flow->Begin(time / LikelySteps);
    contestant.flow->Step();
  }
  for (int round = 0; round < 3; ++round)
  {
    for (Contestant& contestant : contestants)
    {
      const double before = ProcessorSeconds();
      contestant.flow->Step();
      contestant.secondsOfStep = std::min(contestant.secondsOfStep, ProcessorSeconds() - before);
    }
  }
}

std::vector<Contestant> ContestantsOf(const std::vector<ComparedSpace>& spaces,
  const std::shared_ptr<const TriangleMesh>& mesh, const FlowComparisonOptions& options)
{
  std::vector<Contestant> contestants;
  for (const ComparedSpace& space : spaces)
  {
    contestants.push_back({ &space, "CHOLMOD", MakeCholmodFlow(space.system, options.threads) });
    contestants.push_back({ &space, "AMG", MakeAmgFlow(space.system, options.tolerance) });
    contestants.push_back({ &space, "multigrid",
      MakeMultigridFlow(space.space, mesh, options.tolerance, options.threads) });
  }
  return contestants;
}

struct Reference
{
  const Truth& truth;
  const Truth* finer; // or null
  const std::vector<char>& atPartings;
};

BudgetedFlow Run(
  Contestant& contestant, const Reference& reference, const FlowComparisonOptions& options)
{
  ConformalFlow& flow = *contestant.flow;
  BudgetedFlow result;
  result.space = contestant.space->name;
  result.solver = contestant.solver;
  result.functions = static_cast<double>(contestant.space->system->Mass().rows());
  result.nonZeros = static_cast<double>(contestant.space->system->Mass().nonZeros());
  result.secondsOfStep = contestant.secondsOfStep;
  result.steps = std::max(1, static_cast<int>(options.budget / contestant.secondsOfStep));
  flow.Begin(options.time / result.steps);
  for (int step = 1; step <= result.steps; ++step)
  {
    result.iterations += static_cast<double>(flow.Step()) / result.steps;
    const double time = options.time * step / result.steps;
    const MultiVector points = RowsOf(flow.Points());
    result.time.push_back(time);
    result.error.push_back(Rms(points - reference.truth.At(time)));
    result.ownError.push_back(Rms(points - contestant.space->ownTruth->At(time)));
    if (reference.finer)
    {
      result.finerError.push_back(Rms(points - reference.finer->At(time)));
    }
  }
  const MultiVector difference = RowsOf(flow.Points()) - reference.truth.End();
  result.errorAtPartings = Rms(difference, reference.atPartings, true);
  result.errorElsewhere = Rms(difference, reference.atPartings, false);
  return result;
}

GridSpaceOptions GridOptions(const FlowComparisonOptions& options, bool isAware)
{
  GridSpaceOptions grid;
  grid.functions.depth = options.depth;
  grid.functions.threads = options.threads;
  grid.functions.connectivityAware = isAware;
  return grid;
}

std::shared_ptr<const GridSpace> SpaceOf(
  const TriangleMesh& mesh, const FlowComparisonOptions& options, bool isAware)
{
  return std::make_shared<const GridSpace>(BuildGridSpace(mesh, GridOptions(options, isAware)));
}

/// On a grid, solved to where the solver no longer counts.
Truth TruthOf(const std::shared_ptr<const GridSpace>& space,
  const std::shared_ptr<const TriangleMesh>& mesh, const FlowComparisonOptions& options)
{
  constexpr double Tight = 1e-6;
  return { *MakeMultigridFlow(space, mesh, Tight, options.threads), options.time,
    options.truthSteps, static_cast<Id>(mesh->points.size()) };
}

/// The truth of hat functions on a mesh, at its first points.
Truth TruthOf(const std::shared_ptr<const TriangleMesh>& mesh, std::size_t points,
  const FlowComparisonOptions& options)
{
  return { *MakeCholmodFlow(MakeHatSystem(mesh), options.threads), options.time, options.truthSteps,
    static_cast<Id>(points) };
}

/// The same after a zero: all flows start at the same points.
std::vector<double> FromStart(const std::vector<double>& steps)
{
  std::vector<double> result{ 0.0 };
  result.insert(result.end(), steps.begin(), steps.end());
  return result;
}

/// The last flow is connectivity-aware multigrid. Three places before it is the plain multigrid.
void PrintRatios(const FlowComparison& comparison)
{
  using Errors = std::vector<double> BudgetedFlow::*;
  const std::pair<const char*, Errors> truths[] = { { "hat-truth", &BudgetedFlow::error },
    { "finer-hat-truth", &BudgetedFlow::finerError }, { "own-truth", &BudgetedFlow::ownError } };
  const BudgetedFlow& ours = comparison.flows.back();
  for (const auto& [name, errors] : truths)
  {
    if ((ours.*errors).empty())
    {
      continue;
    }
    double best = 1e30;
    for (std::size_t k = 0; k + 1 < comparison.flows.size(); ++k)
    {
      best = std::min(best, (comparison.flows[k].*errors).back());
    }
    PrintAtMost(std::string("flow-budget-error-over-best-other-to-") + name,
      (ours.*errors).back() / best, 1.0);
  }
  const BudgetedFlow& plain = comparison.flows[comparison.flows.size() - 4];
  PrintAtLeast("flow-budget-plain-over-aware-where-functions-part",
    plain.errorAtPartings / ours.errorAtPartings, 1.0);
}

} // namespace

FlowComparison CompareFlows(const FlowComparisonOptions& options)
{
  const auto mesh =
    std::make_shared<const TriangleMesh>(RealMesh("", options.file, options.subdivisions).mesh);
  FlowComparison result;
  const MemoryReuse reuse;
  const std::size_t points = mesh->points.size();
  const auto aware = SpaceOf(*mesh, options, true);
  const auto plain = SpaceOf(*mesh, options, false);
  const auto hybrid =
    std::make_shared<const HatSpace>(BuildHatSpace(*mesh, GridOptions(options, true)));
  const std::vector<char> atPartings = PointsAtPartings(aware->Functions());
  const Truth truth = TruthOf(mesh, points, options);
  const Truth plainTruth = TruthOf(plain, mesh, options);
  const Truth awareTruth = TruthOf(aware, mesh, options);
  std::optional<Truth> finer;
  if (options.hasFinerTruth)
  {
    finer.emplace(TruthOf(std::make_shared<const TriangleMesh>(testing::SubdivideInPlane(*mesh)),
      points, options)); // it begins with the points of the mesh
    result.finerTruth = Rms(finer->End() - truth.End());
  }
  result.points = static_cast<double>(points);
  result.partingPoints = std::accumulate(atPartings.begin(), atPartings.end(), 0.0) / result.points;
  result.beforeExtrapolation = Rms(truth.BeforeExtrapolation() - truth.End());
  result.plainTruth = Rms(plainTruth.End() - truth.End());
  result.awareTruth = Rms(awareTruth.End() - truth.End());

  const std::vector<ComparedSpace> spaces{ { "hat", MakeHatSystem(mesh), hybrid, &truth },
    { "plain", MakeSpaceSystem(plain, options.threads), plain, &plainTruth },
    { "aware", MakeSpaceSystem(aware, options.threads), aware, &awareTruth } };
  std::vector<Contestant> contestants = ContestantsOf(spaces, mesh, options);
  TimeSteps(contestants, options.time);
  for (Contestant& contestant : contestants)
  {
    result.flows.push_back(
      Run(contestant, { truth, finer ? &*finer : nullptr, atPartings }, options));
    contestant.flow.reset(); // frees its memory
  }
  return result;
}

void PrintComparison(const FlowComparisonOptions& options, const FlowComparison& comparison)
{
  if (comparison.flows.empty())
  {
    return;
  }
  std::printf(
    "\nConformalised flow of %s to %g mm², %.0f points, depth %d, %g processor seconds on "
    "%d thread [T Table 6.2]\n",
    options.file, options.time, comparison.points, options.depth, options.budget, options.threads);
  std::printf("Functions part at %.1f %% of the points. RMS at the end from the truth of hat "
              "functions: its %d steps before extrapolation %.1e, truth of the mesh cut once more "
              "%.1e, of plain functions %.1e, of connectivity-aware ones %.1e mm\n",
    100.0 * comparison.partingPoints, options.truthSteps, comparison.beforeExtrapolation,
    comparison.finerTruth, comparison.plainTruth, comparison.awareTruth);
  const Table table({ "functions", "solver", "dimension", "non-zeros", "seconds of a step",
    "iterations", "steps", "RMS, mm", "without 1/n", "where functions part", "elsewhere",
    "to finer hats", "to own truth" });
  for (const BudgetedFlow& flow : comparison.flows)
  {
    table.Row({ flow.space, flow.solver, Text("%.0f", flow.functions), Text("%.0f", flow.nonZeros),
      Text("%.3f", flow.secondsOfStep), Text("%.1f", flow.iterations), std::to_string(flow.steps),
      Text("%.3f", flow.error.back()),
      Text("%.0f", flow.error.back() * std::sqrt(comparison.points)),
      Text("%.3f", flow.errorAtPartings), Text("%.3f", flow.errorElsewhere),
      flow.finerError.empty() ? "" : Text("%.3f", flow.finerError.back()),
      Text("%.3f", flow.ownError.back()) });
  }
  PrintRatios(comparison);
}

Figure FigureOf(const FlowComparison& comparison)
{
  Figure figure{ "figure-6.9",
    { { "distance to the truth of hat functions", "time, mm²", "RMS error, mm", false, {} },
      { "to the truth of the same functions", "time, mm²", "RMS error, mm", false, {} } } };
  for (const BudgetedFlow& flow : comparison.flows)
  {
    const Curve::Kind kind = flow.space == "hat"     ? Curve::Kind::Peer
                             : flow.space == "plain" ? Curve::Kind::Thesis
                                                     : Curve::Kind::Ours;
    const std::string name = flow.space + ", " + flow.solver;
    figure.panels[0].curves.push_back({ name, kind, FromStart(flow.time), FromStart(flow.error) });
    figure.panels[1].curves.push_back(
      { name, kind, FromStart(flow.time), FromStart(flow.ownError) });
  }
  return figure;
}

} // namespace gridfem::benchmarks
