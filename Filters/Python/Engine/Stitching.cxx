#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/LocalSurface.h"
#include "Solvers/StitchSolver.h"

namespace gridfem
{
namespace
{

class StitchingProblem : public Problem
{
public:
  explicit StitchingProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
    surface_.functionsPerPoint = StitchSolver::FunctionsPerPoint(options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    Stages stages;
    LocalSurface surface(stages, given.mesh, surface_);
    StitchSolver solver;
    StitchSolver::Result result = solver.Update(
      surface, { given.Field("colors"), given.Field("labels") }, options_, { 0, progress });
    Results results;
    if (given.arrays.at("colors").isOnPoints)
    {
      given.KeepUnsolved("colors", result.isReached, result.values);
      results.arrays["StitchedColors"] = std::move(result.values);
    }
    else
    {
      results.arrays["StitchedColors"] = given.MeansOnCells(result.values);
    }
    results.Warn(result.warnings);
    return results;
  }

private:
  SurfaceOptions surface_ = StitchSolver::SurfaceDefaults();
  StitchSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeStitching(Properties& properties)
{
  return std::make_unique<StitchingProblem>(properties);
}

} // namespace gridfem
