#include "SolverProblem.h"

#include "Solvers/ParameterizationSolver.h"

namespace gridfem
{
namespace
{

Results ParameterizationResults(const Given& given, const SurfaceOptions& surface,
  const ParameterizationSolver::Options& options, const Job& job)
{
  const ParameterizationSolver::Result result =
    ParameterizationSolver::Solve(given.mesh, options, surface, job);
  const ParameterizationSolver::Flat& flat = result.flat;
  MultiVector corners(static_cast<Id>(flat.triangles.size()), 3);
  MultiVector distortion(corners.rows(), 2);
  for (Id t = 0; t < corners.rows(); ++t)
  {
    const auto& c = flat.triangles[t];
    corners.row(t) << static_cast<double>(c[0]), static_cast<double>(c[1]),
      static_cast<double>(c[2]);
    distortion.row(t) << flat.angle[t], flat.area[t];
  }
  Results results;
  results.arrays["FlatPoints"] = flat.points;
  results.arrays["FlatTriangles"] = std::move(corners);
  results.arrays["SurfacePoint"] = ColumnOf(flat.pointOf);
  results.arrays["Distortion"] = std::move(distortion);
  results.warnings = result.warnings;
  return results;
}

} // namespace

const MakeProblem MakeParameterization =
  &MakeSolverProblem<ParameterizationSolver, &ParameterizationResults>;

} // namespace gridfem
