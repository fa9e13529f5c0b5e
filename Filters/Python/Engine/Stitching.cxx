#include "SolverProblem.h"

#include "Solvers/StitchSolver.h"

namespace gridfem
{
namespace
{

Results StitchingResults(const Given& given, const SurfaceOptions& surface,
  const StitchSolver::Options& options, const Job& job)
{
  SurfaceOptions asked = surface;
  asked.functionsPerPoint = StitchSolver::FunctionsPerPoint(options);
  StitchSolver::Result result = StitchSolver::Solve(
    given.mesh, { given.Field("colors"), given.Field("labels") }, options, asked, job);
  Results results;
  if (given.arrays.at("colors").isOnPoints)
  {
    given.KeepUnsolved("colors", result.isReached, result.values);
    results.arrays["StitchedColors"] = std::move(result.values);
  }
  else
  {
    const MultiVector means = given.MeansOnCells(result.values);
    results.arrays["StitchedColors"] =
      means.array().isNaN().select(given.arrays.at("colors").values, means);
  }
  results.Warn(result.warnings);
  return results;
}

} // namespace

const MakeProblem MakeStitching = &MakeSolverProblem<StitchSolver, &StitchingResults>;

} // namespace gridfem
