#include "Problem.h"

#include "Base/Errors.h"
#include "Problems/HarmonicInterpolation.h"
#include "Problems/SolveWarnings.h"

#include <algorithm>
#include <limits>

namespace gridfem
{
namespace
{

class InterpolationProblem : public Problem
{
public:
  explicit InterpolationProblem(Properties& properties)
    : options_(properties, { 1e-6, 200, 1e-2 }),
      smoothness_(static_cast<Smoothness>(properties.Integer("Smoothness", 0, 0, 1)))
  {
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    const EngineSurface surface(given, options_, progress.Part(0.0, 0.5));
    const FiniteElementSpace& space = surface.Space();
    const KnownRows known = given.KnownValues(nullptr);
    InterpolationOptions options;
    options.smoothness = smoothness_;
    options.multigrid = options_.multigrid;
    options.solve = options_.solve;
    const ConstrainedSolution solution = InterpolateHarmonically(
      space, space.RowsAtPoints(known.points), known.values, options, progress.Part(0.5, 0.95));
    const MultiVector unknown = MultiVector::Constant(static_cast<Id>(given.mesh->points.size()),
      known.values.cols(), std::numeric_limits<double>::quiet_NaN());
    Results results;
    results.arrays["Interpolated"] = surface.AtPoints(solution.coefficients, unknown);
    if (!solution.report.converged)
    {
      results.Warn(WarningOf(
        solution.report, solution.wanted > 0.0 ? solution.wanted : options_.solve.tolerance));
    }
    results.Warn(WarningOfConstraints(solution));
    const auto free = std::count(solution.isHeld.begin(), solution.isHeld.end(), 0);
    if (free > 0)
    {
      results.Warn(std::to_string(free) + " of " + std::to_string(solution.isHeld.size()) +
                   " connected components of the surface have no value: they are NaN.");
    }
    return results;
  }

private:
  EngineOptions options_;
  Smoothness smoothness_;
};

} // namespace

std::unique_ptr<Problem> MakeInterpolation(Properties& properties)
{
  return std::make_unique<InterpolationProblem>(properties);
}

} // namespace gridfem
