#include "SolverProblem.h"

#include "Solvers/SignatureSolver.h"

namespace gridfem
{
namespace
{

Results SignaturesResults(const Given& given, const SurfaceOptions& surface,
  const SignatureSolver::Options& options, const Job& job)
{
  SignatureSolver::Input input;
  input.values = given.Field("values");
  SignatureSolver::Result signatures =
    SignatureSolver::Solve(given.mesh, input, options, surface, job);
  Results results;
  results.arrays["HeatKernelSignature"] = std::move(signatures.heatKernel);
  results.arrays["WaveKernelSignature"] = std::move(signatures.waveKernel);
  const std::vector<double>& eigenvalues = signatures.modes->eigenvalues;
  results.arrays["Eigenvalue"] =
    Eigen::Map<const Eigen::VectorXd>(eigenvalues.data(), static_cast<Id>(eigenvalues.size()));
  if (options.filterType != ModeFilter::None)
  {
    results.arrays["Coefficient"] = std::move(signatures.coefficients);
    results.arrays["RemainingError"] = std::move(signatures.remaining);
  }
  if (options.filterType == ModeFilter::Surrogates)
  {
    results.arrays["Surrogates"] = std::move(signatures.surrogates);
  }
  results.Warn(signatures.warnings);
  return results;
}

} // namespace

const MakeProblem MakeSignatures = &MakeSolverProblem<SignatureSolver, &SignaturesResults>;

} // namespace gridfem
