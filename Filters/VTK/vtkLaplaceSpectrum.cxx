#include "vtkLaplaceSpectrum.h"

#include "Private/CanDistribute.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/ModeReader.h"
#include "Private/Ranks.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"
#include "Private/SurfaceSpectrum.h"

#include "Base/Errors.h"
#include "Integrals/QuadratureRule.h"
#include "Problems/SolveWarnings.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkLaplaceSpectrum);

namespace
{

/// The first mode that is a time step: mode 0 is constant, so there is nothing to see.
int FirstTimeStep(int numberOfModes)
{
  return std::min(1, numberOfModes - 1);
}

} // namespace

struct vtkLaplaceSpectrum::Internals : gridfem::SurfaceSpectrum
{
  std::int64_t WarnedRun = 0; // the last solve whose cut multiplet was told of: not every time step
  /// NumberOfModes of the last solve: how many modes it gives is known.
  int SolvedModes = 0;
};

vtkLaplaceSpectrum::vtkLaplaceSpectrum() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  this->Tolerance = 1e-6;
  this->State->options.multigrid.cycle = gridfem::CycleType::V;
}

vtkLaplaceSpectrum::~vtkLaplaceSpectrum() = default;

int vtkLaplaceSpectrum::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

std::vector<double> vtkLaplaceSpectrum::OwnTimeSteps()
{
  std::vector<double> times;
  if (this->AllModes || this->Mode != -1)
  {
    return times;
  }
  const bool isSolved = this->Data->SolvedModes == this->NumberOfModes;
  const int count = isSolved ? this->Data->NumberOfModes() : this->NumberOfModes;
  for (int mode = FirstTimeStep(count); mode < count; ++mode)
  {
    times.push_back(mode);
  }
  return times;
}

int vtkLaplaceSpectrum::ShownMode(vtkInformation* output)
{
  const int count = this->Data->NumberOfModes();
  if (this->Mode >= count)
  {
    throw gridfem::InvalidInput("Mode " + std::to_string(this->Mode) +
                                " does not exist: there are " + std::to_string(count) +
                                " modes. Raise NumberOfModes or Depth.");
  }
  if (this->Mode >= 0)
  {
    return this->Mode;
  }
  const int first = FirstTimeStep(count);
  if (!output->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    return first;
  }
  const double time = output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
  if (!(time > first)) // NaN as well
  {
    return first;
  }
  return static_cast<int>(std::lround(std::min(time, double(count - 1))));
}

void vtkLaplaceSpectrum::WriteModes(vtkPolyData* input, vtkInformation* info, vtkPolyData* output)
{
  const gridfem::SurfaceSolverState& state = *this->State;
  const int precision = input->GetPoints() // an empty piece of a surface on several ranks has none
                          ? gridfem::OutputPrecision(input->GetPoints())
                          : VTK_DOUBLE;
  output->ShallowCopy(input);
  gridfem::RemoveModes(output); // an earlier run may have had more
  const auto addMode = [&](int mode, const std::string& name)
  {
    const gridfem::MultiVector values =
      this->Data->atPoints.cols() > 0
        ? gridfem::MultiVector(this->Data->atPoints.col(mode))
        : gridfem::EvaluateModes(state, this->Data->spectrum, mode, 1);
    output->GetPointData()->AddArray(gridfem::MakePointArray(name.c_str(), values, precision));
    return name;
  };
  std::string shown;
  if (this->AllModes)
  {
    for (int mode = 0; mode < this->Data->NumberOfModes(); ++mode)
    {
      addMode(mode, gridfem::ModeName(mode));
    }
    shown = gridfem::ModeName(0);
  }
  else
  {
    shown = addMode(this->ShownMode(info), "Mode");
  }
  output->GetPointData()->SetActiveScalars(shown.c_str());
  vtkNew<vtkDoubleArray> eigenvalues;
  eigenvalues->SetName("Eigenvalues");
  eigenvalues->SetNumberOfTuples(this->Data->NumberOfModes());
  std::copy(
    this->Data->eigenvalues.begin(), this->Data->eigenvalues.end(), eigenvalues->GetPointer(0));
  output->GetFieldData()->AddArray(eigenvalues);
  const bool converged = this->Data->spectrum.converged && this->IsAccurate();
  gridfem::AddFieldInt(output, "Converged", converged ? 1 : 0);
  state.WriteTracking(output);
}

