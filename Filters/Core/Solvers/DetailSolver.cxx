#include "Solvers/DetailSolver.h"

#include "Base/Errors.h"
#include "Base/UnsolvedRows.h"
#include "Distance/MarchedDistance.h"
#include "Shape/MovedSurface.h"
#include "Solvers/CurvatureSolver.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <cmath>
#include <utility>

namespace gridfem
{
namespace
{

constexpr const char* MetricStage = "Metric";   // curvatures, stiffness split by direction
constexpr const char* WeightsStage = "Weights"; // of the elements
constexpr const char* SignalStage = "Signal";   // the input as a function of the space

/// Returns the means over the triangles around the points.
MultiVector AtPoints(const Field& field, const TriangleMesh& mesh, int threads)
{
  if (field.association == FieldAssociation::Points)
  {
    return field.values;
  }
  const std::vector<double> onTriangles(
    field.values.data(), field.values.data() + field.values.size());
  const std::vector<double> means = MeansAtPoints(mesh, onTriangles, 1.0, threads);
  return Eigen::Map<const Eigen::VectorXd>(means.data(), static_cast<Eigen::Index>(means.size()));
}

/// Returns the means over the corners. A field of triangles stays as it is.
MultiVector OnTriangles(const Field& field, const TriangleMesh& mesh)
{
  MultiVector means(static_cast<Id>(mesh.triangles.size()), 1);
  for (Id t = 0; t < means.rows(); ++t)
  {
    const auto rows = field.RowsOf(t, mesh.triangles[t]);
    means(t, 0) =
      (field.values(rows[0], 0) + field.values(rows[1], 0) + field.values(rows[2], 0)) / 3.0;
  }
  return means;
}

std::vector<double> OnElements(
  const FiniteElementSpace& space, const MultiVector& onTriangles, const Job& job)
{
  const MultiVector means = space.MeansOnElements(onTriangles, job);
  return { means.data(), means.data() + means.size() };
}

/// Returns 1 at selected points, falling to 0 within the width.
Field FadeOut(const Surface& surface, const std::vector<char>& selected, double width)
{
  HatOptions options;
  options.weldCoincidentPoints = surface.UsedOptions().space.weldCoincidentPoints;
  options.threads = surface.Threads();
  const TriangleMesh& mesh = surface.Mesh();
  const std::vector<double> distance =
    MarchDistance(mesh, NumberHatFunctions(mesh, options), selected, width);
  Field fade;
  fade.values.resize(static_cast<Id>(distance.size()), 1);
  for (Id point = 0; point < fade.values.rows(); ++point)
  {
    const double way = distance[point];
    fade.values(point, 0) = way == 0.0 ? 1.0 : way < width ? SmoothStep(1.0 - way / width) : 0.0;
  }
  return fade;
}

void RequireInput(const DetailSolver::Input& input, const DetailSolver::Options& options)
{
  RequireOptions(options);
  if (options.transferFunction == CurvatureTransfer::Custom && !input.custom)
  {
    throw InvalidInput("The Custom Transfer Function has no points.");
  }
  if (!input.values.IsOnPoints())
  {
    throw InvalidInput("The Value Array has to be point data, but '" + input.values.name +
                       "' is a cell array. Convert it with Cell Data to Point Data.");
  }
  if (input.scale && input.scale.components != 1)
  {
    throw InvalidInput("Detail Scale Array '" + input.scale.name + "' must have one component.");
  }
}

EquationOptions WithThreads(EquationOptions equation, int threads)
{
  equation.multigrid.threads = threads;
  return equation;
}

} // namespace

const DetailSolver::Result& DetailSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireInput(input, options);
  surface.Prepare(job.progress.Part(0.0, 0.4));
  job.Check(0.4);
  space_ = surface.WholeSpace();
  result_.isWeighted = options.transferFunction != CurvatureTransfer::Isotropic;
  if (result_.isWeighted)
  {
    this->UpdateMetric(surface, options, job.Part(0.4, 0.48));
    this->UpdateWeights(surface, input, options, job.Part(0.48, 0.5));
  }
  this->UpdateSignal(surface, input, options, job.Part(0.5, 0.55));
  this->SolveBlocks(surface, input, options, job.Part(0.55, 1.0));
  this->Report(surface, input, options);
  return result_;
}

const FiniteElementSpace& DetailSolver::MetricSpace() const
{
  return result_.isWeighted ? *weighted_ : *space_;
}

