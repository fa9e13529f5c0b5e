#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/DiffusionSolver.h"
#include "Solvers/LocalSurface.h"

namespace gridfem
{
namespace
{

class DiffusionProblem : public Problem
{
public:
  explicit DiffusionProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    Stages stages;
    LocalSurface surface(stages, given.mesh, surface_);
    DiffusionSolver solver;
    const DiffusionSolver::Result& result = solver.Update(surface,
      { given.Field("values"), given.Field("source"), given.Constraints("held") }, options_,
      { 0, progress });
    Results results;
    MultiVector diffused = result.steps.back().atPoints;
    given.KeepPlaces("values", diffused);
    results.arrays["Diffused"] = std::move(diffused);
    results.Warn(solver.Warnings(options_.numberOfSteps));
    return results;
  }

private:
  SurfaceOptions surface_ = DiffusionSolver::SurfaceDefaults();
  DiffusionSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeDiffusion(Properties& properties)
{
  return std::make_unique<DiffusionProblem>(properties);
}

} // namespace gridfem
