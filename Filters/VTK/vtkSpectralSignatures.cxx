#include "vtkSpectralSignatures.h"

#include "Input/CarriedModes.h"
#include "Input/NearestPoints.h"
#include "Input/PropertyList.h"
#include "Output/ClippedMeshWriter.h"
#include "Output/MovedMeshWriter.h"
#include "Output/SignatureOutput.h"
#include "Output/SolverOutput.h"
#include "Pieces/CanDistribute.h"
#include "Pieces/Ranks.h"
#include "Pipeline/FilterState.h"

#include "Base/SortEachOnce.h"
#include "Distance/NearestSource.h"
#include "Integrals/QuadratureRule.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkSpectralSignatures);

namespace
{

/// Returns the given points, and the mesh points nearest to the points and lines of `places` (may
/// be null), ascending, every point once.
/// @param warnings  gets a sentence if places are far from the surface
std::vector<gridfem::Id> SourcePoints(const gridfem::TriangleMesh& mesh,
  const std::vector<gridfem::Id>& ids, vtkDataSet* places, std::vector<std::string>& warnings)
{
  gridfem::RequireUsed("Source Point Ids", ids, mesh);
  std::vector<gridfem::Id> sources = ids;
  if (places && places->GetNumberOfPoints() > 0)
  {
    const std::vector<gridfem::Id> nearest =
      gridfem::NearestPointsAlongLines(mesh, places, "Sources", warnings);
    sources.insert(sources.end(), nearest.begin(), nearest.end());
  }
  gridfem::SortEachOnce(sources);
  return sources;
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

int vtkSpectralSignatures::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

void vtkSpectralSignatures::AddSourcePointId(vtkIdType id)
{
  gridfem::AddToList(this->Data->SourceIds, id, this);
}

void vtkSpectralSignatures::ClearSourcePointIds()
{
  gridfem::ClearList(this->Data->SourceIds, this);
}

vtkIdType vtkSpectralSignatures::GetNumberOfSourcePointIds()
{
  return static_cast<vtkIdType>(this->Data->SourceIds.size());
}

vtkIdType vtkSpectralSignatures::GetSourcePointId(vtkIdType index)
{
  return gridfem::IdOfList(this->Data->SourceIds, index);
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
  gridfem::FilterState& state = *this->State;
  Internals& data = *this->Data;
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  state.options.functionsPerPoint = gridfem::SignatureSolver::SurfaceDefaults().functionsPerPoint;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  data.Given = {};
  data.Given.modes = data.Carried.Update(surface, input);
  this->Solve(vtkDataSet::GetData(inputs[2]));
  surface.Together(
    [&]
    {
      this->Write(input, vtkPolyData::GetData(outputs, 0));
      if (gridfem::Ranks().IsFirst())
      {
        gridfem::WriteModeTable(*data.Result, vtkTable::GetData(outputs, 1));
      }
    });
  this->Warn(gridfem::NotEmpty({ data.Carried.WarningOfShape("input") }));
  this->Warn(data.Result->warnings);
  state.GetProgress().Check(1.0);
}

void vtkSpectralSignatures::Solve(vtkDataSet* sources)
{
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Surface();
  Internals& data = *this->Data;
  const gridfem::Progress progress = state.GetProgress();
  if (!data.Given.modes)
  {
    surface.Prepare(progress.Part(0.0, 0.3));
  }
  data.Mesh = data.Given.modes ? data.Carried.Mesh() : surface.Triangles();
  if (sources && sources->GetNumberOfPoints() == 0)
  {
    vtkWarningMacro("The input Sources has no points. It adds no sources to the distances.");
  }
  std::vector<std::string> farSources;
  surface.Together(
    [&] {
      data.Given.sources = SourcePoints(*data.Mesh.triangles, data.SourceIds, sources, farSources);
    });
  this->Warn(farSources);
  this->FindValues();

  gridfem::SignatureSolver::Options options;
  options.equation = state.options;
  options.numberOfModes = this->NumberOfModes;
  options.numberOfScales = this->NumberOfScales;
  options.diffusionTime = this->DiffusionTime;
  options.filterType = static_cast<gridfem::ModeFilter>(this->FilterType);
  options.firstMode = this->FirstMode;
  options.lastMode = this->LastMode;
  options.numberOfSurrogates = this->NumberOfSurrogates;
  options.seed = this->Seed;
  data.Given.announce = [&](const std::string& cost, bool takesHours)
  { state.bridge.Announce(cost, takesHours); };
  data.Result = &data.Solver.Update(
    surface, data.Given, options, { surface.Threads(), progress.Part(0.0, 0.99) });
}

/// Copies of triangles have their own values on several ranks.
void vtkSpectralSignatures::FindValues()
{
  gridfem::InputSurface& surface = this->State->Surface();
  Internals& data = *this->Data;
  data.Mesh = surface.WithCopies(data.Mesh);
  data.Value = {};
  if (this->FilterType == NoFilter)
  {
    return;
  }
  data.Value = surface.FindOn(data.Mesh, 0, "Value Array");
  if (this->FilterType == Surrogates && !data.Value.array)
  {
    throw gridfem::MissingChoice("Choose a Value Array that Surrogates are made of.");
  }
  data.Given.values = surface.Given(data.Value);
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
    data.Carried.RemoveMisfit(output);
  }
  const int precision = hasPoints ? gridfem::OutputPrecision(input->GetPoints()) : VTK_DOUBLE;
  gridfem::WriteSignatures(*data.Result, precision, output); // field arrays are on all ranks
  if (!data.Given.sources.empty())
  {
    gridfem::WriteModeDistances(*data.Result, precision, output);
  }
  if (hasPoints && this->FilterType == Surrogates)
  {
    gridfem::WriteSurrogates(*data.Result, data.Value.array, output);
  }
  else if (hasPoints && this->FilterType != NoFilter)
  {
    this->WriteFiltered(input, output);
  }
  if (!data.Given.modes)
  {
    gridfem::AddFieldInt(output, "Converged", data.Result->isConverged ? 1 : 0);
    gridfem::AddDevice(data.Result->where, output);
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
  os << indent << "NumberOfSurrogates: " << this->NumberOfSurrogates << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
