#include "SolverProblem.h"

#include "Solvers/DistanceSolver.h"

namespace gridfem
{
namespace
{

Results DistanceResults(const Given& given, const SurfaceOptions& surface,
  const DistanceSolver::Options& options, const Job& job)
{
  DistanceSolver::Input input;
  input.ids = given.sources;
  input.labels = given.Field("labels");
  const DistanceSolver::Result result =
    DistanceSolver::Solve(given.mesh, input, options, surface, job);
  Results results;
  results.arrays["Distance"] = result.atPoints;
  if (options.nearestSource)
  {
    results.arrays["NearestSource"] = ColumnOf(result.nearest);
  }
  results.warnings = result.warnings;
  return results;
}

} // namespace

template<>
inline constexpr double LeastStabilization<DistanceSolver> = DistanceOptions::LeastStabilization;

const MakeProblem MakeDistance = &MakeSolverProblem<DistanceSolver, &DistanceResults>;

} // namespace gridfem
