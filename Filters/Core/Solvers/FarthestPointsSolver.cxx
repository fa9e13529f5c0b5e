#include "Solvers/FarthestPointsSolver.h"

#include "Distance/NearestSource.h"
#include "Solvers/DistanceHierarchy.h"
#include "Solvers/DistanceSolver.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/SolveWarnings.h"

#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr const char* FirstPointStage = "FirstPoint";

Id FirstPoint(const TriangleMesh& mesh, int wanted)
{
  if (wanted < 0)
  {
    return FirstUsedPoint(mesh);
  }
  RequireUsed("First Point Id", { wanted }, mesh);
  return wanted;
}

} // namespace

SurfaceOptions FarthestPointsSolver::SurfaceDefaults()
{
  return DistanceSolver::SurfaceDefaults();
}

/// Starts without a point. Everything that functions reach is infinitely far, so that each
/// component gets a point before any component gets a second one.
void FarthestPointsSolver::Restart(const Surface& surface, const Options& options)
{
  next_ = FirstPoint(surface.Mesh(), options.firstPointId);
  const std::vector<char> isReached = surface.PointsWithFunctions();
  result_ = {};
  result_.nearest.assign(isReached.size(), -1);
  result_.atPoints = MultiVector::Constant(static_cast<Id>(isReached.size()), 1, NaN);
  for (std::size_t point = 0; point < isReached.size(); ++point)
  {
    result_.atPoints(static_cast<Id>(point), 0) = isReached[point] ? Infinity : NaN;
  }
}

void FarthestPointsSolver::AddPoint(
  const Surface& surface, const SolveOptions& solve, const Progress& progress)
{
  const DistanceField field = method_->From({ next_ }, solve, surface.MakeJob(progress));
  for (std::size_t point = 0; point < field.atPoints.size(); ++point)
  {
    double& least = result_.atPoints(static_cast<Id>(point), 0);
    if (field.atPoints[point] < least)
    {
      least = field.atPoints[point];
      result_.nearest[point] = next_;
    }
  }
  result_.atPoints(next_, 0) = 0.0;
  result_.nearest[next_] = next_;
  result_.points.push_back(next_);
  if (result_.warnings.empty()) // the warnings of all points are alike
  {
    result_.warnings = WarningsOf(field, solve.tolerance);
  }
  this->FindNext(surface.LongestSide());
}

/// Picks the first of the points that are equally far up to rounding, so that symmetric surfaces
/// have the same points everywhere.
void FarthestPointsSolver::FindNext(double side)
{
  constexpr double Rounding = 1e-9;
  result_.radius = 0.0;
  for (Id point = 0; point < result_.atPoints.rows(); ++point)
  {
    result_.radius = std::fmax(result_.radius, result_.atPoints(point, 0));
  }
  next_ = -1;
  for (Id point = 0; point < result_.atPoints.rows() && result_.radius > Rounding * side; ++point)
  {
    if (result_.atPoints(point, 0) >= (1.0 - Rounding) * result_.radius)
    {
      next_ = point;
      return;
    }
  }
}

void FarthestPointsSolver::AddPoints(
  const Surface& surface, const Options& options, const Progress& progress)
{
  const auto wanted = static_cast<std::size_t>(options.numberOfPoints);
  const std::size_t first = result_.points.size();
  const double share = 1.0 / static_cast<double>(wanted - first);
  while (result_.points.size() < wanted && next_ >= 0)
  {
    const double done = share * static_cast<double>(result_.points.size() - first);
    this->AddPoint(surface, options.equation.solve, progress.Part(done, done + share));
  }
}

const FarthestPointsSolver::Result& FarthestPointsSolver::Update(
  Surface& surface, const Options& options, const Job& job)
{
  RequireOptions(options);
  surface.Prepare(job.progress.Part(0.0, 0.3));
  DistanceOptions ofMethod;
  ofMethod.multigrid = options.equation.multigrid;
  UpdateDistanceMethod(surface, ofMethod, method_, job.progress.Part(0.3, 0.4));
  Stages& stages = surface.GetStages();
  StageKey key;
  key.Add(stages.Version(HierarchyStage)).Add(KeyOf(options.equation)).Add(options.firstPointId);
  const auto wanted = static_cast<std::size_t>(options.numberOfPoints);
  restarts_ += result_.points.size() > wanted ? 1 : 0; // none can be taken away
  stages.Run(FirstPointStage, key.Add(restarts_), [&] { this->Restart(surface, options); });
  key = {};
  key.Add(stages.Version(FirstPointStage)).Add(options.numberOfPoints);
  stages.Run(
    SolveStage, key, [&] { this->AddPoints(surface, options, job.progress.Part(0.4, 1.0)); });
  job.Check(1.0);
  return result_;
}

FarthestPointsSolver::Result FarthestPointsSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  FarthestPointsSolver solver;
  solver.Update(surface, options, job);
  return std::move(solver.result_);
}

} // namespace gridfem
