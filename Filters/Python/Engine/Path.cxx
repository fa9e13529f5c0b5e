#include "SolverProblem.h"

#include "Solvers/PathSolver.h"

namespace gridfem
{
namespace
{

Results PathResults(const Given& given, const SurfaceOptions& surface,
  const PathSolver::Options& options, const Job& job)
{
  PathSolver::Input input;
  input.sources.ids = given.sources;
  const PathSolver::Result found = PathSolver::Solve(given.mesh, input, options, surface, job);
  Id points = 0;
  for (const PathSolver::Path& path : found.paths)
  {
    points += static_cast<Id>(path.path.points.size());
  }
  std::vector<std::array<Id, 3>> corners;
  MultiVector weights(points, 3);
  MultiVector lengths(static_cast<Id>(found.paths.size()), 1);
  std::vector<Id> sources;
  std::vector<Id> targets;
  Id row = 0;
  for (std::size_t k = 0; k < found.paths.size(); ++k)
  {
    lengths(static_cast<Id>(k), 0) = found.paths[k].path.length;
    sources.push_back(found.paths[k].source);
    targets.push_back(found.paths[k].target);
    for (const PathPoint& point : found.paths[k].path.points)
    {
      corners.push_back(given.mesh->triangles[point.triangle]);
      weights.row(row++) = point.weights;
    }
  }
  Results results;
  results.arrays["CornerIds"] = RowsOf(corners);
  results.arrays["CornerWeights"] = std::move(weights);
  results.arrays["Length"] = std::move(lengths);
  results.arrays["SourceId"] = ColumnOf(sources);
  results.arrays["TargetId"] = ColumnOf(targets);
  results.arrays["UnreachedTargets"] = ColumnOf(found.unreached);
  results.warnings = found.warnings;
  return results;
}

} // namespace

const MakeProblem MakePath = &MakeSolverProblem<PathSolver, &PathResults>;

} // namespace gridfem
