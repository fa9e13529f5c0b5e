#include "SolverProblem.h"

#include "Base/VectorRows.h"
#include "Solvers/DetailSolver.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

Results DetailResults(const Given& given, const SurfaceOptions& surface,
  const DetailSolver::Options& options, const Job& job)
{
  DetailSolver::Input input;
  input.values = given.Field("values");
  input.scale = given.Field("scales");
  input.custom = [](double curvature) { return std::min(std::abs(curvature), 1.0); };
  const DetailSolver::Result result = DetailSolver::Solve(given.mesh, input, options, surface, job);
  Results results;
  results.arrays["Points"] = RowsOf(result.points);
  if (input.values)
  {
    results.arrays["Filtered"] = given.arrays.at("values").values + result.change;
  }
  results.Warn(result.warnings);
  return results;
}

} // namespace

const MakeProblem MakeDetail = &MakeSolverProblem<DetailSolver, &DetailResults>;

} // namespace gridfem
