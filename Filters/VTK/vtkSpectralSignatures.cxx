#include "vtkSpectralSignatures.h"

#include "Private/Allocation.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/ModeCheck.h"
#include "Private/ModeReader.h"
#include "Private/MovedMeshWriter.h"
#include "Private/SolverOutput.h"
#include "Private/SourcePoints.h"
#include "Private/SurfaceSolverState.h"
#include "Private/SurfaceSpectrum.h"

#include "Base/Errors.h"
#include "Integrals/QuadratureRule.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
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

void AddFieldNumbers(vtkPolyData* output, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  gridfem::SetTuples(array, static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  output->GetFieldData()->AddArray(array);
}

/// A point array whose components are named by their scales.
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
  gridfem::SurfaceSpectrum Solved;
  bool WasSolved = false; // else read from the input
  gridfem::InputMesh Mesh;
  gridfem::PointModes Modes;
  gridfem::StageKey ModesKey;   // what Modes were made from
  gridfem::StageKey ForeignKey; // the modes of the input that were found to be of another shape
  std::string Misfit;           // why
};

vtkSpectralSignatures::vtkSpectralSignatures() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
  this->Tolerance = 1e-6;
  this->Cycle = VCycle;
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

/// The modes of the filter's own spectrum at the points.
void vtkSpectralSignatures::ComputeModes(vtkPolyData* input, vtkPolyData* basis)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::SpectrumRequest request;
  request.numberOfModes = this->NumberOfModes;
  request.completeMultiplets = true;
  data.Solved.Update(state, input, basis, request);
  gridfem::StageKey key;
  key.Add(true).Add(state.stages.Version(gridfem::SolveStage));
  if (key == data.ModesKey)
  {
    return;
  }
  data.Mesh = state.mesh;
  data.Modes.area = gridfem::SurfaceArea(*state.mesh.triangles);
  data.Modes.eigenvalues = data.Solved.eigenvalues;
  data.Modes.values = gridfem::EvaluateModes(
    state, data.Solved.spectrum, 0, data.Solved.NumberOfModes(), this->NumberOfThreads);
  data.ModesKey = key;
}

void vtkSpectralSignatures::UpdateModes(vtkPolyData* input, vtkPolyData* basis)
{
  if (!gridfem::CarriesModes(input))
  {
    this->Data->Misfit.clear();
    this->Data->ForeignKey = {};
  }
  this->Data->WasSolved = !gridfem::CarriesModes(input) || !this->TakeModes(input);
  if (this->Data->WasSolved)
  {
    this->ComputeModes(input, basis);
  }
}

/// Takes the modes of the input. False when they are those of another shape.
bool vtkSpectralSignatures::TakeModes(vtkPolyData* input)
{
  Internals& data = *this->Data;
  gridfem::StageKey key;
  key.Add(false);
  gridfem::AddMesh(key, input);
  gridfem::AddModeArrays(key, input);
  if (key == data.ModesKey || key == data.ForeignKey)
  {
    return key == data.ModesKey;
  }
  data.ModesKey = {};
  data.ForeignKey = {};
  data.Mesh = gridfem::ReadInputMesh(input, this->NumberOfThreads);
  gridfem::RequireSurface(*data.Mesh.triangles);
  data.Modes = gridfem::ReadModes(input, data.Mesh);
  data.Misfit = gridfem::FindMisfit(*data.Mesh.triangles, data.Modes, this->NumberOfThreads);
  (data.Misfit.empty() ? data.ModesKey : data.ForeignKey) = key;
  return data.Misfit.empty();
}

void vtkSpectralSignatures::WriteSignatures(int precision, vtkPolyData* output)
{
  const gridfem::PointModes& modes = this->Data->Modes;
  const std::vector<double> times = gridfem::HeatTimes(modes, this->NumberOfScales);
  const gridfem::WaveBands bands = gridfem::WaveEnergies(modes, this->NumberOfScales);
  AddSignature(output, "WaveKernelSignature",
    gridfem::WaveKernelSignature(modes, bands, this->NumberOfThreads), "E", bands.energies,
    precision);
  const gridfem::MultiVector heat =
    gridfem::HeatKernelSignature(modes, times, this->NumberOfThreads);
  AddSignature(output, "HeatKernelSignature", heat, "t", times, precision);
  const auto scales = static_cast<gridfem::Id>(times.size());
  const gridfem::Id shown = this->ShownScale < 0 ? scales / 2 : this->ShownScale;
  output->GetPointData()->AddArray(
    gridfem::MakePointArray("Signature", heat.col(std::min(shown, scales - 1)), precision));
  output->GetPointData()->SetActiveScalars("Signature");
  AddFieldNumbers(output, "HeatTimes", times);
  AddFieldNumbers(output, "WaveEnergies", bands.energies);
}

/// DiffusionTime in squared world lengths.
double vtkSpectralSignatures::WorldDiffusionTime()
{
  const gridfem::TriangleMesh& mesh = *this->Data->Mesh.triangles;
  double length2 = 1.0;
  if (this->ParameterUnits == UnitArea)
  {
    length2 = this->Data->Modes.area;
  }
  else if (this->ParameterUnits == UnitCube)
  {
    const gridfem::Grid grid =
      gridfem::EmbedInGrid(mesh.points, gridfem::UsedPoints(mesh), gridfem::MinimumDepth);
    length2 = std::pow(grid.spacing * grid.CellsPerSide(), 2);
  }
  return this->DiffusionTime * length2;
}

