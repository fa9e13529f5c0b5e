#include "Solvers/FunctionalMapSolver.h"

#include "Solvers/LocalSurface.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gridfem
{
namespace
{

constexpr const char* MapStage = "Map";

/// Above this mean mismatch, parts of the surfaces go to wrong places. The right maps of poses have
/// up to 0.27, and unrelated shapes 0.4 or more.
constexpr double LargestMismatch = 0.35;

/// Throws InvalidInput unless exactly one mode is constant.
void RequireOneComponent(const SurfaceModes& modes)
{
  const Index constants = modes.NumberOfConstants();
  if (constants > 1)
  {
    throw InvalidInput("The surface has " + std::to_string(constants) +
                       " connected components. A functional map needs one: extract the largest " +
                       "with the filter Connectivity.");
  }
  if (constants == 0)
  {
    throw InvalidInput("The surface comes with modes that are 0 on its boundary. A functional map "
                       "needs modes with Zero Boundary Values off.");
  }
}

/// The memory for copies of the modes: in rows, in the space of the map, and in groups.
MemoryNeed NeedOfMap(const PointModes& surface, const PointModes& reference)
{
  constexpr double Copies = 3.0;
  const double points = double(surface.values.rows() + reference.values.rows());
  const std::size_t modes = std::min(surface.eigenvalues.size(), reference.eigenvalues.size());
  return { Copies * sizeof(double) * double(modes) * points,
    "The map of " + std::to_string(modes) + " modes", "Choose a smaller Number Of Modes." };
}

/// Throws InvalidInput naming the first landmark that modes do not reach.
void RequireLandmarks(const std::vector<Landmark>& landmarks, const std::vector<char>& onSurface,
  const std::vector<char>& onReference)
{
  const auto isOn = [](Id point, const std::vector<char>& isReached)
  { return point >= 0 && point < static_cast<Id>(isReached.size()) && isReached[point]; };
  for (const Landmark& landmark : landmarks)
  {
    const bool isOnSurface = isOn(landmark[0], onSurface);
    if (!isOnSurface || !isOn(landmark[1], onReference))
    {
      throw InvalidInput("Landmarks has the point " +
                         std::to_string(landmark[isOnSurface ? 1 : 0]) +
                         ", but no polygon of the " + (isOnSurface ? "Reference" : "surface") +
                         " uses a point with this id.");
    }
  }
}

} // namespace

const FunctionalMapSolver::Result& FunctionalMapSolver::Update(
  Surface& surface, Surface& reference, const Input& input, const Options& options, const Job& job)
{
  RequireOptions(options);
  const SpectrumSolver::Options ofModes{ options.equation, options.numberOfModes };
  const auto update = [&](SurfaceModes& modes, Surface& of, const GivenModes& given, double from)
  {
    const Progress progress = job.progress.Part(from, from + 0.35);
    if (!given)
    {
      of.Prepare(progress.Part(0.0, 0.3));
    }
    modes.Update(of, given, ofModes, input.announce, progress.Part(0.3, 1.0));
    RequireOneComponent(modes);
  };
  update(modes_, surface, input.modes, 0.0);
  OfReference([&] { update(ofReference_, reference, input.referenceModes, 0.35); });
  RequireLandmarks(input.landmarks, modes_.IsReached(), ofReference_.IsReached());
  StageKey key;
  key.Add(surface.GetStages().Version(ModesStage)).Add(reference.GetStages().Version(ModesStage));
  for (const Landmark& landmark : input.landmarks)
  {
    key.Add(landmark[0]).Add(landmark[1]);
  }
  surface.GetStages().Run(MapStage, key,
    [&]
    {
      surface.Require(NeedOfMap(modes_.Modes(), ofReference_.Modes()));
      this->FindMap(input, surface.MakeJob(job.progress.Part(0.7, 1.0)));
    });
  this->Judge();
  job.Check(1.0);
  return result_;
}

void FunctionalMapSolver::FindMap(const Input& input, const Job& job)
{
  result_ = {};
  const ModesOfShape surface{ modes_.Mesh(), modes_.Modes(), modes_.IsReached() };
  const ModesOfShape reference{ ofReference_.Mesh(), ofReference_.Modes(),
    ofReference_.IsReached() };
  result_.map = FindFunctionalMap(surface, reference, input.landmarks, job);
}

/// Takes the outcome of all parts together.
void FunctionalMapSolver::Judge()
{
  result_.isConverged = modes_.IsConverged() && ofReference_.IsConverged();
  result_.where = modes_.Device().empty() ? ofReference_.Device() : modes_.Device();
  result_.warnings = modes_.Warnings();
  for (const std::string& warning : ofReference_.Warnings())
  {
    result_.warnings.push_back("Reference: " + warning);
  }
  if (result_.map.meanMismatch > LargestMismatch)
  {
    result_.warnings.push_back("The surfaces do not match: the mismatch is " +
                               std::to_string(std::lround(100.0 * result_.map.meanMismatch)) +
                               " %. Give Landmarks, or more of them, if their shapes are alike.");
  }
  else if (result_.map.isAmbiguous)
  {
    result_.warnings.emplace_back("The surfaces match in several ways, because they are nearly "
                                  "symmetric. Give Landmarks to choose one.");
  }
}

FunctionalMapSolver::Result FunctionalMapSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  std::shared_ptr<const TriangleMesh> reference, const Input& input, const Options& options,
  const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  Stages ofReference;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  LocalSurface other(ofReference, std::move(reference), surfaceOptions);
  FunctionalMapSolver solver;
  solver.Update(surface, other, input, options, job);
  return std::move(solver.result_);
}

} // namespace gridfem
