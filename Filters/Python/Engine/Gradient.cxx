#include "SolverProblem.h"

#include "Solvers/GradientSolver.h"

namespace gridfem
{
namespace
{

Results GradientResults(const Given& given, const SurfaceOptions& surface,
  const GradientSolver::Options& options, const Job& job)
{
  GradientSolver::Result found =
    GradientSolver::Solve(given.mesh, { given.Field("values") }, options, surface, job);
  Results results;
  for (std::vector<GradientSolver::Derived>* fields : { &found.derivatives, &found.parts })
  {
    for (GradientSolver::Derived& field : *fields)
    {
      results.arrays[field.name] = std::move(field.atPoints);
    }
  }
  results.Warn(found.warnings);
  return results;
}

} // namespace

const MakeProblem MakeGradient = &MakeSolverProblem<GradientSolver, &GradientResults>;

} // namespace gridfem
