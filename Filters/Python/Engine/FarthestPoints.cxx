#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/FarthestPointsSolver.h"

namespace gridfem
{
namespace
{

class FarthestPointsProblem : public Problem
{
public:
  explicit FarthestPointsProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    const FarthestPointsSolver::Result result =
      FarthestPointsSolver::Solve(given.mesh, options_, surface_, { 0, progress });
    Results results;
    results.arrays["Distance"] = result.atPoints;
    results.arrays["NearestPoint"] = ColumnOf(result.nearest);
    results.arrays["FarthestPoints"] = ColumnOf(result.points);
    results.warnings = result.warnings;
    return results;
  }

private:
  SurfaceOptions surface_ = FarthestPointsSolver::SurfaceDefaults();
  FarthestPointsSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeFarthestPoints(Properties& properties)
{
  return std::make_unique<FarthestPointsProblem>(properties);
}

} // namespace gridfem
