#include "SolverProblem.h"

#include "Solvers/CurvatureSolver.h"

namespace gridfem
{
namespace
{

Results CurvaturesResults(const Given& given, const SurfaceOptions& surface,
  const CurvatureSolver::Options& options, const Job& job)
{
  CurvatureSolver::Result found = CurvatureSolver::Solve(given.mesh, options, surface, job);
  Results results;
  for (std::size_t k = 0; k < CurvatureSolver::Numbers.size(); ++k)
  {
    results.arrays[CurvatureSolver::Numbers[k]] = found.numbers.col(static_cast<Id>(k));
  }
  results.arrays["MinimumCurvatureDirection"] = std::move(found.minimumDirection);
  results.arrays["MaximumCurvatureDirection"] = std::move(found.maximumDirection);
  results.Warn(found.warnings);
  return results;
}

} // namespace

const MakeProblem MakeCurvatures = &MakeSolverProblem<CurvatureSolver, &CurvaturesResults>;

} // namespace gridfem
