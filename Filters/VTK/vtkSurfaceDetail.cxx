#include "vtkSurfaceDetail.h"

#include "Private/ClippedMeshWriter.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/MovedMeshWriter.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceCurvatures.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Problems/MovedSurface.h"
#include "Problems/SurfaceDetail.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <optional>

vtkStandardNewMacro(vtkSurfaceDetail);

namespace
{

constexpr const char* MetricStage = "Metric";   // curvatures, stiffness split by direction
constexpr const char* WeightsStage = "Weights"; // of the elements
constexpr const char* SignalStage = "Signal";   // the input as a function of the space

/// From 0 to 1 as x does, without a kink at its ends.
double SmoothStep(double x)
{
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Means over the triangles around the points.
gridfem::MultiVector AtPoints(
  const gridfem::Field& field, const gridfem::TriangleMesh& mesh, int threads)
{
  if (field.association == gridfem::FieldAssociation::Points)
  {
    return field.values;
  }
  const std::vector<double> onTriangles(
    field.values.data(), field.values.data() + field.values.size());
  const std::vector<double> means = gridfem::MeansAtPoints(mesh, onTriangles, 1.0, threads);
  return Eigen::Map<const Eigen::VectorXd>(means.data(), static_cast<Eigen::Index>(means.size()));
}

std::vector<double> OnElements(const gridfem::FiniteElementSpace& space,
  const gridfem::Field& field, const gridfem::TriangleMesh& mesh, const gridfem::Job& job)
{
  gridfem::MultiVector onTriangles(static_cast<gridfem::Id>(mesh.triangles.size()), 1);
  for (gridfem::Id t = 0; t < onTriangles.rows(); ++t)
  {
    const auto rows = field.RowsOf(t, mesh.triangles[t]);
    onTriangles(t, 0) =
      (field.values(rows[0], 0) + field.values(rows[1], 0) + field.values(rows[2], 0)) / 3.0;
  }
  const gridfem::MultiVector means = space.MeansOnElements(onTriangles, job);
  return { means.data(), means.data() + means.size() };
}

} // namespace

struct vtkSurfaceDetail::Internals
{
  gridfem::InputArray Value;
  gridfem::InputArray Scale;

  gridfem::TriangleCurvatures Curvatures;
  double UsualCurvature = 0.0;
  gridfem::MultiVector OnElements; // curvatures
  std::unique_ptr<gridfem::FiniteElementSpace> Weighed;
  bool IsWeighed = false;

  gridfem::SignalInSpace Signal;
  std::optional<gridfem::Field> ScaleField;
  gridfem::MultiVector Load; // for scale 1, and beside it for the scale array
  std::unique_ptr<gridfem::Multigrid> Hierarchy;
  gridfem::StageKey HierarchyShape;  // what it depends on but for its numbers
  gridfem::PoissonSolution Solution; // for the columns of Load

  const gridfem::FiniteElementSpace& Space(const gridfem::SurfaceSolverState& state) const
  {
    return this->IsWeighed ? *this->Weighed : *state.space;
  }

  /// What numbers the matrices have.
  gridfem::StageKey SpaceKey(const gridfem::SurfaceSolverState& state) const
  {
    gridfem::StageKey key;
    key.Add(state.stages.Version(gridfem::SystemStage)).Add(this->IsWeighed);
    key.Add(this->IsWeighed ? state.stages.Version(WeightsStage) : 0);
    return key;
  }

  /// The change for a DetailScale, as coefficients: linear in it.
  gridfem::MultiVector Change(double scale) const
  {
    const gridfem::MultiVector& solved = this->Solution.coefficients;
    const gridfem::Id columns = this->Signal.coefficients.cols();
    return scale * solved.rightCols(columns) - solved.leftCols(columns);
  }
};

vtkSurfaceDetail::vtkSurfaceDetail() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->Tolerance = 1e-4;
  this->NormalStabilization = 1e-2;
  this->MaximumIterations = 200;
}

vtkSurfaceDetail::~vtkSurfaceDetail() = default;

