#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/LocalSurface.h"
#include "Solvers/PoissonSolver.h"

namespace gridfem
{
namespace
{

class PoissonProblem : public Problem
{
public:
  explicit PoissonProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    Stages stages;
    LocalSurface surface(stages, given.mesh, surface_);
    PoissonSolver::Input input;
    input.values = given.Field("values");
    input.gradients = given.Field("gradients");
    input.gradientScale = given.Field("gradient_scale");
    input.weights = given.Field("weights");
    input.flux = given.Field("flux");
    input.constraints = given.Constraints("held");
    PoissonSolver solver;
    PoissonSolver::Result result = solver.Update(surface, input, options_, { 0, progress });
    given.KeepPlaces("values", result.atPoints);
    Results results;
    results.arrays["Solution"] = std::move(result.atPoints);
    results.Warn(result.warnings);
    return results;
  }

private:
  SurfaceOptions surface_;
  PoissonSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakePoisson(Properties& properties)
{
  return std::make_unique<PoissonProblem>(properties);
}

} // namespace gridfem
