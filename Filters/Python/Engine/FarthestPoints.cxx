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

std::unique_ptr<Problem> MakeFarthestPoints(Properties& properties)
{
  return MakeSolverProblem<FarthestPointsSolver>(properties,
    FarthestPointsSolver::SurfaceDefaults(), &FarthestPointsResults,
    DistanceOptions::LeastStabilization);
}

} // namespace gridfem