void vtkLaplaceSpectrum::WriteTable(vtkTable* table)
{
  std::vector<int> modes(this->Data->NumberOfModes());
  for (int mode = 0; mode < this->Data->NumberOfModes(); ++mode)
  {
    modes[mode] = mode;
  }
  gridfem::AddColumn(table, "Mode", modes);
  gridfem::AddColumn(table, "Eigenvalue", this->Data->eigenvalues);
  gridfem::AddColumn(table, "Residual", this->Data->spectrum.residuals);
  gridfem::AddColumn(table, "EstimatedError", this->Data->spectrum.estimatedErrors);
}

bool vtkLaplaceSpectrum::IsAccurate() const
{
  return this->Accuracy == 0.0 || this->Data->LargestEstimatedError() <= this->Accuracy;
}

void vtkLaplaceSpectrum::Warn()
{
  const gridfem::FunctionKind kind = this->State->options.choice.kind;
  const std::string where = gridfem::PlaceOf(kind, this->Data->depth);
  const std::int64_t run = this->State->stages.Runs(gridfem::SolveStage);
  for (const std::string& warning : gridfem::WarningsOf(
         this->Data->spectrum, this->NumberOfModes, where, run != this->Data->WarnedRun))
  {
    vtkWarningMacro(<< warning);
  }
  this->Data->WarnedRun = run;
  if (!this->IsAccurate())
  {
    vtkWarningMacro(<< gridfem::WarningOfAccuracy(this->Accuracy,
                      this->Data->LargestEstimatedError(), kind, this->Data->depth));
  }
}

void vtkLaplaceSpectrum::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::RequireNumber("Accuracy", this->Accuracy);
  if (!this->AllModes)
  {
    gridfem::RequireAtLeast("Mode", this->Mode, -1);
  }
  gridfem::SpectrumRequest request;
  request.numberOfModes = this->NumberOfModes;
  request.accuracy = this->Accuracy;
  this->State->metricArray = gridfem::FindInputArray(this, 5, input, "MetricArray");
  this->State->options.trackMetric = this->TrackMetric && this->Accuracy == 0.0;
  this->Data->SolvedModes = 0;
  this->Data->Update(*this->State, input, vtkPolyData::GetData(inputs[1]), request);
  this->Data->SolvedModes = this->NumberOfModes;
  this->WriteModes(input, outputs->GetInformationObject(0), vtkPolyData::GetData(outputs, 0));
  this->WriteTable(vtkTable::GetData(outputs, 1));
  this->Warn();
  this->State->bridge.GetProgress().Check(1.0);
}

bool vtkLaplaceSpectrum::ComputeTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const bool needsAll =
    this->Accuracy > 0.0 || this->TrackMetric || gridfem::IsArrayChosen(this, 5);
  gridfem::SurfaceSolverState& state = *this->State;
  if (!gridfem::CanDistribute(this, inputs, needsAll))
  {
    return false;
  }
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  state.options.trackMetric = false;
  state.options.functionsPerPoint = gridfem::EnoughToEstimate;
  gridfem::SpectrumRequest request;
  request.numberOfModes = this->NumberOfModes;
  this->Data->SolvedModes = 0;
  state.RunTogether(
    [&](const gridfem::Progress& progress)
    {
      state.UpdateTogether(piece, vtkPolyData::GetData(inputs[1]));
      this->Data->UpdateTogether(state, request, progress.Part(0.3, 1.0));
      this->Data->SolvedModes = this->NumberOfModes;
      state.together.Together([&] { this->WriteDistributed(piece, outputs); });
    });
  return true;
}

/// Port 0 is the rank's own piece with its modes; the table is on the first rank.
void vtkLaplaceSpectrum::WriteDistributed(vtkPolyData* piece, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const vtkNew<vtkPolyData> nothing; // field arrays are on all ranks
  this->WriteModes(piece ? piece : nothing, outputs->GetInformationObject(0), output);
  gridfem::AddDistributed(this->State->together.Depth(), output);
  if (gridfem::Ranks().IsFirst())
  {
    this->WriteTable(vtkTable::GetData(outputs, 1));
    this->Warn();
  }
}

void vtkLaplaceSpectrum::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->spectrum = {};
  this->Data->atPoints = {};
}

void vtkLaplaceSpectrum::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfModes: " << this->NumberOfModes << "\n";
  os << indent << "Mode: " << this->Mode << "\n";
  os << indent << "AllModes: " << this->AllModes << "\n";
  os << indent << "TrackMetric: " << this->TrackMetric << "\n";
  os << indent << "Accuracy: " << this->Accuracy << "\n";
}
