#include "SolverProblem.h"

#include "Base/VectorRows.h"
#include "Solvers/FlowSolver.h"

namespace gridfem
{
namespace
{

Results FlowResults(const Given& given, const SurfaceOptions& surface,
  const FlowSolver::Options& options, const Job& job)
{
  Results results;
  std::vector<Vec3> points;
  results.Warn(FlowSolver::Solve(given.mesh, options, points, surface, job).warnings);
  results.arrays["Points"] = RowsOf(points);
  return results;
}

} // namespace

const MakeProblem MakeFlow = &MakeSolverProblem<FlowSolver, &FlowResults>;

} // namespace gridfem
