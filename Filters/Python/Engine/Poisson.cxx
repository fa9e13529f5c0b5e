#include "SolverProblem.h"

#include "Solvers/PoissonSolver.h"

namespace gridfem
{
namespace
{

Results PoissonResults(const Given& given, const SurfaceOptions& surface,
  const PoissonSolver::Options& options, const Job& job)
{
  PoissonSolver::Input input;
  input.values = given.Field("values");
  input.gradients = given.Field("gradients");
  input.gradientScale = given.Field("gradient_scale");
  input.weights = given.Field("weights");
  input.flux = given.Field("flux");
  input.constraints = given.Constraints("held");
  PoissonSolver::Result result = PoissonSolver::Solve(given.mesh, input, options, surface, job);
  given.KeepPlaces("values", result.atPoints);
  Results results;
  results.arrays["Solution"] = std::move(result.atPoints);
  results.Warn(result.warnings);
  return results;
}

} // namespace

const MakeProblem MakePoisson = &MakeSolverProblem<PoissonSolver, &PoissonResults>;

} // namespace gridfem
