#include "Solvers/DistanceSolver.h"

#include "Base/Errors.h"
#include "Problems/NearestSource.h"
#include "Problems/SolveWarnings.h"
#include "Solvers/DistanceHierarchy.h"
#include "Solvers/LocalSurface.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// Refuses sources that are points, because points have no sides.
void RefusePoints(const DistanceSolver::Input& input, bool nearestSource)
{
  const std::string given = !input.ids.empty()      ? "the Source Point Ids"
                            : input.mask            ? "the Source Array"
                            : !input.points.empty() ? input.points.front().property
                            : nearestSource         ? "Nearest Source"
                                                    : "";
  if (!given.empty())
  {
    throw InvalidInput(
      "Signed distances start from curves that divide the surface into two sides, not from "
      "points. Clear " +
      given + ", or turn Signed off.");
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
    throw InvalidInput("Source Array '" + input.mask.name +
                       "' must be a point array with one component, 0 where there is no source.");
  }
  if (options.isSigned && input.labels && input.labels.components != 1)
  {
    throw InvalidInput("Label Array '" + input.labels.name + "' must have one component.");
  }
}

void RequireUsed(const std::vector<Id>& ids, const TriangleMesh& mesh)
{
  const std::vector<char> used = ids.empty() ? std::vector<char>() : UsedPoints(mesh);
  for (const Id id : ids)
  {
    if (id < 0 || id >= static_cast<Id>(used.size()) || !used[id])
    {
      throw InvalidInput(
        "Source Point Ids: no polygon of the mesh has a point " + std::to_string(id) + ".");
    }
  }
}

/// Returns the sources of this process, ascending, each once.
std::vector<Id> CollectSources(const TriangleMesh& mesh, const DistanceSolver::Input& input)
{
  RequireUsed(input.ids, mesh);
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
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  return sources;
}

std::vector<Id> FindSources(const Surface& surface, const DistanceSolver::Input& input)
{
  const TriangleMesh& mesh = surface.Mesh();
  std::vector<Id> sources;
  if (input.ids.empty() && !input.mask && input.points.empty())
  {
    if (surface.IsFirst(!mesh.triangles.empty()))
    {
      sources = { mesh.triangles.front()[0] };
    }
    return sources;
  }
  surface.Together([&] { sources = CollectSources(mesh, input); });
  if (!surface.Any(!sources.empty()))
  {
    throw InvalidInput(
      (input.mask ? "Source Array '" + input.mask.name + "' is 0 at all points of polygons"
                  : input.points.front().none) +
      ", so no distance starts.");
  }
  return sources;
}

SurfaceCurve BorderOf(
  const Surface& surface, const GivenField& labels, const DistanceSolver::Options& options)
{
  const Field field = labels.read(NaNs::Refused);
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
  options.choice.normalStabilization = 0.1; // with less, hidden functions spoil small numbers
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
          "A signed distance starts from a curve. Choose a Label Array, or connect "
          "Sources to lines on the surface, such as a Slice or a Contour.");
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
      result_.warnings = WarningsOf(field, solve.tolerance);
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
  job.Check(1.0);
  return result_;
}

DistanceSolver::Result DistanceSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  DistanceSolver solver;
  solver.Update(surface, input, options, job);
  return std::move(solver.result_);
}

} // namespace gridfem
