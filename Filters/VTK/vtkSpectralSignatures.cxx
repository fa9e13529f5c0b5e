#include "vtkSpectralSignatures.h"

#include "Private/CanDistribute.h"
#include "Private/CarriedModes.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/ModeReader.h"
#include "Private/MovedMeshWriter.h"
#include "Private/Ranks.h"
#include "Private/SolverOutput.h"
#include "Private/SourcePoints.h"
#include "Private/SurfaceSolverState.h"

#include "Integrals/QuadratureRule.h"
#include "Solvers/SignatureSolver.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <sstream>

vtkStandardNewMacro(vtkSpectralSignatures);

namespace
{

/// Adds a point array whose components are named by their scales.
void AddSignature(vtkPolyData* output, const char* name, const gridfem::MultiVector& values,
  const char* symbol, const std::vector<double>& scales, int precision)
{
  auto array = gridfem::MakePointArray(name, values, precision);
  for (std::size_t j = 0; j < scales.size(); ++j)
  {
    std::ostringstream component;
    component.precision(3);
    component << symbol << " = " << scales[j];
    array->SetComponentName(static_cast<vtkIdType>(j), component.str().c_str());
  }
  output->GetPointData()->AddArray(array);
}

void AddNumbers(
  vtkPolyData* output, const char* name, const std::vector<double>& values, int precision)
{
  const Eigen::Map<const Eigen::VectorXd> column(values.data(), values.size());
  output->GetPointData()->AddArray(gridfem::MakePointArray(name, column, precision));
}

} // namespace

struct vtkSpectralSignatures::Internals
{
  std::vector<gridfem::Id> SourceIds;
  gridfem::CarriedModes Carried;
  gridfem::SignatureSolver Solver;
  gridfem::SignatureSolver::Input Given;                    // in this run
  const gridfem::SignatureSolver::Result* Result = nullptr; // of this run
  gridfem::InputMesh Mesh;   // of the modes, with a rank's copies of others' triangles
  gridfem::InputArray Value; // to be filtered; none: the coordinates
};

vtkSpectralSignatures::vtkSpectralSignatures() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
  const gridfem::EquationOptions equation = gridfem::EquationOfModes();
  this->Tolerance = equation.solve.tolerance;
  this->State->options.multigrid.cycle = equation.multigrid.cycle;
}

vtkSpectralSignatures::~vtkSpectralSignatures() = default;

int vtkSpectralSignatures::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  }
  return 1;
}

int vtkSpectralSignatures::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

void vtkSpectralSignatures::AddSourcePointId(vtkIdType id)
{
  this->Data->SourceIds.push_back(id);
  this->Modified();
}

void vtkSpectralSignatures::ClearSourcePointIds()
{
  if (!this->Data->SourceIds.empty())
  {
    this->Data->SourceIds.clear();
    this->Modified();
  }
}

vtkIdType vtkSpectralSignatures::GetNumberOfSourcePointIds()
{
  return static_cast<vtkIdType>(this->Data->SourceIds.size());
}

vtkIdType vtkSpectralSignatures::GetSourcePointId(vtkIdType index)
{
  return index >= 0 && index < this->GetNumberOfSourcePointIds() ? this->Data->SourceIds[index]
                                                                 : -1;
}

/// A rank knows only its own points, so that the sources of other ranks are missing. Moved points
/// need the whole surface, because their normals and the arrays that follow them come from it.
bool vtkSpectralSignatures::NeedsWholeSurface()
{
  const bool moves = this->FilterType != NoFilter && !gridfem::IsArrayChosen(this, 0);
  return moves || !this->Data->SourceIds.empty();
}

void vtkSpectralSignatures::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  state.options.functionsPerPoint = gridfem::SignatureSolver::SurfaceDefaults().functionsPerPoint;
  state.SetInput(input, vtkPolyData::GetData(inputs[1]));
  data.Given = {};
  data.Given.modes = data.Carried.Update(state, input);
  this->Solve(vtkDataSet::GetData(inputs[2]));
  state.Together(
    [&]
    {
      this->Write(input, vtkPolyData::GetData(outputs, 0));
      if (gridfem::Ranks().IsFirst())
      {
        this->WriteTable(vtkTable::GetData(outputs, 1));
      }
    });
  if (!data.Carried.Misfit().empty())
  {
    this->Warn({ "The modes of the input belong to another shape: " + data.Carried.Misfit() +
                 ". The filter computes new modes." });
  }
  this->Warn(data.Result->warnings);
  state.GetProgress().Check(1.0);
}

void vtkSpectralSignatures::Solve(vtkDataSet* sources)
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  const gridfem::Progress progress = state.GetProgress();
  if (!data.Given.modes)
  {
    state.Prepare(progress.Part(0.0, 0.3));
  }
  data.Mesh = data.Given.modes ? data.Carried.Mesh() : state.mesh;
  if (sources && sources->GetNumberOfPoints() == 0)
  {
    vtkWarningMacro("The input Sources has no points. It adds no sources to the distances.");
  }
  state.Together([&]
    { data.Given.sources = gridfem::SourcePoints(*data.Mesh.triangles, data.SourceIds, sources); });
  this->FindValues();

  gridfem::SignatureSolver::Options options;
  options.equation = state.options;
  options.numberOfModes = this->NumberOfModes;
  options.numberOfScales = this->NumberOfScales;
  options.diffusionTime = this->DiffusionTime;
  options.filterType = static_cast<gridfem::ModeFilter>(this->FilterType);
  options.firstMode = this->FirstMode;
  options.lastMode = this->LastMode;
  data.Given.announce = [&](const std::string& cost, bool takesHours)
  { state.bridge.Announce(cost, takesHours); };
  data.Result =
    &data.Solver.Update(state, data.Given, options, { state.Threads(), progress.Part(0.0, 0.99) });
}

