#include "vtkSurfaceDetail.h"

#include "Private/ClippedMeshWriter.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/MovedMeshWriter.h"
#include "Private/SelectedPoints.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Problems/MarchedDistance.h"
#include "Problems/MovedSurface.h"
#include "Problems/SurfaceDetail.h"
#include "Solvers/CurvatureSolver.h"
#include "Solvers/PoissonEquation.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

vtkStandardNewMacro(vtkSurfaceDetail);

namespace
{

constexpr const char* MetricStage = "Metric";   // curvatures, stiffness split by direction
constexpr const char* WeightsStage = "Weights"; // of the elements
constexpr const char* SignalStage = "Signal";   // the input as a function of the space

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

/// Means over the corners; a field of triangles as it is.
gridfem::MultiVector OnTriangles(const gridfem::Field& field, const gridfem::TriangleMesh& mesh)
{
  gridfem::MultiVector means(static_cast<gridfem::Id>(mesh.triangles.size()), 1);
  for (gridfem::Id t = 0; t < means.rows(); ++t)
  {
    const auto rows = field.RowsOf(t, mesh.triangles[t]);
    means(t, 0) =
      (field.values(rows[0], 0) + field.values(rows[1], 0) + field.values(rows[2], 0)) / 3.0;
  }
  return means;
}

std::vector<double> OnElements(const gridfem::FiniteElementSpace& space,
  const gridfem::MultiVector& onTriangles, const gridfem::Job& job)
{
  const gridfem::MultiVector means = space.MeansOnElements(onTriangles, job);
  return { means.data(), means.data() + means.size() };
}

/// 1 at selected points, falling to 0 within the width.
gridfem::Field FadeOut(
  const gridfem::SurfaceSolverState& state, const gridfem::SelectedPoints& selection, double width)
{
  const gridfem::TriangleMesh& mesh = *state.mesh.triangles;
  gridfem::HatOptions options;
  options.weldCoincidentPoints = state.options.space.weldCoincidentPoints;
  options.threads = state.Threads();
  const std::vector<double> distance = gridfem::MarchDistance(
    mesh, gridfem::NumberHatFunctions(mesh, options), selection.Points(), width);
  gridfem::Field fade;
  fade.values.resize(static_cast<gridfem::Id>(distance.size()), 1);
  for (gridfem::Id point = 0; point < fade.values.rows(); ++point)
  {
    const double way = distance[point];
    fade.values(point, 0) = way == 0.0    ? 1.0
                            : way < width ? gridfem::SmoothStep(1.0 - way / width)
                                          : 0.0;
  }
  return fade;
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
  std::optional<gridfem::Field> Fade; // of the selection
  /// Its load has blocks of columns, one for each of: the scale 1; the scale array; the same times
  /// the fade. Of a solution for other columns the first are still good.
  gridfem::PoissonEquation Equation;

  const gridfem::FiniteElementSpace& Space(const gridfem::SurfaceSolverState& state) const
  {
    return this->IsWeighed ? *this->Weighed : *state.space;
  }

  /// The change for the scales inside and outside of the selection, as coefficients: linear in
  /// them.
  gridfem::MultiVector Change(double inside, double outside) const
  {
    const gridfem::MultiVector& solved = this->Equation.Solution().coefficients;
    const gridfem::Id columns = this->Signal.coefficients.cols();
    const double everywhere = this->Fade ? outside : inside;
    gridfem::MultiVector change =
      everywhere * solved.middleCols(this->ScaleField ? columns : 0, columns) -
      solved.leftCols(columns);
    if (this->Fade)
    {
      change += (inside - outside) * solved.rightCols(columns);
    }
    return change;
  }

  /// Of the change, relative to it; its largest error at a point is at most what the blocks add up
  /// to.
  gridfem::SolutionAccuracy AccuracyOfChange(double inside, double outside) const
  {
    gridfem::SolutionAccuracy accuracy = this->Equation.Accuracy();
    const bool hasBlocks = this->Fade || this->ScaleField;
    accuracy.largest *= !hasBlocks ? std::abs(inside - 1.0)
                                   : 1.0 + std::abs(this->Fade ? outside : inside) +
                                       (this->Fade ? std::abs(inside - outside) : 0.0);
    return accuracy;
  }

  /// The scale at the points.
  gridfem::MultiVector ScaleAtPoints(
    double inside, double outside, const gridfem::TriangleMesh& mesh, int threads) const
  {
    const auto points = static_cast<gridfem::Id>(mesh.points.size());
    gridfem::MultiVector scale =
      gridfem::MultiVector::Constant(points, 1, this->Fade ? outside : inside);
    if (this->Fade)
    {
      scale += (inside - outside) * this->Fade->values;
    }
    return this->ScaleField
             ? gridfem::MultiVector(scale.cwiseProduct(AtPoints(*this->ScaleField, mesh, threads)))
             : scale;
  }
};

vtkSurfaceDetail::vtkSurfaceDetail()
  : Data(std::make_unique<Internals>()), Selection(std::make_unique<gridfem::SelectedPoints>(this))
{
  this->SetNumberOfInputPorts(3);
  this->CustomTransferFunction = vtkSmartPointer<vtkPiecewiseFunction>::New();
  this->CustomTransferFunction->AddPoint(-1.0, 1.0);
  this->CustomTransferFunction->AddPoint(0.0, 0.0);
  this->CustomTransferFunction->AddPoint(1.0, 1.0);
  this->Tolerance = 1e-4;
  this->NormalStabilization = 1e-2;
  this->MaximumIterations = 200;
}

vtkSurfaceDetail::~vtkSurfaceDetail() = default;

int vtkSurfaceDetail::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkSelection");
  }
  return 1;
}

