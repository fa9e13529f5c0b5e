#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Base/VectorRows.h"
#include "Solvers/FlowSolver.h"
#include "Solvers/LocalSurface.h"

namespace gridfem
{
namespace
{

class FlowProblem : public Problem
{
public:
  explicit FlowProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    Results results;
    std::vector<Vec3> points;
    results.Warn(
      FlowSolver::Solve(given.mesh, options_, points, surface_, { 0, progress }).warnings);
    results.arrays["Points"] = RowsOf(points);
    return results;
  }

private:
  SurfaceOptions surface_;
  FlowSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeFlow(Properties& properties)
{
  return std::make_unique<FlowProblem>(properties);
}

} // namespace gridfem
