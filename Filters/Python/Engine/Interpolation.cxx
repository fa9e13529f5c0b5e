#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/InterpolationSolver.h"

namespace gridfem
{
namespace
{

class InterpolationProblem : public Problem
{
public:
  explicit InterpolationProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    InterpolationSolver::Input input;
    input.values.find = [&given] { return given.KnownValues(nullptr); };
    const InterpolationSolver::Result result =
      InterpolationSolver::Solve(given.mesh, input, options_, surface_, { 0, progress });
    Results results;
    results.arrays["Interpolated"] = result.atPoints;
    results.warnings = result.warnings;
    return results;
  }

private:
  SurfaceOptions surface_ = InterpolationSolver::SurfaceDefaults();
  InterpolationSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeInterpolation(Properties& properties)
{
  return std::make_unique<InterpolationProblem>(properties);
}

} // namespace gridfem
