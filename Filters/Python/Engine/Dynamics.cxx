#include "SolverProblem.h"

#include "Solvers/DynamicsSolver.h"

namespace gridfem
{
namespace
{

Results DynamicsResults(const Given& given, const SurfaceOptions& surface,
  const DynamicsSolver::Options& options, const Job& job)
{
  DynamicsSolver::Input input;
  input.start = given.Field("start");
  input.velocity = given.Field("velocity");
  input.reactions = given.reactions;
  DynamicsSolver::Result result = DynamicsSolver::Solve(given.mesh, input, options, surface, job);
  Results results;
  results.arrays["State"] = std::move(result.frames.back().atPoints);
  results.warnings = std::move(result.warnings);
  return results;
}

} // namespace

const MakeProblem MakeDynamics = &MakeSolverProblem<DynamicsSolver, &DynamicsResults>;

} // namespace gridfem
