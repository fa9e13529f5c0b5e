#include "Problem.h"

#include "Base/VectorRows.h"
#include "Problems/PrincipalCurvatures.h"
#include "Problems/Requirements.h"
#include "Problems/SolveWarnings.h"

#include <optional>

namespace gridfem
{
namespace
{

MultiVector ColumnOf(const std::vector<double>& numbers)
{
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Id>(numbers.size()));
}

class CurvaturesProblem : public Problem
{
public:
  explicit CurvaturesProblem(Properties& properties)
    : options_(properties, { 1e-4, 200, 1e-2 }),
      smoothingScale_(properties.NumberFrom("SmoothingScale", 0.0, 0.0))
  {
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    std::optional<Surface> surface; // smoothing alone needs its functions
    NormalSmoothing smoothing;
    smoothing.multigrid = options_.multigrid;
    smoothing.solve = options_.solve;
    if (smoothingScale_ > 0.0)
    {
      surface.emplace(given, options_, progress.Part(0.0, 0.6));
      smoothing.scale = surface->LengthInWorldUnits(smoothingScale_);
    }
    else
    {
      RequireSurface(*given.mesh);
    }
    SolveReport report;
    const PrincipalCurvatures curvatures = CurvaturesOfSurface(*given.mesh,
      options_.functions.weldCoincidentPoints, surface ? surface->space.get() : nullptr, smoothing,
      report, { options_.functions.threads, progress.Part(0.6, 0.95) });
    Results results;
    results.arrays["MinimumCurvature"] = ColumnOf(curvatures.minimum);
    results.arrays["MaximumCurvature"] = ColumnOf(curvatures.maximum);
    results.arrays["MinimumCurvatureDirection"] = RowsOf(curvatures.minimumDirection);
    results.arrays["MaximumCurvatureDirection"] = RowsOf(curvatures.maximumDirection);
    if (surface && !report.converged)
    {
      results.Warn(WarningOf(report, options_.solve.tolerance));
    }
    return results;
  }

private:
  EngineOptions options_;
  double smoothingScale_;
};

} // namespace

std::unique_ptr<Problem> MakeCurvatures(Properties& properties)
{
  return std::make_unique<CurvaturesProblem>(properties);
}

} // namespace gridfem
