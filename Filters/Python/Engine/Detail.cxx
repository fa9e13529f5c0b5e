#include "Problem.h"

#include "Base/VectorRows.h"
#include "Problems/SolveWarnings.h"
#include "Problems/SurfaceDetail.h"

namespace gridfem
{
namespace
{

class DetailProblem : public Problem
{
public:
  explicit DetailProblem(Properties& properties)
    : options_(properties, { 1e-4, 200, 1e-2 }),
      scale_(properties.FiniteNumber("DetailScale", 2.0)),
      weight_(properties.NumberFrom("ScreeningWeight", 3000.0, 0.0)),
      transfer_(static_cast<CurvatureTransfer>(properties.Integer("TransferFunction", 0, 0, 4))),
      anisotropy_(properties.Number("Anisotropy", 5.0, 1e-3, 1e3)),
      smoothingScale_(properties.NumberFrom("SmoothingScale", 0.005, 0.0)),
      keepsVolume_(properties.Switch("KeepVolume", false))
  {
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    const EngineSurface surface(given, options_, progress.Part(0.0, 0.4));
    const std::shared_ptr<const FiniteElementSpace> space =
      this->Weighed(surface, progress.Part(0.4, 0.5));
    const Job job = surface.MakeJob(progress.Part(0.5, 0.6));
    const SignalInSpace shape = ShapeInSpace(*surface.space, job);
    const MultiVector load = space->StiffnessTimes(shape.coefficients, {}, job);
    const PoissonOptions options{ { options_.multigrid, options_.solve },
      surface.WeightInSpaceUnits(weight_) };
    const Multigrid multigrid = BuildMultigrid(
      *space, options.screeningWeight, 1.0, options.multigrid, progress.Part(0.6, 0.7));
    const PoissonSolution solution = SolvePoisson(*space, multigrid,
      MultiVector::Zero(load.rows(), load.cols()), load, options, progress.Part(0.7, 0.95));

    const MultiVector change =
      space->ValuesAtPoints((scale_ - 1.0) * solution.coefficients, options_.functions.threads);
    std::vector<Vec3> points = surface.Mesh().points;
    for (Id point = 0; point < change.rows(); ++point)
    {
      points[point] += RowOf(change, point);
    }
    if (keepsVolume_)
    {
      ScaleToVolume(surface.Mesh(), points, options_.functions.threads);
    }
    Results results;
    results.arrays["Points"] = RowsOf(points);
    if (!solution.report.converged)
    {
      results.Warn(WarningOf(solution.report, options_.solve.tolerance));
    }
    return results;
  }

private:
  /// The space in the metric that the curvatures give.
  std::shared_ptr<const FiniteElementSpace> Weighed(
    const EngineSurface& surface, const Progress& progress) const
  {
    if (transfer_ == CurvatureTransfer::Isotropic)
    {
      return surface.space;
    }
    const TriangleMesh& mesh = surface.Mesh();
    NormalSmoothing smoothing;
    smoothing.scale = surface.LengthInWorldUnits(smoothingScale_);
    smoothing.multigrid = options_.multigrid;
    smoothing.solve = options_.solve;
    SolveReport report; // of the smoothing: to a tolerance far below its own error
    const TriangleCurvatures curvatures = CurvaturesOnTriangles(mesh,
      CurvaturesOfSurface(mesh, options_.functions.weldCoincidentPoints, surface.space.get(),
        smoothing, report, surface.MakeJob(progress.Part(0.0, 0.5))),
      options_.functions.threads);
    const double usual = UsualCurvature(mesh, curvatures);
    const double unit = usual > 0.0 ? 1.0 / usual : 0.0;
    const MultiVector onElements =
      surface.space->MeansOnElements(curvatures.values, options_.functions.threads);
    std::shared_ptr<FiniteElementSpace> weighed = surface.space->Copy();
    weighed->SplitStiffness(curvatures.direction, surface.MakeJob(progress.Part(0.5, 0.8)));
    weighed->Weigh(WeightsOfMetric(onElements, [&](double curvature)
                     { return LengthOf(transfer_, unit * curvature, anisotropy_); }),
      surface.MakeJob(progress.Part(0.8, 1.0)));
    return weighed;
  }

  EngineOptions options_;
  double scale_;
  double weight_;
  CurvatureTransfer transfer_;
  double anisotropy_;
  double smoothingScale_;
  bool keepsVolume_;
};

} // namespace

std::unique_ptr<Problem> MakeDetail(Properties& properties)
{
  return std::make_unique<DetailProblem>(properties);
}

} // namespace gridfem
