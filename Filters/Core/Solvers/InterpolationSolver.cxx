#include "Solvers/InterpolationSolver.h"

#include "Equations/LocalCorrection.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"
#include "Solvers/SurfaceFields.h"

#include <algorithm>
#include <iterator>

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

/// Turns held rows into pulled ones if they share a function with some other rows. The pull is near
/// the energy of a peak that the mesh adds to the functions: 2π over the logarithm of its radii.
void PullCrowded(const SparseMatrix& others, HeldRows& rows)
{
  constexpr double PullOfPeak = 1.0;
  std::vector<char> isTouched(rows.columns, 0);
  for (const Index function : others.column)
  {
    isTouched[function] = 1;
  }
  rows.pull.resize(rows.rows, 0.0);
  for (Index row = 0; row < rows.rows; ++row)
  {
    const auto begin = rows.column.data() + rows.rowBegin[row];
    const auto end = rows.column.data() + rows.rowBegin[row + 1];
    if (std::any_of(begin, end, [&](Index function) { return isTouched[function]; }))
    {
      rows.pull[row] = rows.IsPulled(row) ? std::min(rows.pull[row], PullOfPeak) : PullOfPeak;
    }
  }
}

/// The memory for a vector per point.
MemoryNeed NeedOfPoints(const SparseMatrix& rows)
{
  return { sizeof(double) * double(rows.rows) * double(rows.columns),
    "Biharmonic interpolation of " + std::to_string(rows.rows) + " values with " +
      std::to_string(rows.columns) + " basis functions",
    "Choose a smaller Depth." };
}

/// The given points that no function reaches.
std::vector<Id> PointsOutOfReach(const PointValues& given, const std::vector<char>& hasFunctions)
{
  std::vector<Id> points;
  std::copy_if(given.points.begin(), given.points.end(), std::back_inserter(points),
    [&](Id point) { return !hasFunctions[point]; });
  return points;
}

/// Empty if functions reach all points.
std::string WarningOfReach(const std::vector<Id>& outOfReach)
{
  if (outOfReach.empty())
  {
    return {};
  }
  const std::string first = std::to_string(outOfReach.front());
  return outOfReach.size() == 1
           ? "The given value at point " + first +
               " has no effect, because no function of the surface reaches the point."
           : std::to_string(outOfReach.size()) + " given values, the first of them at point " +
               first + ", have no effect, because no function of the surface reaches their points.";
}

/// Measures how far the values at points are from the given ones, where functions reach them.
void MeasureMisfit(const PointValues& given, const std::vector<char>& hasFunctions,
  const MultiVector& atPoints, ConstrainedSolution& solution)
{
  solution.misfit = 0.0;
  for (std::size_t k = 0; k < given.points.size(); ++k)
  {
    if (hasFunctions[given.points[k]])
    {
      const auto off = atPoints.row(given.points[k]) - given.values.row(static_cast<Id>(k));
      solution.misfit =
        LargerOrUnknown(solution.misfit, off.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
    }
  }
  const double range =
    (given.values.colwise().maxCoeff() - given.values.colwise().minCoeff()).maxCoeff();
  solution.relativeMisfit = range > 0.0 ? solution.misfit / range : solution.misfit;
}

} // namespace

/// Takes the values without their large constants.
void InterpolationSolver::TakeValues(const Surface& surface, PointValues given)
{
  const Eigen::RowVectorXd constants = LargeConstants(surface, given.values);
  given.values.rowwise() -= constants;
  const bool isSame = given.points == given_.points &&
                      given.values.cols() == given_.values.cols() &&
                      given.values == given_.values && constants == constants_;
  constants_ = constants;
  version_ += isSame ? 0 : 1;
  given_ = std::move(given);
}

