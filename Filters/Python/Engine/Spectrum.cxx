#include "SolverProblem.h"

#include "Solvers/SpectrumSolver.h"

namespace gridfem
{
namespace
{

Results SpectrumResults(const Given& given, const SurfaceOptions& surface,
  const SpectrumSolver::Options& options, const Job& job)
{
  SpectrumSolver::Result spectrum = SpectrumSolver::Solve(given.mesh, {}, options, surface, job);
  Results results;
  results.arrays["Modes"] = std::move(spectrum.atPoints);
  results.arrays["Eigenvalues"] =
    Eigen::Map<const Eigen::VectorXd>(spectrum.eigenvalues.data(), spectrum.NumberOfModes());
  results.Warn(spectrum.warnings);
  return results;
}

} // namespace

const MakeProblem MakeSpectrum = &MakeSolverProblem<SpectrumSolver, &SpectrumResults>;

} // namespace gridfem
