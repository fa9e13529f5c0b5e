#include "Solvers/InterpolationSolver.h"

#include "Problems/SolveWarnings.h"
#include "Solvers/LocalSurface.h"

#include <algorithm>

namespace gridfem
{
namespace
{

std::vector<std::string> WarningsOfValues(const ConstrainedSolution& solution, double tolerance)
{
  std::vector<std::string> warnings;
  if (!solution.report.converged)
  {
    warnings.push_back(
      WarningOf(solution.report, solution.wanted > 0.0 ? solution.wanted : tolerance));
  }
  const std::string unmet = WarningOfConstraints(solution);
  if (!unmet.empty())
  {
    warnings.push_back(unmet);
  }
  const auto free = std::count(solution.isHeld.begin(), solution.isHeld.end(), 0);
  if (free > 0)
  {
    warnings.push_back(
      std::to_string(free) + " of " + std::to_string(solution.isHeld.size()) +
      " connected components of the surface have no given value. They become NaN.");
  }
  return warnings;
}

} // namespace

SurfaceOptions InterpolationSolver::SurfaceDefaults()
{
  SurfaceOptions options;
  options.choice.normalStabilization = 1e-2;
  return options;
}

void InterpolationSolver::TakeValues(PointValues given)
{
  const bool isSame = given.points == given_.points &&
                      given.values.cols() == given_.values.cols() && given.values == given_.values;
  version_ += isSame ? 0 : 1;
  given_ = std::move(given);
}

void InterpolationSolver::Take(
  ConstrainedSolution solution, const Surface& surface, const Options& options)
{
  result_.atPoints = surface.ValuesAtPoints(solution.coefficients);
  result_.isReached = surface.PointsWithFunctions();
  for (Id point = 0; point < result_.atPoints.rows(); ++point)
  {
    if (!result_.isReached[point])
    {
      result_.atPoints.row(point).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  result_.warnings = WarningsOfValues(solution, options.equation.solve.tolerance);
  result_.report = std::move(solution.report);
  result_.accuracy = solution.accuracy;
  result_.misfit = solution.misfit;
}

const InterpolationSolver::Result& InterpolationSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireOptions(options);
  surface.Prepare(job.progress.Part(0.0, 0.5));
  this->TakeValues(input.values.find());
  Stages& stages = surface.GetStages();
  StageKey key;
  key.Add(stages.Version(SystemStage)).Add(version_).Add(KeyOfOptions(options));
  stages.Run(SolveStage, key,
    [&]
    {
      const std::shared_ptr<const FiniteElementSpace> space = surface.WholeSpace();
      InterpolationOptions own;
      own.smoothness = options.smoothness;
      own.multigrid = options.equation.multigrid;
      own.multigrid.threads = surface.Threads();
      own.solve = options.equation.solve;
      this->Take(InterpolateHarmonically(*space, space->RowsAtPoints(given_.points), given_.values,
                   own, job.progress.Part(0.5, 0.95)),
        surface, options);
    });
  job.Check(1.0);
  return result_;
}

InterpolationSolver::Result InterpolationSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  InterpolationSolver solver;
  solver.Update(surface, input, options, job);
  return std::move(solver.result_);
}

} // namespace gridfem
