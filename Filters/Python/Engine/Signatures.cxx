#include "SolverProblem.h"

#include "Solvers/SignatureSolver.h"

namespace gridfem
{
namespace
{

Results SignaturesResults(const Given& given, const SurfaceOptions& surface,
  const SignatureSolver::Options& options, const Job& job)
{
  SignatureSolver::Result signatures =
    SignatureSolver::Solve(given.mesh, {}, options, surface, job);
  Results results;
  results.arrays["HeatKernelSignature"] = std::move(signatures.heatKernel);
  results.arrays["WaveKernelSignature"] = std::move(signatures.waveKernel);
  results.Warn(signatures.warnings);
  return results;
}

} // namespace

const MakeProblem MakeSignatures = &MakeSolverProblem<SignatureSolver, &SignaturesResults>;

} // namespace gridfem
