#include "Solvers/PathSolver.h"

#include "Base/Errors.h"
#include "Base/SortEachOnce.h"
#include "Distance/NearestSource.h"
#include "Solvers/SolveOnMesh.h"

#include <algorithm>
#include <map>
#include <utility>

namespace gridfem
{
namespace
{

constexpr double LengthRounding = 1e-12;

/// Returns the points of one kind, in their order.
std::vector<Id> CollectPoints(
  const TriangleMesh& mesh, const std::string& kind, const PathSolver::GivenPoints& given)
{
  RequireUsed(kind + " Point Ids", given.ids, mesh);
  std::vector<Id> points = given.ids;
  if (given.mask)
  {
    if (!given.mask.IsOnPoints() || given.mask.components != 1)
    {
      throw InvalidInput(kind + " Array '" + given.mask.name +
                         "' must be a point array with one component, which is 0 at other points.");
    }
    const std::vector<char> isUsed = UsedPoints(mesh);
    const MultiVector mask = given.mask.read(NaNs::Refused).values;
    for (Id point = 0; point < mask.rows(); ++point)
    {
      if (mask(point, 0) != 0.0 && isUsed[point])
      {
        points.push_back(point);
      }
    }
  }
  for (const DistanceSolver::FoundPoints& found : given.points)
  {
    const std::vector<Id> more = found.find();
    points.insert(points.end(), more.begin(), more.end());
  }
  if (points.empty() && given.AreGiven())
  {
    throw InvalidInput(
      (given.mask ? kind + " Array '" + given.mask.name + "' is 0 at all points of polygons"
                  : given.points.front().none) +
      ". Choose at least one point of the surface.");
  }
  return points;
}

std::vector<Id> JoinedIds(std::vector<Id> a, const std::vector<Id>& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void DropRepeated(std::vector<Id>& points)
{
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

std::vector<std::string> WarningsOfUnreached(const std::vector<Id>& unreached, std::size_t paths)
{
  if (unreached.empty())
  {
    return {};
  }
  return { std::to_string(unreached.size()) + " of " + std::to_string(unreached.size() + paths) +
           " paths do not exist, because their ends are on different connected components. The "
           "first of them leads to the point " +
           std::to_string(unreached.front()) + "." };
}

std::vector<std::string> WarningsOfLength(
  const std::vector<PathSolver::Path>& paths, std::size_t mostWindows)
{
  const auto unknown = std::count_if(
    paths.begin(), paths.end(), [](const PathSolver::Path& path) { return !path.isShortest; });
  if (unknown == 0)
  {
    return {};
  }
  return { std::to_string(unknown) + " of " + std::to_string(paths.size()) +
           " paths may not be the shortest, because the search for shorter ones needs more than " +
           std::to_string(mostWindows) + " windows. No path nearby is shorter." };
}

} // namespace

std::vector<Index> PathSolver::PlacesOf(const std::vector<Id>& points) const
{
  std::vector<Index> places;
  for (const Id point : points)
  {
    places.push_back(graph_->PlaceOf(point));
  }
  return places;
}

Id PathSolver::FarthestFrom(const std::vector<Id>& points, const Job& job)
{
  search_->From(this->PlacesOf(points), {}, job);
  return search_->Farthest();
}

/// Chooses the points that are missing. A point that is given twice, and no other, leads to itself.
void PathSolver::Choose(Ends& ends, bool isInOrder, const Job& job)
{
  const bool isOneLegGiven = isInOrder && ends.sources.size() + ends.targets.size() > 1;
  if (isInOrder)
  {
    ends.sources = JoinedIds(std::move(ends.sources), ends.targets);
    ends.targets.clear();
  }
  DropRepeated(ends.sources);
  DropRepeated(ends.targets);
  if (!isInOrder && ends.sources.empty() && ends.targets.size() > 1)
  {
    ends.sources = { ends.targets.front() };
    ends.targets.erase(ends.targets.begin());
  }
  if (ends.sources.empty() && ends.targets.empty())
  {
    ends.sources = { FirstUsedPoint(graph_->Mesh()) };
  }
  if (ends.sources.empty())
  {
    ends.sources = { this->FarthestFrom(ends.targets, job) };
  }
  else if (ends.targets.empty() && (!isInOrder || ends.sources.size() == 1))
  {
    ends.targets = { isOneLegGiven ? ends.sources.front() : this->FarthestFrom(ends.sources, job) };
  }
}

/// Adds a path to each target that a source can reach.
void PathSolver::FindPaths(const Ends& ends, const Job& job)
{
  const std::vector<Index> sources = this->PlacesOf(ends.sources);
  const std::vector<Index> targets = this->PlacesOf(ends.targets);
  std::map<Index, Id> sourceAt; // the first at each place
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    sourceAt.emplace(sources[k], ends.sources[k]);
  }
  search_->From(sources, targets, job.Part(0.0, 0.3));
  std::vector<Path> found;
  std::vector<Index> reached;
  double bound = 0.0;
  for (std::size_t k = 0; k < targets.size(); ++k)
  {
    const std::vector<PathSearch::Node> way = search_->WayTo(targets[k]);
    SurfacePath path = way.empty() ? SurfacePath() : PullTight(*graph_, way, job.Part(0.3, 0.3));
    if (path.points.empty())
    {
      result_.unreached.push_back(ends.targets[k]);
      continue;
    }
    bound = std::max(bound, path.length);
    found.push_back(
      { sourceAt.at(static_cast<Index>(way.front())), ends.targets[k], std::move(path), false });
    reached.push_back(targets[k]);
  }
  const bool isShortest = windows_->From(sources, reached, bound, mostWindows_, job.Part(0.3, 0.9));
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    Path& path = found[k];
    path.isShortest = isShortest;
    if (windows_->LengthTo(reached[k]) < (1.0 - LengthRounding) * path.path.length)
    {
      const std::vector<TriangleStrip> strips = windows_->StripsTo(reached[k]);
      path.source = sourceAt.at(strips.front().from);
      path.path = PullTight(*graph_, strips, job.Part(0.9, 0.9));
    }
    result_.paths.push_back(std::move(path));
  }
}

/// Connects points with each other. Every part of the work has one of them as the source.
void PathSolver::Connect(const std::vector<Id>& points, PathType type, const Job& job)
{
  const bool returns = type == PathType::Closed && points.front() != points.back();
  const std::size_t parts = points.size() - (returns ? 0 : 1);
  const double share = 1.0 / static_cast<double>(parts);
  for (std::size_t k = 0; k < parts; ++k)
  {
    const auto next = points.begin() + static_cast<Id>((k + 1) % points.size());
    const double done = share * static_cast<double>(k);
    this->FindPaths(
      { { points[k] }, { next, type == PathType::AllPairs ? points.end() : next + 1 } },
      job.Part(done, done + share));
  }
}

const PathSolver::Result& PathSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireOptions(options);
  surface.PrepareMesh(job.progress.Part(0.0, 0.1));
  const bool welds = surface.UsedOptions().space.weldCoincidentPoints;
  Stages& stages = surface.GetStages();
  StageKey key;
  key.Add(stages.Version(MeshStage)).Add(welds);
  stages.Run(GraphStage, key,
    [&]
    {
      search_.reset();
      windows_.reset();
      graph_ = std::make_unique<PathGraph>(surface.SharedMesh(), welds, surface.Threads());
      search_ = std::make_unique<PathSearch>(*graph_);
      windows_ = std::make_unique<WindowSearch>(*graph_);
    });
  job.Check(0.2);
  Ends ends{ CollectPoints(surface.Mesh(), "Source", input.sources),
    CollectPoints(surface.Mesh(), "Target", input.targets) };
  key = {};
  key.Add(stages.Version(GraphStage)).Add(KeyOfOptions(options));
  key.Add(ends.sources).Add(ends.targets);
  stages.Run(SolveStage, key,
    [&]
    {
      result_ = {};
      const PathType type = options.pathType;
      const Job work = surface.MakeJob(job.progress);
      this->Choose(ends, type != PathType::ToNearestSource, work.Part(0.2, 0.4));
      if (type == PathType::ToNearestSource)
      {
        this->FindPaths(ends, work.Part(0.4, 1.0));
      }
      else
      {
        this->Connect(JoinedIds(ends.sources, ends.targets), type, work.Part(0.4, 1.0));
      }
      result_.warnings = WarningsOfUnreached(result_.unreached, result_.paths.size());
      SortEachOnce(result_.unreached);
      for (const std::string& warning : WarningsOfLength(result_.paths, mostWindows_))
      {
        result_.warnings.push_back(warning);
      }
    });
  job.Check(1.0);
  return result_;
}

PathSolver::Result PathSolver::Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
  const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(&PathSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
