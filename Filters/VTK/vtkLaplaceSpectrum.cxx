#include "vtkLaplaceSpectrum.h"

#include "Input/InputValidation.h"
#include "Input/ModeReader.h"
#include "Output/ClippedMeshWriter.h"
#include "Output/SolverOutput.h"
#include "Pieces/CanDistribute.h"
#include "Pieces/Ranks.h"
#include "Pipeline/FilterState.h"
#include "Pipeline/PipelineTime.h"

#include "Base/Errors.h"
#include "Integrals/QuadratureRule.h"
#include "Solvers/SpectrumSolver.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <numeric>

vtkStandardNewMacro(vtkLaplaceSpectrum);

struct vtkLaplaceSpectrum::Internals
{
  gridfem::SpectrumSolver Solver;
  const gridfem::SpectrumSolver::Result* Result = nullptr; // of this run
  ///@{ The number of modes that NumberOfModes has given. It stays when the modes are freed.
  int WantedModes = 0;
  int FoundModes = 0;
  ///@}
};

vtkLaplaceSpectrum::vtkLaplaceSpectrum() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  const gridfem::EquationOptions equation = gridfem::EquationOfModes();
  this->Tolerance = equation.solve.tolerance;
  this->State->options.multigrid.cycle = equation.multigrid.cycle;
}

vtkLaplaceSpectrum::~vtkLaplaceSpectrum() = default;

int vtkLaplaceSpectrum::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkTable");
  return 1;
}

std::vector<double> vtkLaplaceSpectrum::OwnTimeSteps()
{
  std::vector<double> times;
  if (this->AllModes || this->Mode != -1)
  {
    return times;
  }
  const bool isSolved = this->Data->WantedModes == this->NumberOfModes;
  const int count = isSolved ? this->Data->FoundModes : this->NumberOfModes;
  for (int mode = this->FirstTimeStep(count); mode < count; ++mode)
  {
    times.push_back(mode);
  }
  return times;
}

/// The first mode that is a time step. A mode 0 that is constant shows nothing.
int vtkLaplaceSpectrum::FirstTimeStep(int numberOfModes) const
{
  return this->ZeroBoundaryValues ? 0 : std::min(1, numberOfModes - 1);
}

bool vtkLaplaceSpectrum::NeedsWholeSurface()
{
  return this->Accuracy > 0.0 || this->TrackMetric || gridfem::IsArrayChosen(this, 5);
}

void vtkLaplaceSpectrum::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  if (!this->AllModes)
  {
    gridfem::RequireAtLeast("Mode", this->Mode, -1);
  }
  state.options.trackMetric = this->TrackMetric && this->Accuracy == 0.0;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  const bool choosesDepth = this->Accuracy > 0.0 && !surface.AreFunctionsGiven();
  state.options.functionsPerPoint =
    choosesDepth ? gridfem::AsManyAsWanted
                 : gridfem::SpectrumSolver::SurfaceDefaults().functionsPerPoint;
  state.options.metricArray = surface.Find(5, "Metric Array");
  this->Solve();

  const vtkNew<vtkPolyData> nothing; // field arrays are on all ranks
  const int shown =
    this->WriteModes(input ? input : nothing, outputs->GetInformationObject(0), output);
  surface.Together(
    [&]
    {
      this->WriteFields(output);
      this->WriteLabel(shown, vtkTable::GetData(outputs, 2));
      if (gridfem::Ranks().IsFirst())
      {
        this->WriteTable(vtkTable::GetData(outputs, 1));
      }
    });
  this->Warn(this->Data->Result->warnings);
  state.GetProgress().Check(1.0);
}

void vtkLaplaceSpectrum::Solve()
{
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Surface();
  gridfem::SpectrumSolver::Options options;
  options.equation = state.options;
  options.numberOfModes = this->NumberOfModes;
  options.accuracy = this->Accuracy;
  options.zeroBoundaryValues = this->ZeroBoundaryValues;
  gridfem::SpectrumSolver::Input input;
  input.announce = [&](const std::string& cost, bool takesHours)
  { state.bridge.Announce(cost, takesHours); };
  this->Data->WantedModes = 0;
  this->Data->Result = &this->Data->Solver.Update(
    surface, input, options, { surface.Threads(), state.GetProgress().Part(0.0, 0.95) });
  this->Data->WantedModes = this->NumberOfModes;
  this->Data->FoundModes = this->Data->Result->NumberOfModes();
}