void DetailSolver::UpdateMetric(const Surface& surface, const Options& options, const Job& job)
{
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(options.smoothingScale);
  key.Add(
    options.smoothingScale > 0.0 ? surface.UsedOptions().parameterUnits : ParameterUnits::World);
  key.Add(options.smoothingScale > 0.0 ? KeyOf(options.equation) : StageKey());
  surface.GetStages().Run(MetricStage, key,
    [&]
    {
      const TriangleMesh& mesh = surface.Mesh();
      CurvatureReport report;
      curvatures_ = CurvaturesOnTriangles(mesh,
        CurvaturesOf(surface, options.smoothingScale,
          WithThreads(options.equation, surface.Threads()), report,
          surface.MakeJob(job.progress.Part(0.0, 0.6))),
        surface.Threads());
      smoothing_ = options.smoothingScale > 0.0 ? report.smoothing : SolveReport::Solved();
      result_.usualCurvature = UsualCurvature(mesh, curvatures_);
      onElements_ = space_->MeansOnElements(curvatures_.values, surface.Threads());
      weighted_ = space_->Copy();
      weighted_->SplitStiffness(
        curvatures_.direction, surface.MakeJob(job.progress.Part(0.6, 1.0)));
    });
}

void DetailSolver::UpdateWeights(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  const bool isCustom = options.transferFunction == CurvatureTransfer::Custom;
  StageKey key;
  key.Add(surface.GetStages().Version(MetricStage)).Add(options.transferFunction);
  key.Add(options.anisotropy).Add(isCustom ? input.curve : StageKey());
  surface.GetStages().Run(WeightsStage, key,
    [&]
    {
      const double usual = result_.usualCurvature;
      const double unit = usual > 0.0 ? 1.0 / usual : 0.0;
      const TransferFunction length = [&](double curvature)
      {
        return isCustom ? 1.0 + (options.anisotropy - 1.0) * input.custom(unit * curvature)
                        : LengthOf(options.transferFunction, unit * curvature, options.anisotropy);
      };
      weighted_->Weigh(WeightsOfMetric(onElements_, length), surface.MakeJob(job.progress));
    });
}

void DetailSolver::UpdateSignal(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(KeyOf(input.values));
  key.Add(input.values ? KeyOf(options.equation) : StageKey());
  surface.GetStages().Run(SignalStage, key,
    [&]
    {
      const Job own = surface.MakeJob(job.progress);
      const EquationOptions equation = WithThreads(options.equation, surface.Threads());
      signal_ = input.values ? ProjectSignal(*space_, ReadField(surface, input.values),
                                 equation.multigrid, equation.solve, own)
                             : ShapeInSpace(*space_, own);
    });
}

PoissonLoad DetailSolver::Integrate(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  const FiniteElementSpace& space = this->MetricSpace();
  const TriangleMesh& mesh = surface.Mesh();
  scale_.reset();
  fade_.reset();
  PoissonLoad load;
  const Id columns = signal_.coefficients.cols();
  const double blocks = 1.0 + (input.scale ? 1.0 : 0.0) + (input.hasSelection ? 1.0 : 0.0);
  double done = 0.0;
  const auto append = [&](const MultiVector* scale)
  {
    const Job part = job.Part(done / blocks, (done + 1.0) / blocks);
    const std::vector<double> onElements =
      scale ? OnElements(space, *scale, part.Part(0.0, 0.5)) : std::vector<double>();
    load.gradients.conservativeResize(space.Integrals().size(), load.gradients.cols() + columns);
    load.gradients.rightCols(columns) =
      space.StiffnessTimes(signal_.coefficients, onElements, part.Part(scale ? 0.5 : 0.0, 1.0));
    done += 1.0;
  };
  append(nullptr);
  MultiVector scale;
  if (input.scale)
  {
    scale_ = ReadField(surface, input.scale);
    scale = OnTriangles(*scale_, mesh);
    append(&scale);
  }
  if (input.hasSelection)
  {
    fade_ = FadeOut(surface, input.selected, surface.LengthInWorldUnits(options.transitionWidth));
    MultiVector fade = OnTriangles(*fade_, mesh);
    if (scale_)
    {
      fade.array() *= scale.array();
    }
    append(&fade);
  }
  load.values.setZero(load.gradients.rows(), load.gradients.cols());
  return load;
}

