#include "vtkLaplaceSpectrum.h"

#include "Private/ClippedMeshWriter.h"
#include "Private/InputValidation.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "Errors.h"
#include "Evaluation.h"
#include "Spectrum.h"

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
#include <iomanip>
#include <sstream>

vtkStandardNewMacro(vtkLaplaceSpectrum);

namespace
{

/// The first mode that is a time step: mode 0 is constant, so there is nothing to see.
int FirstTimeStep(int numberOfModes)
{
  return std::min(1, numberOfModes - 1);
}

} // namespace

struct vtkLaplaceSpectrum::Internals
{
  gridfem::Spectrum Spectrum;
  std::vector<double> Eigenvalues; // world units

  int NumberOfModes() const { return static_cast<int>(this->Eigenvalues.size()); }
};

vtkLaplaceSpectrum::vtkLaplaceSpectrum() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  this->Tolerance = 1e-8;
}

vtkLaplaceSpectrum::~vtkLaplaceSpectrum() = default;

int vtkLaplaceSpectrum::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkLaplaceSpectrum::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  std::vector<double> times;
  for (int mode = FirstTimeStep(this->NumberOfModes); mode < this->NumberOfModes; ++mode)
  {
    times.push_back(mode);
  }
  const double range[2] = { times.front(), times.back() };
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    if (this->AllModes || this->Mode >= 0)
    {
      info->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
      info->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
      continue;
    }
    info->Set(
      vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
  return 1;
}

void vtkLaplaceSpectrum::UpdateSpectrum()
{
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey key;
  key.Add(state.stages.Version(SystemStage)).Add(this->NumberOfModes);
  key.Add(this->Tolerance).Add(this->MaximumIterations);
  key.Add(this->Cycle).Add(this->Smoother).Add(this->NumberOfThreads);
  const auto solve = [&]
  {
    gridfem::RequireMemoryForModes(state.Space().Finest().numberOfFunctions, this->NumberOfModes);
    gridfem::SpectrumOptions options;
    options.numberOfModes = this->NumberOfModes;
    options.tolerance = this->Tolerance;
    options.maximumIterations = this->MaximumIterations;
    options.multigrid = state.options.multigrid;
    this->Data->Spectrum = gridfem::ComputeSpectrum(
      state.Space(), *state.system, options, state.bridge.GetProgress().Part(0.5, 0.95));
    const double spacing = state.Space().GetGrid().spacing;
    this->Data->Eigenvalues = this->Data->Spectrum.eigenvalues;
    for (double& eigenvalue : this->Data->Eigenvalues)
    {
      eigenvalue /= spacing * spacing;
    }
  };
  state.stages.Run(SolveStage, key, solve);
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
  const gridfem::MultiVector& vectors = this->Data->Spectrum.vectors;
  const int precision = gridfem::OutputPrecision(input->GetPoints());
  output->ShallowCopy(input);
  const auto addMode = [&](int mode, const std::string& name)
  {
    // The integral over grid units is spacing² times smaller than the one over world units.
    const gridfem::MultiVector coefficients = vectors.col(mode) / state.Space().GetGrid().spacing;
    const gridfem::MultiVector values =
      gridfem::EvaluateAtPoints(state.Space(), coefficients, this->NumberOfThreads);
    output->GetPointData()->AddArray(gridfem::MakePointArray(name.c_str(), values, precision));
    return name;
  };
  std::string shown;
  if (this->AllModes)
  {
    for (int mode = 0; mode < this->Data->NumberOfModes(); ++mode)
    {
      std::ostringstream name;
      name << "Mode" << std::setfill('0') << std::setw(3) << mode;
      shown = addMode(mode, name.str());
    }
    shown = "Mode000";
  }
  else
  {
    shown = addMode(this->ShownMode(info), "Mode");
  }
  output->GetPointData()->SetActiveScalars(shown.c_str());
  if (info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(),
      info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()));
  }
  vtkNew<vtkDoubleArray> eigenvalues;
  eigenvalues->SetName("Eigenvalues");
  eigenvalues->SetNumberOfTuples(this->Data->NumberOfModes());
  std::copy(
    this->Data->Eigenvalues.begin(), this->Data->Eigenvalues.end(), eigenvalues->GetPointer(0));
  output->GetFieldData()->AddArray(eigenvalues);
  gridfem::AddFieldInt(output, "Converged", this->Data->Spectrum.converged ? 1 : 0);
}

void vtkLaplaceSpectrum::WriteTable(vtkTable* table)
{
  std::vector<int> modes(this->Data->NumberOfModes());
  for (int mode = 0; mode < this->Data->NumberOfModes(); ++mode)
  {
    modes[mode] = mode;
  }
  gridfem::AddColumn(table, "Mode", modes);
  gridfem::AddColumn(table, "Eigenvalue", this->Data->Eigenvalues);
  gridfem::AddColumn(table, "Residual", this->Data->Spectrum.residuals);
}

void vtkLaplaceSpectrum::Warn()
{
  const gridfem::Spectrum& spectrum = this->Data->Spectrum;
  if (spectrum.truncated)
  {
    vtkWarningMacro("Only " << this->Data->NumberOfModes() << " of the " << this->NumberOfModes
                            << " modes exist at this Depth.");
  }
  if (!spectrum.converged)
  {
    const double worst = spectrum.residuals.empty() ? 0.0
                                                    : *std::max_element(spectrum.residuals.begin(),
                                                        spectrum.residuals.end());
    vtkWarningMacro("Not converged after "
                    << spectrum.iterations << " iterations: " << spectrum.numberOfConverged
                    << " of " << this->Data->NumberOfModes()
                    << " modes reached the tolerance, the largest residual is " << worst
                    << ". The result is kept.");
  }
}

void vtkLaplaceSpectrum::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  progress.Check(0.3);
  state.UpdateSystem(progress.Part(0.3, 0.5));
  progress.Check(0.5);
  this->UpdateSpectrum();
  this->WriteModes(input, outputs->GetInformationObject(0), vtkPolyData::GetData(outputs, 0));
  this->WriteTable(vtkTable::GetData(outputs, 1));
  this->Warn();
  progress.Check(1.0);
}

void vtkLaplaceSpectrum::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfModes: " << this->NumberOfModes << "\n";
  os << indent << "Mode: " << this->Mode << "\n";
  os << indent << "AllModes: " << this->AllModes << "\n";
}
