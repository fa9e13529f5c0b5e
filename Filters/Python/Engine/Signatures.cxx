#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/SignatureSolver.h"

namespace gridfem
{
namespace
{

class SignatureProblem : public Problem
{
public:
  explicit SignatureProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    SignatureSolver::Result signatures =
      SignatureSolver::Solve(given.mesh, {}, options_, surface_, { 0, progress });
    Results results;
    results.arrays["HeatKernelSignature"] = std::move(signatures.heatKernel);
    results.arrays["WaveKernelSignature"] = std::move(signatures.waveKernel);
    results.Warn(signatures.warnings);
    return results;
  }

private:
  SurfaceOptions surface_ = SignatureSolver::SurfaceDefaults();
  SignatureSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeSignatures(Properties& properties)
{
  return std::make_unique<SignatureProblem>(properties);
}

} // namespace gridfem
