#include "SolverProblem.h"

#include "Solvers/InterpolationSolver.h"

namespace gridfem
{
namespace
{

Results InterpolationResults(const Given& given, const SurfaceOptions& surface,
  const InterpolationSolver::Options& options, const Job& job)
{
  InterpolationSolver::Input input;
  input.values.find = [&given] { return given.KnownValues(nullptr); };
  const InterpolationSolver::Result result =
    InterpolationSolver::Solve(given.mesh, input, options, surface, job);
  Results results;
  results.arrays["Interpolated"] = result.atPoints;
  results.warnings = result.warnings;
  return results;
}

} // namespace

const MakeProblem MakeInterpolation =
  &MakeSolverProblem<InterpolationSolver, &InterpolationResults>;

} // namespace gridfem
