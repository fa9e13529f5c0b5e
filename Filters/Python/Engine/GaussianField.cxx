#include "SolverProblem.h"

#include "Solvers/GaussianFieldSolver.h"

namespace gridfem
{
namespace
{

Results GaussianFieldResults(const Given& given, const SurfaceOptions& surface,
  const GaussianFieldSolver::Options& options, const Job& job)
{
  GaussianFieldSolver::Input input;
  if (!given.sources.empty())
  {
    input.observations.find = [&given]
    {
      return PointValues{ given.sources, Eigen::Map<const Eigen::VectorXd>(given.observed.data(),
                                           static_cast<Id>(given.observed.size())) };
    };
  }
  GaussianFieldSolver::Result result =
    GaussianFieldSolver::Solve(given.mesh, input, options, surface, job);
  Results results;
  if (input.observations)
  {
    results.arrays["Prediction"] = result.prediction.mean;
    results.arrays["LeaveOneOutError"] = result.prediction.leaveOneOutError;
    results.arrays["LogLikelihood"] = MultiVector::Constant(1, 1, result.prediction.logLikelihood);
    results.arrays["LeaveOneOutRatio"] =
      MultiVector::Constant(1, 1, result.prediction.leaveOneOutRatio);
    if (options.statistics)
    {
      results.arrays["PredictionStandardDeviation"] = result.atPoints.col(1);
    }
  }
  results.arrays["Samples"] = std::move(result.atPoints);
  results.warnings = std::move(result.warnings);
  return results;
}

} // namespace

const MakeProblem MakeGaussianField =
  &MakeSolverProblem<GaussianFieldSolver, &GaussianFieldResults>;

} // namespace gridfem
