#include "vtkSpectralSignatures.h"

#include "Private/Allocation.h"
#include "Private/CanDistribute.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/ModeCheck.h"
#include "Private/ModeReader.h"
#include "Private/MovedMeshWriter.h"
#include "Private/Ranks.h"
#include "Private/SolverOutput.h"
#include "Private/SourcePoints.h"
#include "Private/SurfaceSolverState.h"
#include "Private/SurfaceSpectrum.h"

#include "Algebra/DividedRows.h"
#include "Base/Errors.h"
#include "Integrals/QuadratureRule.h"
#include "Problems/SolveWarnings.h"

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

bool HasPolygons(vtkPolyData* piece)
{
  return piece && piece->GetNumberOfPolys() + piece->GetNumberOfStrips() > 0;
}

/// Throws InvalidInput where all modes are constants and more exist: that says how many it takes.
void RequireNonConstant(const gridfem::Spectrum& spectrum)
{
  const auto modes = static_cast<gridfem::Index>(spectrum.eigenvalues.size());
  if (modes <= spectrum.numberOfConstants && !spectrum.truncated)
  {
    const std::string components = std::to_string(spectrum.numberOfConstants);
    throw gridfem::InvalidInput("All " + std::to_string(modes) +
                                " modes are constants: the surface has " + components +
                                " connected components, each with one. Signatures need a " +
                                "NumberOfModes above " + components + ".");
  }
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
  gridfem::InputArray Value;    // that is filtered; none: the coordinates
  gridfem::MultiVector Filtered;

  gridfem::MultiVector ReadValues(const gridfem::InputMesh& mesh) const;
  void Filter(const vtkSpectralSignatures& filter, const gridfem::MultiVector& values,
    const gridfem::DividedRows* divided);
};

vtkSpectralSignatures::vtkSpectralSignatures() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
  this->Tolerance = 1e-6;
  this->State->options.multigrid.cycle = gridfem::CycleType::V;
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
  RequireNonConstant(data.Solved.spectrum);
  gridfem::StageKey key;
  key.Add(true).Add(state.stages.Version(gridfem::SolveStage));
  if (key == data.ModesKey)
  {
    return;
  }
  data.Mesh = state.mesh;
  data.Modes.area = gridfem::SurfaceArea(*state.mesh.triangles);
  data.Modes.eigenvalues = data.Solved.eigenvalues;
  data.Modes.values = gridfem::EvaluateModes(state, data.Solved.spectrum, 0,
    data.Solved.NumberOfModes(), state.bridge.GetProgress().Part(0.95, 0.97));
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