ConstrainedSolution InterpolationSolver::SolveOnce(const Surface& surface, const HeldValues& held,
  const Options& options, const Progress& progress) const
{
  InterpolationOptions own;
  own.smoothness = options.smoothness;
  own.multigrid = options.equation.multigrid;
  own.multigrid.threads = surface.Threads();
  own.solve = options.equation.solve;
  if (own.smoothness == Smoothness::Biharmonic && held.rows.rows <= own.mostAtOnce)
  {
    surface.Require(NeedOfPoints(held.rows));
  }
  return InterpolateHarmonically(*surface.WholeSpace(), held.rows, held.values, own, progress);
}

/// Solves, and leaves the values at the points in the result.
ConstrainedSolution InterpolationSolver::Interpolate(
  const Surface& surface, const Options& options, const Progress& progress)
{
  if (options.smoothness == Smoothness::Harmonic)
  {
    return this->InterpolateBetween(surface, options, progress);
  }
  ConstrainedSolution solution = this->SolveOnce(
    surface, HoldPoints(*surface.WholeSpace(), given_.points, given_.values), options, progress);
  result_.atPoints = surface.ValuesAtPoints(solution.coefficients);
  return solution;
}

/// Interpolates harmonically, between the given values. Functions that are to meet different values
/// closer to each other than their size leave the range of the values. Then these values only pull
/// the functions, and the points around them are corrected on the mesh.
ConstrainedSolution InterpolationSolver::InterpolateBetween(
  const Surface& surface, const Options& options, const Progress& progress)
{
  constexpr double Overshoot = 0.05; // of the range
  const std::shared_ptr<const FiniteElementSpace> space = surface.WholeSpace();
  const LocalCorrection correction(surface.Mesh(), surface.AreCoincidentPointsWelded(),
    given_.points, given_.values, surface.Threads());
  HeldValues held = surface.Hold(given_.points, given_.values);
  ConstrainedSolution solution = this->SolveOnce(surface, held, options, progress.Part(0.0, 0.9));
  result_.atPoints = surface.ValuesAtPoints(solution.coefficients);
  const std::vector<Id> beyond = correction.PointsBeyond(result_.atPoints, Overshoot);
  if (!beyond.empty())
  {
    PullCrowded(space->RowsAtPoints(beyond), held.rows);
    solution = this->SolveOnce(surface, held, options, progress.Part(0.5, 0.9));
    result_.atPoints = surface.ValuesAtPoints(solution.coefficients);
  }
  correction.Apply(
    space->UnitLength(), result_.atPoints, { surface.Threads(), progress.Part(0.9, 1.0) });
  MeasureMisfit(given_, space->PointsWithFunctions(), result_.atPoints, solution);
  return solution;
}

void InterpolationSolver::Take(
  ConstrainedSolution solution, const Surface& surface, const Options& options)
{
  surface.CompleteAtPoints(result_.atPoints);
  result_.atPoints.rowwise() += constants_;
  result_.warnings = WarningsOfValues(solution, options.equation.solve.tolerance);
  result_.warnings.push_back(
    WarningOfReach(PointsOutOfReach(given_, surface.WholeSpace()->PointsWithFunctions())));
  result_.warnings = NotEmpty(std::move(result_.warnings));
  result_.report = std::move(solution.report);
  result_.accuracy = solution.accuracy;
  result_.misfit = solution.misfit;
}

const InterpolationSolver::Result& InterpolationSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireOptions(options);
  surface.Prepare(job.progress.Part(0.0, 0.5));
  this->TakeValues(surface, input.values.find());
  Stages& stages = surface.GetStages();
  StageKey key;
  key.Add(stages.Version(SystemStage)).Add(version_).Add(KeyOfOptions(options));
  stages.Run(SolveStage, key,
    [&]
    {
      this->Take(
        this->Interpolate(surface, options, job.progress.Part(0.5, 0.95)), surface, options);
    });
  job.Check(1.0);
  return result_;
}

InterpolationSolver::Result InterpolationSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(
    &InterpolationSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
