#include "Solvers/FarthestPointsSolver.h"

#include "Distance/NearestSource.h"
#include "Solvers/DistanceHierarchy.h"
#include "Solvers/DistanceSolver.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

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

/// The warning if points on some components have no distance.
std::vector<std::string> WarningsOfInfinity(const MultiVector& distance)
{
  const auto infinite = (distance.array() == Infinity).count();
  if (infinite == 0)
  {
    return {};
  }
  const double share = double(infinite) / double(infinite + distance.array().isFinite().count());
  std::ostringstream text;
  text
    << std::setprecision(3) << 100.0 * share
    << " % of the points have no distance, because there are more connected components than found "
       "points. Choose a larger Number Of Points, or leave fragments out with the filter "
       "Connectivity.";
  return { text.str() };
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
  result_.report = SolveReport::Solved();
  result_.nearest.assign(isReached.size(), -1);
  solveWarnings_.clear();
  distance_.resize(static_cast<Id>(isReached.size()), 1);
  for (std::size_t point = 0; point < isReached.size(); ++point)
  {
    distance_(static_cast<Id>(point), 0) = isReached[point] ? Infinity : NaN;
  }
}

void FarthestPointsSolver::AddPoint(
  const Surface& surface, const SolveOptions& solve, const Progress& progress)
{
  DistanceField field = method_->From({ next_ }, solve, surface.MakeJob(progress));
  for (std::size_t point = 0; point < field.atPoints.size(); ++point)
  {
    double& least = distance_(static_cast<Id>(point), 0);
    if (field.atPoints[point] < least)
    {
      least = field.atPoints[point];
      result_.nearest[point] = next_;
    }
  }
  distance_(next_, 0) = 0.0;
  result_.nearest[next_] = next_;
  result_.points.push_back(next_);
  if (solveWarnings_.empty()) // the warnings of all points are alike
  {
    solveWarnings_ = WarningsOf(field, solve.tolerance);
  }
  KeepWorse(std::move(field.report), result_.report);
  this->FindNext(surface.LongestSide());
}

/// Picks the first of the points that are equally far up to rounding, so that symmetric surfaces
/// have the same points everywhere.
void FarthestPointsSolver::FindNext(double side)
{
  constexpr double Rounding = 1e-9;
  double largest = 0.0;
  for (Id point = 0; point < distance_.rows(); ++point)
  {
    largest = std::fmax(largest, distance_(point, 0));
  }
  next_ = -1;
  for (Id point = 0; point < distance_.rows() && largest > Rounding * side; ++point)
  {
    if (distance_(point, 0) >= (1.0 - Rounding) * largest)
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

/// The distance is unknown where it is infinite.
void FarthestPointsSolver::Finish()
{
  result_.atPoints = (distance_.array() == Infinity).select(NaN, distance_);
  result_.radius = 0.0;
  for (Id point = 0; point < result_.atPoints.rows(); ++point)
  {
    result_.radius = std::fmax(result_.radius, result_.atPoints(point, 0));
  }
  result_.warnings = solveWarnings_;
  for (const std::string& warning : WarningsOfInfinity(distance_))
  {
    result_.warnings.push_back(warning);
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
  stages.Run(SolveStage, key,
    [&]
    {
      this->AddPoints(surface, options, job.progress.Part(0.4, 1.0));
      this->Finish();
    });
  job.Check(1.0);
  return result_;
}

FarthestPointsSolver::Result FarthestPointsSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(&FarthestPointsSolver::result_, std::move(mesh), surfaceOptions, job, options);
}

} // namespace gridfem