void vtkSpectralSignatures::WriteSignatures(
  int precision, const gridfem::Progress& progress, vtkPolyData* output)
{
  const int threads = this->NumberOfThreads;
  const gridfem::PointModes& modes = this->Data->Modes;
  const std::vector<double> times = gridfem::HeatTimes(modes, this->NumberOfScales);
  const gridfem::WaveBands bands = gridfem::WaveEnergies(modes, this->NumberOfScales);
  AddSignature(output, "WaveKernelSignature",
    gridfem::WaveKernelSignature(modes, bands, { threads, progress.Part(0.0, 0.5) }), "E",
    bands.energies, precision);
  const gridfem::MultiVector heat =
    gridfem::HeatKernelSignature(modes, times, { threads, progress.Part(0.5, 1.0) });
  AddSignature(output, "HeatKernelSignature", heat, "t", times, precision);
  const auto middle = static_cast<gridfem::Id>(times.size() / 2);
  output->GetPointData()->AddArray(
    gridfem::MakePointArray("Signature", heat.col(middle), precision));
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

gridfem::MultiVector vtkSpectralSignatures::Internals::ReadValues(
  const gridfem::InputMesh& mesh) const
{
  if (this->Value.array && this->Value.association != gridfem::FieldAssociation::Points)
  {
    throw gridfem::InvalidInput("ValueArray '" + this->Value.name +
                                "' must be a point array. Cell Data to Point Data converts it.");
  }
  return this->Value.array ? gridfem::ReadField(this->Value, mesh).values
                           : gridfem::CoordinatesField(mesh).values;
}

/// The part of the values in the modes that pass.
/// @param divided  of ranks together, else null
void vtkSpectralSignatures::Internals::Filter(const vtkSpectralSignatures& filter,
  const gridfem::MultiVector& values, const gridfem::DividedRows* divided)
{
  const int threads = filter.NumberOfThreads;
  const gridfem::MultiVector shares =
    gridfem::ModeShares(*this->Mesh.triangles, this->Modes, values, threads, divided);
  const bool high = filter.FilterType == HighPass;
  const int first = filter.FilterType == BandPass ? filter.FirstMode : 0;
  const int last = high ? filter.FirstMode - 1 : filter.LastMode;
  this->Filtered = gridfem::SumOfModes(this->Modes, shares, first, last, threads);
  if (high)
  {
    this->Filtered = values - this->Filtered;
  }
}

/// @param isUsed  per point, by a polygon
void vtkSpectralSignatures::WriteFiltered(
  const std::vector<char>& isUsed, vtkPolyData* input, vtkPolyData* output)
{
  Internals& data = *this->Data;
  vtkDataArray* given = data.Value.array ? data.Value.array : input->GetPoints()->GetData();
  gridfem::KeepUnsolved(isUsed, given, data.Filtered);
  auto array = gridfem::MakePointArray("Filtered", data.Filtered, given->GetDataType());
  if (data.Value.array)
  {
    array->CopyComponentNames(data.Value.array);
  }
  output->GetPointData()->AddArray(array);
  output->GetPointData()->SetActiveScalars("Filtered");
  if (!data.Value.array)
  {
    gridfem::MoveSurface(*data.Mesh.triangles, data.Filtered,
      gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
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
              << gridfem::PlaceOf(this->State->options.choice.kind, this->Data->Solved.depth)
              << ".");
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
  progress.Check(0.97);
  const int precision = gridfem::OutputPrecision(input->GetPoints());
  output->ShallowCopy(input);
  if (!this->Data->Misfit.empty())
  {
    gridfem::RemoveModes(output);
  }
  this->WriteSignatures(precision, progress.Part(0.97, 0.99), output);
  this->WriteDistances(vtkDataSet::GetData(inputs[2]), precision, output);
  if (this->FilterType != NoFilter)
  {
    Internals& data = *this->Data;
    data.Value = gridfem::FindInputArray(this, 0, input, "ValueArray");
    data.Filter(*this, data.ReadValues(data.Mesh), nullptr);
    this->WriteFiltered(gridfem::UsedPoints(*data.Mesh.triangles), input, output);
  }
  this->WriteTable(vtkTable::GetData(outputs, 1));
  if (this->Data->WasSolved)
  {
    gridfem::AddFieldInt(output, "Converged", this->Data->Solved.spectrum.converged ? 1 : 0);
    this->Warn();
  }
  progress.Check(1.0);
}

bool vtkSpectralSignatures::ComputeTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const bool moves = this->FilterType != NoFilter && !gridfem::IsArrayChosen(this, 0);
  if (!gridfem::CanDistribute(this, inputs, moves || !this->Data->SourceIds.empty()))
  {
    return false;
  }
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  this->State->RunTogether(
    [&](const gridfem::Progress& progress)
    {
      this->UpdateModesTogether(inputs, progress.Part(0.0, 0.95));
      if (this->FilterType != NoFilter)
      {
        this->FilterTogether(piece);
      }
      this->State->together.Together([&] { this->WriteDistributed(piece, outputs); });
      progress.Check(1.0);
    });
  return true;
}

void vtkSpectralSignatures::UpdateModesTogether(
  vtkInformationVector** inputs, const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  const bool areCarried =
    !this->State->together.Any(HasPolygons(piece) && !gridfem::CarriesModes(piece));
  if (!areCarried)
  {
    data.Misfit.clear();
    data.ForeignKey = {};
  }
  data.WasSolved = !areCarried || !this->TakeModesTogether(piece);
  if (data.WasSolved)
  {
    this->ComputeModesTogether(inputs, progress);
  }
}

/// As TakeModes.
bool vtkSpectralSignatures::TakeModesTogether(vtkPolyData* piece)
{
  Internals& data = *this->Data;
  gridfem::DistributedSurface& together = this->State->together;
  gridfem::StageKey key;
  key.Add(std::string("together"));
  if (HasPolygons(piece))
  {
    gridfem::AddMesh(key, piece);
    gridfem::AddModeArrays(key, piece);
  }
  if (!together.Any(!(key == data.ModesKey)))
  {
    return true;
  }
  if (!together.Any(!(key == data.ForeignKey)))
  {
    return false;
  }
  data.ModesKey = {};
  data.ForeignKey = {};
  data.Modes = {};
  data.Mesh = together.ReadPieces(piece, this->NumberOfThreads);
  together.Together(
    [&]
    {
      if (HasPolygons(piece))
      {
        data.Modes = gridfem::ReadModes(piece, together.WithCopies(data.Mesh));
      }
    });
  together.Agree(data.Modes.eigenvalues);
  data.Modes.area = together.Area();
  if (!HasPolygons(piece))
  {
    data.Modes.values.setZero(static_cast<gridfem::Id>(data.Mesh.triangles->points.size()),
      static_cast<gridfem::Id>(data.Modes.eigenvalues.size()));
  }
  data.Misfit = gridfem::FindMisfit(
    *data.Mesh.triangles, data.Modes, this->NumberOfThreads, &together.Numbers());
  (data.Misfit.empty() ? data.ModesKey : data.ForeignKey) = key;
  return data.Misfit.empty();
}

void vtkSpectralSignatures::ComputeModesTogether(
  vtkInformationVector** inputs, const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::SpectrumRequest request;
  request.numberOfModes = this->NumberOfModes;
  request.completeMultiplets = true;
  this->State->options.functionsPerPoint = gridfem::EnoughToEstimate;
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  state.UpdateTogether(piece, vtkPolyData::GetData(inputs[1]));
  data.Solved.UpdateTogether(state, request, progress.Part(0.3, 1.0));
  RequireNonConstant(data.Solved.spectrum);
  data.ModesKey = {};
  data.Mesh = state.mesh;
  data.Modes.area = state.together.Area();
  data.Modes.eigenvalues = data.Solved.eigenvalues;
  data.Modes.values = data.Solved.atPoints;
}

void vtkSpectralSignatures::FilterTogether(vtkPolyData* piece)
{
  Internals& data = *this->Data;
  gridfem::DistributedSurface& together = this->State->together;
  gridfem::MultiVector values;
  const gridfem::InputMesh whole =
    together.WithCopies(data.Mesh); // copies have values of their own
  data.Value = together.Find(this, 0, piece, whole, "ValueArray");
  together.Together([&] { values = data.ReadValues(whole); });
  data.Filter(*this, values, &together.Numbers());
}

/// Port 0 is the rank's own piece; the table is on the first rank.
void vtkSpectralSignatures::WriteDistributed(vtkPolyData* piece, vtkInformationVector* outputs)
{
  const Internals& data = *this->Data;
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const bool hasPoints = piece && piece->GetPoints();
  if (hasPoints)
  {
    output->ShallowCopy(piece);
    if (!data.Misfit.empty())
    {
      gridfem::RemoveModes(output);
    }
  }
  this->WriteSignatures( // field arrays are on all ranks
    hasPoints ? gridfem::OutputPrecision(piece->GetPoints()) : VTK_DOUBLE, {}, output);
  if (hasPoints && this->FilterType != NoFilter)
  {
    const gridfem::InputMesh whole = this->State->together.WithCopies(data.Mesh);
    this->WriteFiltered(gridfem::UsedPoints(*whole.triangles), piece, output);
  }
  gridfem::AddFieldInt(output, gridfem::DistributedName, 1);
  if (data.WasSolved)
  {
    gridfem::AddFieldInt(output, "UsedDepth", this->State->together.Depth());
    gridfem::AddFieldInt(output, "Converged", data.Solved.spectrum.converged ? 1 : 0);
  }
  if (gridfem::Ranks().IsFirst())
  {
    this->WriteTable(vtkTable::GetData(outputs, 1));
    if (data.WasSolved)
    {
      this->Warn();
    }
  }
}

void vtkSpectralSignatures::FreeStages()
{
  this->Superclass::FreeStages();
  Internals& data = *this->Data;
  data.Solved.spectrum = {};
  data.Solved.atPoints = {};
  data.Filtered = {};
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
  os << indent << "SourcePointIds: " << this->GetNumberOfSourcePointIds() << "\n";
  os << indent << "DiffusionTime: " << this->DiffusionTime << "\n";
  os << indent << "FilterType: " << this->FilterType << "\n";
  os << indent << "FirstMode: " << this->FirstMode << "\n";
  os << indent << "LastMode: " << this->LastMode << "\n";
}
