#include "SolverProblem.h"

#include "Solvers/FarthestPointsSolver.h"

namespace gridfem
{
namespace
{

Results FarthestPointsResults(const Given& given, const SurfaceOptions& surface,
  const FarthestPointsSolver::Options& options, const Job& job)
{
  const FarthestPointsSolver::Result result =
    FarthestPointsSolver::Solve(given.mesh, options, surface, job);
  Results results;
  results.arrays["Distance"] = result.atPoints;
  results.arrays["NearestPoint"] = ColumnOf(result.nearest);
  results.arrays["FarthestPoints"] = ColumnOf(result.points);
  results.warnings = result.warnings;
  return results;
}

} // namespace

template<>
inline constexpr double LeastStabilization<FarthestPointsSolver> =
  DistanceOptions::LeastStabilization;

const MakeProblem MakeFarthestPoints =
  &MakeSolverProblem<FarthestPointsSolver, &FarthestPointsResults>;

} // namespace gridfem