void DetailSolver::SolveBlocks(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  Stages& stages = surface.GetStages();
  StageKey fields;
  fields.Add(stages.Version(SignalStage)).Add(KeyOf(input.scale));
  fields.Add(input.hasSelection).Add(input.selection);
  if (input.hasSelection)
  {
    fields.Add(options.transitionWidth).Add(surface.UsedOptions().parameterUnits);
  }
  PoissonRequest request;
  request.weight = options.screeningWeight;
  request.space = &this->MetricSpace();
  request.numbers.Add(result_.isWeighted ? stages.Version(WeightsStage) : std::int64_t{ -1 });
  request.startsFromLast = true;
  equation_.Update(
    surface, fields,
    [&](const SurfaceSpace&, const Job& part)
    { return this->Integrate(surface, input, options, part); },
    request, options.equation, job.progress);
}

/// Returns the change at the points. It is linear in the scales inside and outside of the
/// selection. The solution reaches beyond the selection by about 1 / sqrt(ScreeningWeight), so its
/// part fades out around the selection. Points outside keep the change of the outer scale.
MultiVector DetailSolver::ChangeAtPoints(const Options& options, int threads) const
{
  const MultiVector& solved = equation_.Solution().coefficients;
  const Id columns = signal_.coefficients.cols();
  const double everywhere = fade_ ? options.outsideScale : options.detailScale;
  const MultiVector outside =
    everywhere * solved.middleCols(scale_ ? columns : 0, columns) - solved.leftCols(columns);
  MultiVector change = this->MetricSpace().ValuesAtPoints(outside, threads);
  if (fade_)
  {
    const MultiVector inside = this->MetricSpace().ValuesAtPoints(
      (options.detailScale - options.outsideScale) * solved.rightCols(columns), threads);
    change += fade_->values.col(0).asDiagonal() * inside;
  }
  return change;
}

MultiVector DetailSolver::ScaleAtPoints(
  const TriangleMesh& mesh, const Options& options, int threads) const
{
  const auto points = static_cast<Id>(mesh.points.size());
  MultiVector scale =
    MultiVector::Constant(points, 1, fade_ ? options.outsideScale : options.detailScale);
  if (fade_)
  {
    scale += (options.detailScale - options.outsideScale) * fade_->values;
  }
  return scale_ ? MultiVector(scale.cwiseProduct(AtPoints(*scale_, mesh, threads))) : scale;
}

/// The errors are relative to the change. The largest error at a point is at most the sum of the
/// blocks' errors.
SolutionAccuracy DetailSolver::AccuracyOfChange(const Options& options) const
{
  const double inside = options.detailScale;
  const double outside = options.outsideScale;
  SolutionAccuracy accuracy = equation_.Accuracy();
  accuracy.largest *= !fade_ && !scale_ ? std::abs(inside - 1.0)
                                        : 1.0 + std::abs(fade_ ? outside : inside) +
                                            (fade_ ? std::abs(inside - outside) : 0.0);
  return accuracy;
}

void DetailSolver::Report(const Surface& surface, const Input& input, const Options& options)
{
  const TriangleMesh& mesh = surface.Mesh();
  const int threads = surface.Threads();
  result_.change = this->ChangeAtPoints(options, threads);
  result_.points.clear();
  if (input.values)
  {
    // Details that no function has are scaled as well.
    const MultiVector scale = this->ScaleAtPoints(mesh, options, threads);
    const std::vector<char> isReached = space_->PointsWithFunctions();
    for (Id point = 0; point < result_.change.rows(); ++point)
    {
      if (isReached[point])
      {
        result_.change.row(point) += (scale(point, 0) - 1.0) * signal_.remainder.row(point);
      }
    }
    ClearRows(isReached, result_.change);
  }
  else
  {
    result_.points = mesh.points;
    for (Id point = 0; point < result_.change.rows(); ++point)
    {
      result_.points[point] += Eigen::Map<const Vec3>(&result_.change(point, 0));
    }
    if (options.keepVolume)
    {
      ScaleToVolume(mesh, space_->PointsWithFunctions(), result_.points, threads);
    }
  }
  result_.selected = fade_ ? fade_->values : MultiVector();
  result_.report = equation_.Report();
  if (result_.isWeighted && !smoothing_.converged)
  {
    result_.report = smoothing_;
  }
  if (input.values && !signal_.report.converged)
  {
    result_.report = signal_.report;
  }
  result_.accuracy = this->AccuracyOfChange(options);
  result_.warnings.clear();
  if (!result_.report.converged)
  {
    result_.warnings.push_back(WarningOf(result_.report, options.equation.solve.tolerance));
  }
}

DetailSolver::Result DetailSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(&DetailSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
