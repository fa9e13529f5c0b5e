#include "vtkSurfaceDetail.h"

#include "Input/InputArray.h"
#include "Input/SelectedPoints.h"
#include "Output/ClippedMeshWriter.h"
#include "Output/MovedMeshWriter.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Integrals/QuadratureRule.h"
#include "Solvers/DetailSolver.h"

#include "vtkDataArray.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>

vtkStandardNewMacro(vtkSurfaceDetail);

struct vtkSurfaceDetail::Internals
{
  gridfem::InputArray Value; // none: the shape
  gridfem::DetailSolver Solver;
  const gridfem::DetailSolver::Result* Result = nullptr; // of this run
};

vtkSurfaceDetail::vtkSurfaceDetail() : Data(std::make_unique<Internals>())
{
  this->SetSelectionPort(2);
  this->CustomTransferFunction = vtkSmartPointer<vtkPiecewiseFunction>::New();
  this->CustomTransferFunction->AddPoint(-1.0, 1.0);
  this->CustomTransferFunction->AddPoint(0.0, 0.0);
  this->CustomTransferFunction->AddPoint(1.0, 1.0);
  const gridfem::DetailSolver::Options options;
  this->Tolerance = options.equation.solve.tolerance;
  this->MaximumIterations = options.equation.solve.maximumIterations;
  this->NormalStabilization = gridfem::DetailSolver::SurfaceDefaults().choice.normalStabilization;
}

vtkSurfaceDetail::~vtkSurfaceDetail() = default;

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

void vtkSurfaceDetail::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  Internals& data = *this->Data;
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  data.Value = surface.Find(0, "Value Array");
  this->ReadSelection(inputs);

  gridfem::DetailSolver::Input given;
  given.values = surface.Given(data.Value);
  given.scale = surface.Given(surface.Find(1, "Detail Scale Array"));
  given.hasSelection = this->Selection->IsGiven();
  given.selected = this->Selection->Points();
  given.selection.Add(this->Selection->Version());
  vtkPiecewiseFunction* const curve = this->CustomTransferFunction;
  if (curve && curve->GetSize() > 0)
  {
    given.custom = [curve](double curvature) { return curve->GetValue(curvature); };
  }
  given.curve.Add(curve);

  gridfem::DetailSolver::Options options;
  options.equation = state.options;
  options.detailScale = this->DetailScale;
  options.outsideScale = this->OutsideScale;
  options.transitionWidth = this->TransitionWidth;
  options.screeningWeight = this->ScreeningWeight;
  options.transferFunction = static_cast<gridfem::CurvatureTransfer>(this->TransferFunction);
  options.anisotropy = this->Anisotropy;
  options.smoothingScale = this->SmoothingScale;
  options.keepVolume = this->KeepVolume;
  const gridfem::Progress progress = state.GetProgress();
  const gridfem::DetailSolver::Result& result =
    data.Solver.Update(surface, given, options, { surface.Threads(), progress.Part(0.0, 0.95) });
  data.Result = &result;

  output->ShallowCopy(input);
  if (data.Value.array)
  {
    this->WriteArray(output);
  }
  else
  {
    gridfem::MoveSurface(surface.Mesh(), result.points,
      gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
  this->WriteFacts(output);
  progress.Check(1.0);
}

void vtkSurfaceDetail::WriteArray(vtkPolyData* output)
{
  vtkDataArray* given = this->Data->Value.array;
  gridfem::MultiVector values = this->Data->Result->change;
  for (gridfem::Id point = 0; point < values.rows(); ++point)
  {
    for (gridfem::Id c = 0; c < values.cols(); ++c)
    {
      values(point, c) += given->GetComponent(point, static_cast<int>(c));
    }
  }
  output->GetPointData()->AddArray(
    gridfem::MakeSolution("Filtered", values, this->Data->Value, given->GetDataType()));
  output->GetPointData()->SetActiveScalars("Filtered");
}

void vtkSurfaceDetail::WriteFacts(vtkPolyData* output)
{
  const gridfem::DetailSolver::Result& result = *this->Data->Result;
  if (result.selected.rows() > 0)
  {
    output->GetPointData()->AddArray(
      gridfem::MakePointArray("Selected", result.selected, VTK_DOUBLE));
  }
  gridfem::AddReport(result.report, output);
  gridfem::AddAccuracy(result.accuracy, output);
  if (result.isWeighted)
  {
    gridfem::AddFieldNumber(output, "UsualCurvature", result.usualCurvature);
  }
  this->Warn(result.warnings);
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
  os << indent << "OutsideScale: " << this->OutsideScale << "\n";
  os << indent << "TransitionWidth: " << this->TransitionWidth << "\n";
  os << indent << "ScreeningWeight: " << this->ScreeningWeight << "\n";
  os << indent << "TransferFunction: " << this->TransferFunction << "\n";
  os << indent << "Anisotropy: " << this->Anisotropy << "\n";
  os << indent << "CustomTransferFunction: " << this->CustomTransferFunction.GetPointer() << "\n";
  os << indent << "SmoothingScale: " << this->SmoothingScale << "\n";
  os << indent << "KeepVolume: " << this->KeepVolume << "\n";
}
