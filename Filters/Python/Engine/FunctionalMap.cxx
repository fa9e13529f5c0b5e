#include "SolverProblem.h"

#include "Base/Errors.h"
#include "Solvers/FunctionalMapSolver.h"

namespace gridfem
{
namespace
{

Results FunctionalMapResults(const Given& given, const SurfaceOptions& surface,
  const FunctionalMapSolver::Options& options, const Job& job)
{
  if (!given.reference)
  {
    throw InvalidInput("there is no reference.");
  }
  FunctionalMapSolver::Input input;
  for (std::size_t k = 0; k < given.sources.size(); ++k)
  {
    input.landmarks.push_back({ given.sources[k], given.partners.at(k) });
  }
  FunctionalMapSolver::Result found =
    FunctionalMapSolver::Solve(given.mesh, given.reference, input, options, surface, job);
  Results results;
  results.arrays["ReferenceCorners"] = RowsOf(found.map.corners);
  results.arrays["ReferenceWeights"] = std::move(found.map.weights);
  results.arrays["ReferencePlace"] = std::move(found.map.places);
  results.arrays["Mismatch"] = Eigen::Map<const Eigen::VectorXd>(
    found.map.mismatch.data(), static_cast<Id>(found.map.mismatch.size()));
  results.arrays["FunctionalMap"] = std::move(found.map.matrix);
  results.Warn(found.warnings);
  return results;
}

} // namespace

const MakeProblem MakeFunctionalMap =
  &MakeSolverProblem<FunctionalMapSolver, &FunctionalMapResults>;

} // namespace gridfem