int vtkLaplaceSpectrum::ShownMode(vtkInformation* output) const
{
  const int count = this->Data->FoundModes;
  if (this->Mode >= count)
  {
    throw gridfem::InvalidInput(
      "Mode " + std::to_string(this->Mode) + " does not exist: there are " + std::to_string(count) +
      " modes. Choose a smaller Mode, or a larger Number Of Modes or Depth.");
  }
  if (this->Mode >= 0)
  {
    return this->Mode;
  }
  const int first = this->FirstTimeStep(count);
  return gridfem::RequestedTime(output) ? gridfem::ShownStep(output, first, count - 1) : first;
}

/// Adds one mode at a time, because all of them may need much memory. Collective.
/// @return  the shown mode, or -1 with all modes
int vtkLaplaceSpectrum::WriteModes(vtkPolyData* input, vtkInformation* info, vtkPolyData* output)
{
  output->ShallowCopy(input);
  if (gridfem::CarriesModes(output))
  {
    gridfem::RemoveModes(output); // an earlier run may have had more
  }
  if (!this->AllModes)
  {
    int shown = 0;
    this->State->Surface().Together([&] { shown = this->ShownMode(info); });
    this->AddMode(shown, "Mode", output);
    output->GetPointData()->SetActiveScalars("Mode");
    return shown;
  }
  for (int mode = 0; mode < this->Data->FoundModes; ++mode)
  {
    this->AddMode(mode, gridfem::ModeName(mode), output);
  }
  const int varying = std::min(1, this->Data->FoundModes - 1); // mode 0 is constant
  output->GetPointData()->SetActiveScalars(gridfem::ModeName(varying).c_str());
  return -1;
}

void vtkLaplaceSpectrum::AddMode(int mode, const std::string& name, vtkPolyData* output)
{
  gridfem::InputSurface& surface = this->State->Surface();
  const gridfem::MultiVector values = this->Data->Solver.ModesAtPoints(surface, mode, 1);
  surface.Together(
    [&]
    {
      const int precision = output->GetPoints() // an empty piece of a surface has none
                              ? gridfem::OutputPrecision(output->GetPoints())
                              : VTK_DOUBLE;
      output->GetPointData()->AddArray(gridfem::MakePointArray(name.c_str(), values, precision));
    });
}

void vtkLaplaceSpectrum::WriteFields(vtkPolyData* output) const
{
  const gridfem::SpectrumSolver::Result& result = *this->Data->Result;
  gridfem::AddFieldNumbers(output, "Eigenvalues", result.eigenvalues);
  const bool converged = result.spectrum.converged && result.isAccurate;
  gridfem::AddFieldInt(output, "Converged", converged ? 1 : 0);
  gridfem::AddFieldInt(output, "CutsGroup", result.spectrum.cutsMultiplet ? 1 : 0);
  gridfem::AddFieldInt(output, "TrustedEstimate", result.isErrorTrusted ? 1 : 0);
  gridfem::AddDevice(result.spectrum.where, output);
  this->State->Surface().WriteTracking(output);
}

/// Tells in the view which mode is shown. Without one the text is empty, because a view without a
/// new text keeps the last.
void vtkLaplaceSpectrum::WriteLabel(int shown, vtkTable* label) const
{
  std::string text;
  if (shown >= 0)
  {
    const double eigenvalue = this->Data->Result->eigenvalues[static_cast<std::size_t>(shown)];
    text = "Mode " + std::to_string(shown) + ", eigenvalue " + gridfem::ShortNumber(eigenvalue);
  }
  gridfem::WriteText(text, label);
}

void vtkLaplaceSpectrum::WriteTable(vtkTable* table) const
{
  const gridfem::SpectrumSolver::Result& result = *this->Data->Result;
  std::vector<int> modes(static_cast<std::size_t>(result.NumberOfModes()));
  std::iota(modes.begin(), modes.end(), 0);
  gridfem::AddColumn(table, "Mode", modes);
  gridfem::AddColumn(table, "Eigenvalue", result.eigenvalues);
  gridfem::AddColumn(table, "Residual", result.spectrum.residuals);
  gridfem::AddColumn(table, "EstimatedError", result.spectrum.estimatedErrors);
  const std::vector<char>& isTrusted = result.spectrum.isErrorTrusted;
  gridfem::AddColumn(
    table, "TrustedEstimate", std::vector<int>(isTrusted.begin(), isTrusted.end()));
}

void vtkLaplaceSpectrum::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Solver.Free();
}

void vtkLaplaceSpectrum::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfModes: " << this->NumberOfModes << "\n";
  os << indent << "Mode: " << this->Mode << "\n";
  os << indent << "AllModes: " << this->AllModes << "\n";
  os << indent << "ZeroBoundaryValues: " << this->ZeroBoundaryValues << "\n";
  os << indent << "TrackMetric: " << this->TrackMetric << "\n";
  os << indent << "Accuracy: " << this->Accuracy << "\n";
}