void vtkSurfaceDetail::AddTransferPoint(double curvature, double length)
{
  this->TransferPoints.emplace_back(curvature, length);
  this->Modified();
}

void vtkSurfaceDetail::ClearTransferPoints()
{
  this->TransferPoints.clear();
  this->Modified();
}

int vtkSurfaceDetail::GetNumberOfTransferPoints()
{
  return static_cast<int>(this->TransferPoints.size());
}

double vtkSurfaceDetail::LengthOf(double curvature) const
{
  switch (this->TransferFunction)
  {
    case LargeNegative:
      return 1.0 + (this->Anisotropy - 1.0) * SmoothStep(-curvature);
    case LargePositive:
      return 1.0 + (this->Anisotropy - 1.0) * SmoothStep(curvature);
    case LargeAbsolute:
      return 1.0 + (this->Anisotropy - 1.0) * SmoothStep(std::abs(curvature));
    case Custom:
      break;
    default:
      return 1.0;
  }
  if (this->TransferPoints.empty())
  {
    return 1.0;
  }
  std::vector<std::pair<double, double>> points = this->TransferPoints;
  std::stable_sort(points.begin(), points.end());
  const auto next = std::upper_bound(points.begin(), points.end(), curvature,
    [](double x, const std::pair<double, double>& point) { return x < point.first; });
  if (next == points.begin() || next == points.end())
  {
    return next == points.begin() ? next->second : points.back().second;
  }
  const auto& [low, first] = *std::prev(next);
  const auto& [high, last] = *next;
  return first + (last - first) * (curvature - low) / (high - low);
}

void vtkSurfaceDetail::CheckProperties() const
{
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::RequireAtLeast("ScreeningWeight", this->ScreeningWeight, 0.0);
  gridfem::RequireAtLeast("SmoothingScale", this->SmoothingScale, 0.0);
  gridfem::RequireNumber("Anisotropy", this->Anisotropy);
  if (!std::isfinite(this->DetailScale))
  {
    throw gridfem::InvalidInput("DetailScale must be a finite number.");
  }
  for (const auto& [curvature, length] : this->TransferPoints)
  {
    if (!std::isfinite(curvature) || !(length > 0.0) || !std::isfinite(length))
    {
      throw gridfem::InvalidInput("TransferPoints must be finite, and their second numbers, what a "
                                  "length counts, above 0.");
    }
  }
}

void vtkSurfaceDetail::FindArrays(vtkPolyData* input)
{
  Internals& data = *this->Data;
  data.Value = gridfem::FindInputArray(this, 0, input, "ValueArray");
  data.Scale = gridfem::FindInputArray(this, 1, input, "DetailScaleArray");
  if (data.Value.array && data.Value.association != gridfem::FieldAssociation::Points)
  {
    throw gridfem::InvalidInput("ValueArray needs values at points, but '" + data.Value.name +
                                "' is a cell array. Cell Data to Point Data converts it.");
  }
  if (data.Scale.array && data.Scale.array->GetNumberOfComponents() != 1)
  {
    throw gridfem::InvalidInput(
      "DetailScaleArray '" + data.Scale.name + "' must have one component.");
  }
}

void vtkSurfaceDetail::UpdateMetric(const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  data.IsWeighed = this->TransferFunction != Isotropic;
  if (!data.IsWeighed)
  {
    return;
  }
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(this->SmoothingScale);
  key.Add(this->SmoothingScale > 0.0 ? this->ParameterUnits : 0);
  state.stages.Run(MetricStage, key,
    [&]
    {
      const gridfem::TriangleMesh& mesh = *state.mesh.triangles;
      gridfem::SolveReport report; // of the smoothing: to a tolerance far below its own error
      data.Curvatures = gridfem::CurvaturesOnTriangles(mesh,
        gridfem::CurvaturesOfSurface(
          state, mesh, this->SmoothingScale, report, progress.Part(0.0, 0.5)),
        this->NumberOfThreads);
      data.UsualCurvature = gridfem::UsualCurvature(mesh, data.Curvatures);
      data.OnElements = state.space->MeansOnElements(data.Curvatures.values, this->NumberOfThreads);
      data.Weighed = state.space->Copy();
      data.Weighed->SplitStiffness(
        data.Curvatures.direction, state.MakeJob(progress.Part(0.5, 0.8)));
    });
  gridfem::StageKey weights;
  weights.Add(state.stages.Version(MetricStage)).Add(this->TransferFunction);
  weights.Add(this->Anisotropy);
  for (const auto& [curvature, length] : this->TransferPoints)
  {
    weights.Add(curvature).Add(length);
  }
  state.stages.Run(WeightsStage, weights,
    [&]
    {
      const double unit = data.UsualCurvature > 0.0 ? 1.0 / data.UsualCurvature : 0.0;
      data.Weighed->Weigh(gridfem::WeightsOfMetric(data.OnElements,
                            [&](double curvature) { return this->LengthOf(unit * curvature); }),
        state.MakeJob(progress.Part(0.8, 1.0)));
    });
}