void vtkSurfaceDetail::SetCustomTransferFunction(vtkPiecewiseFunction* function)
{
  if (this->CustomTransferFunction != function)
  {
    this->CustomTransferFunction = function;
    this->Modified();
  }
}

vtkPiecewiseFunction* vtkSurfaceDetail::GetCustomTransferFunction()
{
  return this->CustomTransferFunction;
}

vtkMTimeType vtkSurfaceDetail::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->TransferFunction == Custom && this->CustomTransferFunction
           ? std::max(own, this->CustomTransferFunction->GetMTime())
           : own;
}

double vtkSurfaceDetail::LengthOf(double curvature) const
{
  if (this->TransferFunction == Custom)
  {
    return 1.0 + (this->Anisotropy - 1.0) * this->CustomTransferFunction->GetValue(curvature);
  }
  return gridfem::LengthOf(
    static_cast<gridfem::CurvatureTransfer>(this->TransferFunction), curvature, this->Anisotropy);
}

void vtkSurfaceDetail::CheckProperties() const
{
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::RequireAtLeast("ScreeningWeight", this->ScreeningWeight, 0.0);
  gridfem::RequireAtLeast("SmoothingScale", this->SmoothingScale, 0.0);
  gridfem::RequireNumber("Anisotropy", this->Anisotropy);
  gridfem::RequireAtLeast("TransitionWidth", this->TransitionWidth, 0.0);
  for (const auto& [name, scale] :
    { std::pair("DetailScale", this->DetailScale), std::pair("OutsideScale", this->OutsideScale) })
  {
    if (!std::isfinite(scale))
    {
      throw gridfem::InvalidInput(std::string(name) + " must be a finite number.");
    }
  }
  if (this->TransferFunction == Custom &&
      (!this->CustomTransferFunction || this->CustomTransferFunction->GetSize() == 0))
  {
    throw gridfem::InvalidInput("CustomTransferFunction has no points.");
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
        gridfem::CurvaturesOf(state, this->SmoothingScale, state.options, report,
          state.MakeJob(progress.Part(0.0, 0.5))),
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
  if (this->TransferFunction == Custom)
  {
    weights.Add(this->CustomTransferFunction.GetPointer());
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

void vtkSurfaceDetail::UpdateSignal(const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(data.Value.array);
  state.stages.Run(SignalStage, key,
    [&]
    {
      const gridfem::Job job = state.MakeJob(progress);
      data.Signal = data.Value.array ? gridfem::ProjectSignal(*state.space,
                                         gridfem::ReadField(data.Value, state.mesh),
                                         state.options.multigrid, state.options.solve, job)
                                     : gridfem::ShapeInSpace(*state.space, job);
    });
}

gridfem::PoissonLoad vtkSurfaceDetail::Integrate(const gridfem::Job& job)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::FiniteElementSpace& space = data.Space(state);
  const gridfem::TriangleMesh& mesh = *state.mesh.triangles;
  data.ScaleField.reset();
  data.Fade.reset();
  gridfem::PoissonLoad load;
  const gridfem::Id columns = data.Signal.coefficients.cols();
  const double blocks =
    1.0 + (data.Scale.array ? 1.0 : 0.0) + (this->Selection->IsGiven() ? 1.0 : 0.0);
  double done = 0.0;
  const auto append = [&](const gridfem::MultiVector* scale)
  {
    const gridfem::Job part = job.Part(done / blocks, (done + 1.0) / blocks);
    const std::vector<double> onElements =
      scale ? OnElements(space, *scale, part.Part(0.0, 0.5)) : std::vector<double>();
    load.gradients.conservativeResize(space.Integrals().size(), load.gradients.cols() + columns);
    load.gradients.rightCols(columns) =
      space.StiffnessTimes(data.Signal.coefficients, onElements, part.Part(scale ? 0.5 : 0.0, 1.0));
    done += 1.0;
  };
  append(nullptr);
  gridfem::MultiVector scale;
  if (data.Scale.array)
  {
    data.ScaleField = gridfem::ReadField(data.Scale, state.mesh);
    scale = OnTriangles(*data.ScaleField, mesh);
    append(&scale);
  }
  if (this->Selection->IsGiven())
  {
    data.Fade = FadeOut(state, *this->Selection, state.LengthInWorldUnits(this->TransitionWidth));
    gridfem::MultiVector fade = OnTriangles(*data.Fade, mesh);
    if (data.ScaleField)
    {
      fade.array() *= scale.array();
    }
    append(&fade);
  }
  load.values.setZero(load.gradients.rows(), load.gradients.cols());
  return load;
}

void vtkSurfaceDetail::Solve(const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey fields;
  fields.Add(state.stages.Version(SignalStage)).Add(data.Scale.array);
  fields.Add(static_cast<int>(data.Scale.association)).Add(this->Selection->Version());
  if (this->Selection->IsGiven())
  {
    fields.Add(this->TransitionWidth).Add(this->ParameterUnits);
  }
  gridfem::PoissonRequest request;
  request.weight = this->ScreeningWeight;
  request.space = &data.Space(state);
  request.numbers.Add(data.IsWeighed ? state.stages.Version(WeightsStage) : -1);
  request.startsFromLast = true;
  const auto integrate = [this](const gridfem::SurfaceSpace&, const gridfem::Job& job)
  { return this->Integrate(job); };
  data.Equation.Update(state, fields, integrate, request, state.options, progress);
}

void vtkSurfaceDetail::WriteShape(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::TriangleMesh& mesh = *state.mesh.triangles;
  const gridfem::MultiVector change = data.Space(state).ValuesAtPoints(
    data.Change(this->DetailScale, this->OutsideScale), this->NumberOfThreads);
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
  gridfem::MultiVector values = data.Space(state).ValuesAtPoints(
    data.Change(this->DetailScale, this->OutsideScale), this->NumberOfThreads);
  const gridfem::MultiVector scale = data.ScaleAtPoints(
    this->DetailScale, this->OutsideScale, *state.mesh.triangles, this->NumberOfThreads);
  const std::vector<char> isSolved = state.space->PointsWithFunctions();
  for (gridfem::Id point = 0; point < values.rows(); ++point)
  {
    const double own = isSolved[point] ? scale(point, 0) - 1.0 : 0.0;
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

void vtkSurfaceDetail::WriteReport(vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::SolveReport& report = data.Equation.Report();
  if (data.Fade)
  {
    output->GetPointData()->AddArray(
      gridfem::MakePointArray("Selected", data.Fade->values, VTK_DOUBLE));
  }
  gridfem::AddReport(report, output);
  gridfem::AddAccuracy(data.AccuracyOfChange(this->DetailScale, this->OutsideScale), output);
  if (data.IsWeighed)
  {
    gridfem::AddFieldNumber(output, "UsualCurvature", data.UsualCurvature);
  }
  if (!report.converged)
  {
    vtkWarningMacro(<< gridfem::WarningOf(report, this->Tolerance));
  }
}

void vtkSurfaceDetail::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  this->CheckProperties();
  this->FindArrays(input);
  this->Selection->Update(vtkSelection::GetData(inputs[2]), input);
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  state.UpdateSystem(progress.Part(0.3, 0.4));
  this->UpdateMetric(progress.Part(0.4, 0.5));
  this->UpdateSignal(progress.Part(0.5, 0.55));
  this->Solve(progress.Part(0.55, 0.95));
  if (this->Data->Value.array)
  {
    this->WriteArray(input, output);
  }
  else
  {
    output->ShallowCopy(input);
    this->WriteShape(input, output);
  }
  this->WriteReport(output);
  progress.Check(1.0);
}

void vtkSurfaceDetail::FreeStages()
{
  this->Superclass::FreeStages();
  this->Selection->Free();
  *this->Data = Internals();
}

void vtkSurfaceDetail::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DetailScale: " << this->DetailScale << "\n";
  os << indent << "OutsideScale: " << this->OutsideScale << "\n";
  os << indent << "TransitionWidth: " << this->TransitionWidth << "\n";
  os << indent << "ScreeningWeight: " << this->ScreeningWeight << "\n";
  os << indent << "TransferFunction: " << this->TransferFunction << "\n";
  os << indent << "Anisotropy: " << this->Anisotropy << "\n";
  os << indent << "CustomTransferFunction: " << this->CustomTransferFunction.GetPointer() << "\n";
  os << indent << "SmoothingScale: " << this->SmoothingScale << "\n";
  os << indent << "KeepVolume: " << this->KeepVolume << "\n";
}
