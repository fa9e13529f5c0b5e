#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/DistanceSolver.h"

namespace gridfem
{
namespace
{

class DistanceProblem : public Problem
{
public:
  explicit DistanceProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    DistanceSolver::Input input;
    input.ids = given.sources;
    input.labels = given.Field("labels");
    const DistanceSolver::Result result =
      DistanceSolver::Solve(given.mesh, input, options_, surface_, { 0, progress });
    Results results;
    results.arrays["Distance"] = result.atPoints;
    if (options_.nearestSource)
    {
      results.arrays["NearestSource"] = ColumnOf(result.nearest);
    }
    results.warnings = result.warnings;
    return results;
  }

private:
  SurfaceOptions surface_ = DistanceSolver::SurfaceDefaults();
  DistanceSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeDistance(Properties& properties)
{
  return std::make_unique<DistanceProblem>(properties);
}

} // namespace gridfem
