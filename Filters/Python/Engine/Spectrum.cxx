#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/SpectrumSolver.h"

namespace gridfem
{
namespace
{

class SpectrumProblem : public Problem
{
public:
  explicit SpectrumProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    SpectrumSolver::Result spectrum =
      SpectrumSolver::Solve(given.mesh, {}, options_, surface_, { 0, progress });
    Results results;
    results.arrays["Modes"] = std::move(spectrum.atPoints);
    results.arrays["Eigenvalues"] =
      Eigen::Map<const Eigen::VectorXd>(spectrum.eigenvalues.data(), spectrum.NumberOfModes());
    results.Warn(spectrum.warnings);
    return results;
  }

private:
  SurfaceOptions surface_ = SpectrumSolver::SurfaceDefaults();
  SpectrumSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeSpectrum(Properties& properties)
{
  return std::make_unique<SpectrumProblem>(properties);
}

} // namespace gridfem
