#include "Solvers/DistanceSolver.h"

#include "Algebra/DistributedRows.h"
#include "Base/Errors.h"
#include "Base/SortEachOnce.h"
#include "Distance/NearestSource.h"
#include "Solvers/DistanceHierarchy.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace gridfem
{
namespace
{

/// Refuses sources that are points, because points have no sides.
void RefusePoints(const DistanceSolver::Input& input, bool nearestSource)
{
  const std::string given = !input.ids.empty()      ? "Source Point Ids"
                            : input.mask            ? "Source Array"
                            : !input.points.empty() ? input.points.front().property
                            : nearestSource         ? "Nearest Source"
                                                    : "";
  if (!given.empty())
  {
    throw InvalidInput("Signed distances start from curves, because curves have two sides. " +
                       given + " is about points. Clear it, or turn Signed off.");
  }
}

void Require(const DistanceSolver::Input& input, const DistanceSolver::Options& options)
{
  RequireOptions(options);
  if (options.isSigned)
  {
    RefusePoints(input, options.nearestSource);
  }
  if (input.mask && (!input.mask.IsOnPoints() || input.mask.components != 1))
  {
    throw InvalidInput(
      "Source Array '" + input.mask.name + "' has " + std::to_string(input.mask.components) +
      " components" + (input.mask.IsOnPoints() ? "" : " on cells") +
      ". Choose a point array with one component, which is 0 where there is no source.");
  }
  if (options.isSigned && input.labels && input.labels.components != 1)
  {
    throw InvalidInput("Label Array '" + input.labels.name + "' has " +
                       std::to_string(input.labels.components) +
                       " components. Choose an array with one component, an integer label.");
  }
}

bool HasNoSources(const DistanceSolver::Input& input)
{
  return input.ids.empty() && !input.mask && input.points.empty();
}

/// Returns the sources of this process, ascending, each once.
std::vector<Id> CollectSources(const TriangleMesh& mesh, const DistanceSolver::Input& input)
{
  RequireUsed("Source Point Ids", input.ids, mesh);
  std::vector<Id> sources = input.ids;
  if (input.mask)
  {
    const MultiVector mask = input.mask.read(NaNs::Refused).values;
    for (Id point = 0; point < mask.rows(); ++point)
    {
      if (mask(point, 0) != 0.0)
      {
        sources.push_back(point);
      }
    }
  }
  for (const DistanceSolver::FoundPoints& points : input.points)
  {
    const std::vector<Id> found = points.find();
    sources.insert(sources.end(), found.begin(), found.end());
  }
  SortEachOnce(sources);
  return sources;
}

std::vector<Id> FindSources(const Surface& surface, const DistanceSolver::Input& input)
{
  const TriangleMesh& mesh = surface.Mesh();
  std::vector<Id> sources;
  if (HasNoSources(input))
  {
    if (surface.IsFirst(!mesh.triangles.empty()))
    {
      sources = { FirstUsedPoint(mesh) };
    }
    return sources;
  }
  surface.Together([&] { sources = CollectSources(mesh, input); });
  if (!surface.Any(!sources.empty()))
  {
    throw InvalidInput(
      (input.mask ? "Source Array '" + input.mask.name + "' is 0 at all points of polygons"
                  : input.points.front().none) +
      ", so that no distance starts. Choose at least one point of the surface.");
  }
  return sources;
}

/// Throws InvalidInput if the label is nowhere or everywhere, because it has no border then. Labels
/// that are no integers are refused later.
void RequireLabel(const MultiVector& labels, const std::string& name, int inside)
{
  const bool areIntegers = (labels.array() == labels.array().round()).all();
  const auto count = (labels.array() == static_cast<double>(inside)).count();
  if (areIntegers && labels.size() > 0 && (count == 0 || count == labels.size()))
  {
    std::ostringstream message;
    message << "Label Array '" << name
            << "': " << (count == 0 ? "no point or cell has" : "all points or cells have")
            << " the Inside Label " << inside << ". ";
    if (count == 0)
    {
      message << "The labels are from " << labels.minCoeff() << " to " << labels.maxCoeff()
              << "; choose one of them.";
    }
    else
    {
      message << "A curve needs a second label around it.";
    }
    throw InvalidInput(message.str());
  }
}

/// The share of the points of all processes that functions reach and that have no distance.
double ShareWithout(const Surface& surface, const MultiVector& distance)
{
  const std::vector<char> isReached = surface.PointsWithFunctions();
  double counts[2] = { 0.0, 0.0 };
  for (std::size_t point = 0; point < isReached.size(); ++point)
  {
    if (isReached[point])
    {
      counts[0] += std::isnan(distance(static_cast<Id>(point), 0)) ? 1.0 : 0.0;
      counts[1] += 1.0;
    }
  }
  if (const DistributedRows* sums = surface.SumsOverProcesses())
  {
    sums->SumNumbers(counts, 2);
  }
  return counts[1] > 0.0 ? counts[0] / counts[1] : 0.0;
}

/// The warning if most points have no distance; empty: none.
std::string WarningOfShare(double without, const DistanceSolver::Input& input, bool isSigned)
{
  if (without <= 0.5)
  {
    return {};
  }
  const bool isDefault = !isSigned && HasNoSources(input);
  std::ostringstream text;
  text << (isDefault ? "No source is chosen, so that distances start at the first point of the "
                       "surface. "
                     : "")
       << std::setprecision(3) << 100.0 * without
       << " % of the points have no distance, because no " << (isSigned ? "curve" : "source")
       << " is on their connected components. "
       << (isSigned ? "Draw a curve on each of them"
                    : "Choose points there by Source Array, Selection or Sources")
       << ", or leave fragments out with the filter Connectivity.";
  return text.str();
}

SurfaceCurve BorderOf(
  const Surface& surface, const GivenField& labels, const DistanceSolver::Options& options)
{
  const Field field = labels.read(NaNs::Refused);
  RequireLabel(field.values, labels.name, options.insideLabel);
  try
  {
    return BorderOfLabel(
      surface.Mesh(), field, options.insideLabel, surface.AreCoincidentPointsWelded());
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput("Label Array '" + labels.name + "' and Inside Label " +
                       std::to_string(options.insideLabel) + ": " + error.what());
  }
}

} // namespace

SurfaceOptions DistanceSolver::SurfaceDefaults()
{
  SurfaceOptions options;
  options.choice.normalStabilization = DistanceOptions::LeastStabilization;
  options.space.joinAtPoints = true;
  options.functionsPerPoint = AsManyAsWanted;
  return options;
}

void DistanceSolver::UpdateCurve(const Surface& surface, const Input& input, const Options& options)
{
  Stages& stages = surface.GetStages();
  StageKey key;
  key.Add(stages.Version(SpaceStage)).Add(surface.AreCoincidentPointsWelded());
  key.Add(KeyOf(input.labels)).Add(options.insideLabel);
  key.Add(input.labels ? StageKey() : input.curve.version);
  stages.Run(CurveStage, key,
    [&]
    {
      curve_ = input.labels         ? BorderOf(surface, input.labels, options)
               : input.curve.divide ? input.curve.divide()
                                    : SurfaceCurve{};
      if (curve_.segments.empty())
      {
        throw InvalidInput(
          "Signed distances start from a curve, and none is given. Choose a Label "
          "Array, or connect lines on the surface as Sources, such as a Slice or a "
          "Contour of it.");
      }
    });
}

void DistanceSolver::UpdateDistance(const Surface& surface, const std::vector<Id>& sources,
  const Options& options, const Progress& progress)
{
  Stages& stages = surface.GetStages();
  const SolveOptions& solve = options.equation.solve;
  StageKey key;
  key.Add(stages.Version(HierarchyStage)).Add(solve.tolerance).Add(solve.maximumIterations);
  key.Add(options.isSigned).Add(options.isSigned ? stages.Version(CurveStage) : 0).Add(sources);
  stages.Run(SolveStage, key,
    [&]
    {
      const Job job = surface.MakeJob(progress);
      const DistanceField field = options.isSigned ? method_->FromCurve(curve_, solve, job)
                                                   : method_->From(sources, solve, job);
      result_.atPoints = Eigen::Map<const Eigen::VectorXd>(
        field.atPoints.data(), static_cast<Eigen::Index>(field.atPoints.size()));
      surface.FillCopies(result_.atPoints);
      result_.report = field.report;
      result_.accuracy = field.accuracy;
      result_.heatSweeps = field.heatSweeps;
      solveWarnings_ = WarningsOf(field, solve.tolerance);
      shareWithout_ = ShareWithout(surface, result_.atPoints);
    });
}

void DistanceSolver::UpdateNearest(const Surface& surface, const std::vector<Id>& sources,
  const Options& options, const Progress& progress)
{
  Stages& stages = surface.GetStages();
  StageKey key;
  key.Add(stages.Version(SolveStage)).Add(options.nearestSource);
  stages.Run(NearestStage, key,
    [&]
    {
      result_.nearest.clear();
      if (options.nearestSource)
      {
        const double* distance = result_.atPoints.data();
        result_.nearest =
          NearestSources(surface.Mesh(), { distance, distance + result_.atPoints.rows() }, sources,
            surface.AreCoincidentPointsWelded(), surface.MakeJob(progress));
      }
    });
}

const DistanceSolver::Result& DistanceSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  surface.Together([&] { Require(input, options); });
  surface.Prepare(job.progress.Part(0.0, 0.3));
  std::vector<Id> sources;
  if (options.isSigned)
  {
    this->UpdateCurve(surface, input, options);
  }
  else
  {
    sources = FindSources(surface, input);
  }
  DistanceOptions ofMethod;
  ofMethod.smoothing = options.smoothing;
  ofMethod.multigrid = options.equation.multigrid;
  UpdateDistanceMethod(surface, ofMethod, method_, job.progress.Part(0.3, 0.4));
  this->UpdateDistance(surface, sources, options, job.progress.Part(0.4, 0.98));
  this->UpdateNearest(surface, sources, options, job.progress.Part(0.98, 1.0));
  result_.warnings = solveWarnings_;
  result_.warnings.push_back(WarningOfShare(shareWithout_, input, options.isSigned));
  result_.warnings = NotEmpty(std::move(result_.warnings));
  job.Check(1.0);
  return result_;
}

DistanceSolver::Result DistanceSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(
    &DistanceSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
