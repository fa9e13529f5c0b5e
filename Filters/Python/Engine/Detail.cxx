#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Base/VectorRows.h"
#include "Solvers/DetailSolver.h"
#include "Solvers/LocalSurface.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

class DetailProblem : public Problem
{
public:
  explicit DetailProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    Stages stages;
    LocalSurface surface(stages, given.mesh, surface_);
    DetailSolver::Input input;
    input.values = given.Field("values");
    input.scale = given.Field("scales");
    input.custom = [](double curvature) { return std::min(std::abs(curvature), 1.0); };
    DetailSolver solver;
    const DetailSolver::Result& result = solver.Update(surface, input, options_, { 0, progress });
    Results results;
    results.arrays["Points"] = RowsOf(result.points);
    if (input.values)
    {
      results.arrays["Filtered"] = given.arrays.at("values").values + result.change;
    }
    results.Warn(result.warnings);
    return results;
  }

private:
  SurfaceOptions surface_ = DetailSolver::SurfaceDefaults();
  DetailSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeDetail(Properties& properties)
{
  return std::make_unique<DetailProblem>(properties);
}

} // namespace gridfem