void vtkSurfaceDetail::UpdateLoad(const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey signal;
  signal.Add(state.stages.Version(gridfem::SystemStage)).Add(data.Value.array);
  state.stages.Run(SignalStage, signal,
    [&]
    {
      const gridfem::Job job = state.MakeJob(progress.Part(0.0, 0.6));
      data.Signal = data.Value.array ? gridfem::ProjectSignal(*state.space,
                                         gridfem::ReadField(data.Value, state.mesh),
                                         state.options.multigrid, state.options.solve, job)
                                     : gridfem::ShapeInSpace(*state.space, job);
    });
  gridfem::StageKey load = data.SpaceKey(state);
  load.Add(state.stages.Version(SignalStage)).Add(data.Scale.array);
  load.Add(static_cast<int>(data.Scale.association));
  state.stages.Run(gridfem::RightHandSideStage, load,
    [&]
    {
      const gridfem::FiniteElementSpace& space = data.Space(state);
      const gridfem::Job job = state.MakeJob(progress.Part(0.6, 1.0));
      data.ScaleField.reset();
      data.Load = gridfem::LoadOfDetail(space, data.Signal.coefficients, {}, job);
      if (data.Scale.array)
      {
        data.ScaleField = gridfem::ReadField(data.Scale, state.mesh);
        const gridfem::MultiVector scaled = gridfem::LoadOfDetail(space, data.Signal.coefficients,
          OnElements(space, *data.ScaleField, *state.mesh.triangles, job), job);
        const gridfem::Id columns = data.Load.cols();
        data.Load.conservativeResize(Eigen::NoChange, 2 * columns);
        data.Load.rightCols(columns) = scaled;
      }
    });
}

void vtkSurfaceDetail::UpdateSolution(const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::FiniteElementSpace& space = data.Space(state);
  gridfem::PoissonOptions options;
  options.screeningWeight = state.WeightInGridUnits(this->ScreeningWeight);
  options.multigrid = state.options.multigrid;
  options.solve = state.options.solve;
  gridfem::StageKey shape;
  shape.Add(state.stages.Version(gridfem::SystemStage));
  gridfem::AddMultigrid(shape, options.multigrid);
  gridfem::StageKey hierarchy = data.SpaceKey(state);
  gridfem::AddMultigrid(hierarchy, options.multigrid);
  hierarchy.Add(options.screeningWeight);
  state.stages.Run(gridfem::HierarchyStage, hierarchy,
    [&]
    {
      if (data.Hierarchy && data.HierarchyShape == shape &&
          data.Hierarchy->Options().threads == options.multigrid.threads)
      {
        gridfem::UpdateMultigrid(space, options.screeningWeight, 1.0, *data.Hierarchy);
        return;
      }
      data.Hierarchy.reset(); // frees its memory first
      data.Hierarchy = std::make_unique<gridfem::Multigrid>(gridfem::BuildMultigrid(
        space, options.screeningWeight, 1.0, options.multigrid, progress.Part(0.0, 0.3)));
      data.HierarchyShape = shape;
    });
  gridfem::StageKey solve;
  solve.Add(state.stages.Version(gridfem::HierarchyStage));
  solve.Add(state.stages.Version(gridfem::RightHandSideStage));
  solve.Add(options.solve.tolerance).Add(options.solve.maximumIterations);
  state.stages.Run(gridfem::SolveStage, solve,
    [&]
    {
      const gridfem::MultiVector last = std::move(data.Solution.coefficients);
      options.start = &last;
      data.Solution =
        gridfem::SolveDetail(space, *data.Hierarchy, data.Load, options, progress.Part(0.3, 1.0));
    });
}

