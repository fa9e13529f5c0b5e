#include "SolverProblem.h"

#include "Solvers/DiffusionSolver.h"
#include "Solvers/LocalSurface.h"

namespace gridfem
{
namespace
{

Results DiffusionResults(const Given& given, const SurfaceOptions& discretized,
  const DiffusionSolver::Options& options, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, given.mesh, discretized);
  DiffusionSolver solver;
  const DiffusionSolver::Result& result = solver.Update(surface,
    { given.Field("values"), given.Field("source"), given.Constraints("held") }, options, job);
  Results results;
  MultiVector diffused = result.steps.back().atPoints;
  given.KeepPlaces("values", diffused);
  results.arrays["Diffused"] = std::move(diffused);
  results.Warn(solver.Warnings(options.numberOfSteps));
  return results;
}

} // namespace

const MakeProblem MakeDiffusion = &MakeSolverProblem<DiffusionSolver, &DiffusionResults>;

} // namespace gridfem
