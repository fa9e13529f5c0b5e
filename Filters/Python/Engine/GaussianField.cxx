#include "SolverProblem.h"

#include "Solvers/GaussianFieldSolver.h"

namespace gridfem
{
namespace
{

Results GaussianFieldResults(const Given& given, const SurfaceOptions& surface,
  const GaussianFieldSolver::Options& options, const Job& job)
{
  GaussianFieldSolver::Result result =
    GaussianFieldSolver::Solve(given.mesh, options, surface, job);
  Results results;
  results.arrays["Samples"] = std::move(result.atPoints);
  results.warnings = std::move(result.warnings);
  return results;
}

} // namespace

std::unique_ptr<Problem> MakeGaussianField(Properties& properties)
{
  return MakeSolverProblem<GaussianFieldSolver>(
    properties, GaussianFieldSolver::SurfaceDefaults(), &GaussianFieldResults);
}

} // namespace gridfem
