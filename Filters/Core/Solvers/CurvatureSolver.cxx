#include "Solvers/CurvatureSolver.h"

#include "Base/UnsolvedRows.h"
#include "Base/VectorRows.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <limits>

namespace gridfem
{
namespace
{

/// Whether each point has a direction. Points without a triangle that has an area have none.
std::vector<char> HaveDirections(const std::vector<Vec3>& directions)
{
  std::vector<char> have(directions.size());
  std::transform(directions.begin(), directions.end(), have.begin(),
    [](const Vec3& direction) { return direction.squaredNorm() > 0.0; });
  return have;
}

/// The columns that CurvatureSolver::Numbers names.
/// @param isFitted  the other points do not count in the bending
MultiVector NumbersOf(
  const PrincipalCurvatures& curvatures, const std::vector<char>& isFitted, double area)
{
  MultiVector numbers(
    static_cast<Id>(curvatures.minimum.size()), static_cast<Id>(CurvatureSolver::Numbers.size()));
  std::vector<double> mean(curvatures.minimum.size());
  for (Id point = 0; point < numbers.rows(); ++point)
  {
    const double least = curvatures.minimum[point];
    const double most = curvatures.maximum[point];
    const double half = 0.5 * (least + most);
    mean[point] = isFitted[point] ? half : std::numeric_limits<double>::quiet_NaN();
    numbers.row(point) << least, most, half, least * most, ShapeIndex(least, most), 0.0;
  }
  const std::vector<double> bending = BendingOf(mean, area);
  numbers.rightCols(1) = Eigen::Map<const Eigen::VectorXd>(bending.data(), numbers.rows());
  return numbers;
}

} // namespace

PrincipalCurvatures CurvaturesOf(const Surface& surface, double smoothingScale,
  const EquationOptions& equation, CurvatureReport& report, const Job& job)
{
  NormalSmoothing smoothing;
  smoothing.multigrid = equation.multigrid;
  smoothing.multigrid.threads = job.threads;
  smoothing.solve = equation.solve;
  std::shared_ptr<const FiniteElementSpace> space;
  if (smoothingScale > 0.0)
  {
    space = surface.WholeSpace();
    smoothing.scale = surface.LengthInWorldUnits(smoothingScale);
  }
  return CurvaturesOfSurface(surface.Mesh(), surface.UsedOptions().space.weldCoincidentPoints,
    space.get(), smoothing, report, job);
}

const CurvatureSolver::Result& CurvatureSolver::Update(
  Surface& surface, const Options& options, const Job& job)
{
  RequireOptions(options);
  const bool isSmoothed = options.smoothingScale > 0.0;
  StageKey key;
  if (isSmoothed)
  {
    surface.Prepare(job.progress.Part(0.0, 0.6));
    key.Add(surface.GetStages().Version(SystemStage)).Add(KeyOfOptions(options));
    key.Add(surface.LengthInWorldUnits(options.smoothingScale));
  }
  else
  {
    surface.PrepareMesh(job.progress.Part(0.0, 0.6));
    key.Add(surface.GetStages().Version(MeshStage));
  }
  key.Add(isSmoothed).Add(surface.UsedOptions().space.weldCoincidentPoints);
  surface.GetStages().Run(SolveStage, key,
    [&] {
      this->Fit(surface, options, { surface.Threads(), job.progress.Part(0.6, 1.0) });
    });
  return result_;
}

void CurvatureSolver::Fit(const Surface& surface, const Options& options, const Job& job)
{
  result_ = {};
  result_.isSmoothed = options.smoothingScale > 0.0;
  CurvatureReport facts;
  const PrincipalCurvatures curvatures =
    CurvaturesOf(surface, options.smoothingScale, options.equation, facts, job);
  result_.report = std::move(facts.smoothing);
  result_.turned = facts.turned;
  const std::vector<char> isFitted = HaveDirections(curvatures.minimumDirection);
  result_.numbers = NumbersOf(curvatures, isFitted, SurfaceArea(surface.Mesh()));
  result_.minimumDirection = RowsOf(curvatures.minimumDirection);
  result_.maximumDirection = RowsOf(curvatures.maximumDirection);
  for (MultiVector* values :
    { &result_.numbers, &result_.minimumDirection, &result_.maximumDirection })
  {
    ClearRows(isFitted, *values);
  }
  if (facts.oneSided > 0)
  {
    result_.warnings.push_back("The surface has " + std::to_string(facts.oneSided) +
                               " one-sided components, such as a Möbius strip. There the signs of "
                               "curvatures change somewhere, because no side is outside.");
  }
  if (result_.isSmoothed && !result_.report.converged)
  {
    result_.warnings.push_back(WarningOf(result_.report, options.equation.solve.tolerance));
  }
}

CurvatureSolver::Result CurvatureSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(&CurvatureSolver::result_, std::move(mesh), surfaceOptions, job, options);
}

} // namespace gridfem