/// Copies of triangles have their own values on several ranks.
void vtkSpectralSignatures::FindValues()
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  if (state.IsShared())
  {
    data.Mesh = state.together.WithCopies(data.Mesh);
  }
  data.Value = {};
  if (this->FilterType == NoFilter)
  {
    return;
  }
  data.Value = state.FindOn(data.Mesh, 0, "Value Array");
  data.Given.values = state.Given(data.Value);
  if (data.Given.values)
  {
    data.Given.values.read = [&data](gridfem::NaNs nans)
    { return gridfem::ReadField(data.Value, data.Mesh, nans); };
  }
}

void vtkSpectralSignatures::Write(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const bool hasPoints = input && input->GetPoints();
  if (hasPoints)
  {
    output->ShallowCopy(input);
    if (!data.Carried.Misfit().empty())
    {
      gridfem::RemoveModes(output);
    }
  }
  const int precision = hasPoints ? gridfem::OutputPrecision(input->GetPoints()) : VTK_DOUBLE;
  this->WriteSignatures(precision, output); // field arrays are on all ranks
  this->WriteDistances(precision, output);
  if (hasPoints && this->FilterType != NoFilter)
  {
    this->WriteFiltered(input, output);
  }
  if (!data.Given.modes)
  {
    gridfem::AddFieldInt(output, "Converged", data.Result->isConverged ? 1 : 0);
  }
}

void vtkSpectralSignatures::WriteSignatures(int precision, vtkPolyData* output)
{
  const gridfem::SignatureSolver::Result& result = *this->Data->Result;
  AddSignature(
    output, "WaveKernelSignature", result.waveKernel, "E", result.waveBands.energies, precision);
  AddSignature(output, "HeatKernelSignature", result.heatKernel, "t", result.heatTimes, precision);
  const auto middle = static_cast<gridfem::Id>(result.heatTimes.size() / 2);
  output->GetPointData()->AddArray(
    gridfem::MakePointArray("Signature", result.heatKernel.col(middle), precision));
  output->GetPointData()->SetActiveScalars("Signature");
  gridfem::AddFieldNumbers(output, "HeatTimes", result.heatTimes);
  gridfem::AddFieldNumbers(output, "WaveEnergies", result.waveBands.energies);
}

void vtkSpectralSignatures::WriteDistances(int precision, vtkPolyData* output)
{
  const gridfem::SignatureSolver::Result& result = *this->Data->Result;
  if (!this->Data->Given.sources.empty())
  {
    AddNumbers(output, "DiffusionDistance", result.diffusionDistance, precision);
    AddNumbers(output, "BiharmonicDistance", result.biharmonicDistance, precision);
    output->GetPointData()->SetActiveScalars("BiharmonicDistance");
  }
}

void vtkSpectralSignatures::WriteFiltered(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::TriangleMesh& mesh = *data.Mesh.triangles;
  gridfem::MultiVector values = data.Result->filtered;
  vtkPointData* points = output->GetPointData();
  if (data.Value.array)
  {
    points->AddArray(
      gridfem::MakeSolution("Filtered", values, data.Value, data.Value.array->GetDataType()));
    points->SetActiveScalars("Filtered");
  }
  else
  {
    vtkDataArray* places = input->GetPoints()->GetData();
    gridfem::KeepUnsolved(places, values);
    points->AddArray(gridfem::MakePointArray("Filtered", values, places->GetDataType()));
    gridfem::MoveSurface(
      mesh, values, gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
}

void vtkSpectralSignatures::WriteTable(vtkTable* table)
{
  const gridfem::PointModes& modes = *this->Data->Result->modes;
  std::vector<int> number;
  std::vector<double> fingerprint;
  for (const double eigenvalue : modes.eigenvalues)
  {
    number.push_back(static_cast<int>(number.size()));
    fingerprint.push_back(modes.area * eigenvalue);
  }
  gridfem::AddColumn(table, "Mode", number);
  gridfem::AddColumn(table, "Eigenvalue", modes.eigenvalues);
  gridfem::AddColumn(table, "ShapeDNA", fingerprint);
}

void vtkSpectralSignatures::FreeStages()
{
  this->Superclass::FreeStages();
  Internals freed;
  freed.SourceIds = std::move(this->Data->SourceIds);
  *this->Data = std::move(freed);
}

void vtkSpectralSignatures::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfModes: " << this->NumberOfModes << "\n";
  os << indent << "NumberOfScales: " << this->NumberOfScales << "\n";
  os << indent << "SourcePointIds: " << this->GetNumberOfSourcePointIds() << "\n";
  os << indent << "DiffusionTime: " << this->DiffusionTime << "\n";
  os << indent << "FilterType: " << this->FilterType << "\n";
  os << indent << "FirstMode: " << this->FirstMode << "\n";
  os << indent << "LastMode: " << this->LastMode << "\n";
}