void vtkSpectralSignatures::WriteDistances(vtkDataSet* sources, int precision, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  if (sources && sources->GetNumberOfPoints() == 0)
  {
    vtkWarningMacro("The input Sources has no points, so no distance starts there.");
  }
  const std::vector<gridfem::Id> points =
    gridfem::SourcePoints(*data.Mesh.triangles, data.SourceIds, sources);
  if (points.empty())
  {
    return;
  }
  AddNumbers(output, "DiffusionDistance",
    gridfem::DiffusionDistance(
      data.Modes, points, this->WorldDiffusionTime(), this->NumberOfThreads),
    precision);
  AddNumbers(output, "BiharmonicDistance",
    gridfem::BiharmonicDistance(data.Modes, points, this->NumberOfThreads), precision);
  output->GetPointData()->SetActiveScalars("BiharmonicDistance");
}

void vtkSpectralSignatures::WriteFiltered(vtkPolyData* input, vtkPolyData* output)
{
  Internals& data = *this->Data;
  const gridfem::TriangleMesh& mesh = *data.Mesh.triangles;
  const gridfem::InputArray value = gridfem::FindInputArray(this, 0, input, "ValueArray");
  if (value.array && value.association != gridfem::FieldAssociation::Points)
  {
    throw gridfem::InvalidInput("ValueArray '" + value.name +
                                "' must be a point array. Cell Data to Point Data converts it.");
  }
  const gridfem::MultiVector values = value.array ? gridfem::ReadField(value, data.Mesh).values
                                                  : gridfem::CoordinatesField(data.Mesh).values;
  const gridfem::MultiVector shares =
    gridfem::ModeShares(mesh, data.Modes, values, this->NumberOfThreads);
  const bool high = this->FilterType == HighPass;
  const int first = this->FilterType == BandPass ? this->FirstMode : 0;
  const int last = high ? this->FirstMode - 1 : this->LastMode;
  gridfem::MultiVector filtered =
    gridfem::SumOfModes(data.Modes, shares, first, last, this->NumberOfThreads);
  if (high)
  {
    filtered = values - filtered;
  }
  vtkDataArray* given = value.array ? value.array : input->GetPoints()->GetData();
  gridfem::KeepUnsolved(gridfem::UsedPoints(mesh), given, filtered);
  auto array = gridfem::MakePointArray("Filtered", filtered, given->GetDataType());
  if (value.array)
  {
    array->CopyComponentNames(value.array);
  }
  output->GetPointData()->AddArray(array);
  output->GetPointData()->SetActiveScalars("Filtered");
  if (!value.array && this->MovePoints)
  {
    gridfem::MoveSurface(
      mesh, filtered, gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
}

void vtkSpectralSignatures::WriteTable(vtkTable* table)
{
  const gridfem::PointModes& modes = this->Data->Modes;
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

void vtkSpectralSignatures::Warn()
{
  const gridfem::Spectrum& spectrum = this->Data->Solved.spectrum;
  if (!this->Data->Misfit.empty())
  {
    vtkWarningMacro("The modes of the input are those of another shape: "
                    << this->Data->Misfit << ". They are left out, and computed anew.");
  }
  if (spectrum.truncated)
  {
    vtkWarningMacro(
      "Only " << this->Data->Solved.NumberOfModes() << " of the " << this->NumberOfModes
              << " modes exist "
              << (this->FunctionSpace == HatFunctions ? "with the hat functions of this mesh."
                                                      : "at this Depth."));
  }
  if (!spectrum.converged)
  {
    vtkWarningMacro("Not converged after "
                    << spectrum.iterations << " iterations: " << spectrum.numberOfConverged
                    << " of " << this->Data->Solved.NumberOfModes()
                    << " modes reached the tolerance, the largest residual is "
                    << this->Data->Solved.LargestResidual() << ". The result is kept.");
  }
}

void vtkSpectralSignatures::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const gridfem::Progress progress = this->State->bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::RequireAtLeast("DiffusionTime", this->DiffusionTime, 0.0);
  progress.Check(0.0);
  this->UpdateModes(input, vtkPolyData::GetData(inputs[1]));
  progress.Check(0.95);
  const int precision = gridfem::OutputPrecision(input->GetPoints());
  output->ShallowCopy(input);
  if (!this->Data->Misfit.empty())
  {
    gridfem::RemoveModes(output);
  }
  this->WriteSignatures(precision, output);
  this->WriteDistances(vtkDataSet::GetData(inputs[2]), precision, output);
  if (this->FilterType != NoFilter)
  {
    this->WriteFiltered(input, output);
  }
  this->WriteTable(vtkTable::GetData(outputs, 1));
  if (this->Data->WasSolved)
  {
    gridfem::AddFieldInt(output, "Converged", this->Data->Solved.spectrum.converged ? 1 : 0);
    this->Warn();
  }
  progress.Check(1.0);
}

void vtkSpectralSignatures::FreeStages()
{
  this->Superclass::FreeStages();
  Internals& data = *this->Data;
  data.Solved.spectrum = {};
  data.Mesh = {};
  data.Modes = {};
  data.ModesKey = {};
  data.ForeignKey = {};
}

void vtkSpectralSignatures::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfModes: " << this->NumberOfModes << "\n";
  os << indent << "NumberOfScales: " << this->NumberOfScales << "\n";
  os << indent << "ShownScale: " << this->ShownScale << "\n";
  os << indent << "SourcePointIds: " << this->GetNumberOfSourcePointIds() << "\n";
  os << indent << "DiffusionTime: " << this->DiffusionTime << "\n";
  os << indent << "FilterType: " << this->FilterType << "\n";
  os << indent << "FirstMode: " << this->FirstMode << "\n";
  os << indent << "LastMode: " << this->LastMode << "\n";
  os << indent << "MovePoints: " << this->MovePoints << "\n";
}