void vtkSurfaceDetail::WriteShape(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::TriangleMesh& mesh = *state.mesh.triangles;
  const gridfem::MultiVector change =
    data.Space(state).ValuesAtPoints(data.Change(this->DetailScale), this->NumberOfThreads);
  std::vector<gridfem::Vec3> points = mesh.points;
  for (gridfem::Id point = 0; point < change.rows(); ++point)
  {
    points[point] += Eigen::Map<const gridfem::Vec3>(&change(point, 0));
  }
  if (this->KeepVolume)
  {
    gridfem::ScaleToVolume(mesh, points, this->NumberOfThreads);
  }
  gridfem::MoveSurface(
    mesh, points, gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
}

void vtkSurfaceDetail::WriteArray(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  gridfem::MultiVector values =
    data.Space(state).ValuesAtPoints(data.Change(this->DetailScale), this->NumberOfThreads);
  const gridfem::MultiVector scale =
    data.ScaleField ? AtPoints(*data.ScaleField, *state.mesh.triangles, this->NumberOfThreads)
                    : gridfem::MultiVector::Ones(values.rows(), 1);
  const std::vector<char> isSolved = state.space->PointsWithFunctions();
  for (gridfem::Id point = 0; point < values.rows(); ++point)
  {
    const double own = isSolved[point] ? this->DetailScale * scale(point, 0) - 1.0 : 0.0;
    for (gridfem::Id c = 0; c < values.cols(); ++c)
    {
      values(point, c) += data.Value.array->GetComponent(point, static_cast<int>(c)) +
                          (isSolved[point] ? own * data.Signal.remainder(point, c) : 0.0);
    }
  }
  auto filtered = gridfem::MakePointArray("Filtered", values, data.Value.array->GetDataType());
  filtered->CopyComponentNames(data.Value.array);
  output->ShallowCopy(input);
  output->GetPointData()->AddArray(filtered);
  output->GetPointData()->SetActiveScalars("Filtered");
}

void vtkSurfaceDetail::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  this->CheckProperties();
  this->FindArrays(input);
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  state.UpdateSystem(progress.Part(0.3, 0.4));
  this->UpdateMetric(progress.Part(0.4, 0.5));
  this->UpdateLoad(progress.Part(0.5, 0.6));
  this->UpdateSolution(progress.Part(0.6, 0.95));
  if (this->Data->Value.array)
  {
    this->WriteArray(input, output);
  }
  else
  {
    output->ShallowCopy(input);
    this->WriteShape(input, output);
  }
  const gridfem::SolveReport& report = this->Data->Solution.report;
  gridfem::AddReport(report, output);
  if (this->Data->IsWeighed)
  {
    gridfem::AddFieldNumber(output, "UsualCurvature", this->Data->UsualCurvature);
  }
  if (!report.converged)
  {
    vtkWarningMacro(<< gridfem::WarningOf(report, this->Tolerance));
  }
  progress.Check(1.0);
}

void vtkSurfaceDetail::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkSurfaceDetail::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DetailScale: " << this->DetailScale << "\n";
  os << indent << "ScreeningWeight: " << this->ScreeningWeight << "\n";
  os << indent << "TransferFunction: " << this->TransferFunction << "\n";
  os << indent << "Anisotropy: " << this->Anisotropy << "\n";
  os << indent << "TransferPoints:";
  for (const auto& [curvature, length] : this->TransferPoints)
  {
    os << " (" << curvature << ", " << length << ")";
  }
  os << "\n";
  os << indent << "SmoothingScale: " << this->SmoothingScale << "\n";
  os << indent << "KeepVolume: " << this->KeepVolume << "\n";
}
