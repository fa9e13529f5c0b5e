#include "vtkSurfaceFEMAlgorithm.h"

#include "Input/Domain.h"
#include "Input/InputBlocks.h"
#include "Input/InputValidation.h"
#include "Input/SelectedPoints.h"
#include "Input/SurfaceInput.h"
#include "Output/BlockTables.h"
#include "Output/ResultNames.h"
#include "Output/SolverOutput.h"
#include "Pieces/GatheredRanks.h"
#include "Pieces/JoinedBlocks.h"
#include "Pieces/Ranks.h"
#include "Pipeline/FailureDump.h"
#include "Pipeline/FilterState.h"
#include "Pipeline/PipelineTime.h"
#include "Pipeline/ServedAbort.h"

#include "Base/LargeMemory.h"

#include "vtkCallbackCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"

#include <algorithm>
#include <new>
#include <string>

namespace
{

/// @param depth  AutomaticDepth: there is no grid, or not yet
std::string OutOfMemory(int depth)
{
  return depth == gridfem::AutomaticDepth
           ? "Out of memory: use a mesh with fewer polygons."
           : "Out of memory at Depth " + std::to_string(depth) + ": choose a smaller Depth.";
}

/// Notes in the field data how many triangles count with another one. Collective.
void NoteCopies(const gridfem::InputSurface& surface, vtkPolyData* output)
{
  const gridfem::Id copied = surface.CopiedTriangles();
  if (copied > 0)
  {
    gridfem::AddFieldInt(output, "CopiedTriangles", static_cast<int>(copied));
  }
}

} // namespace

vtkSurfaceFEMAlgorithm::vtkSurfaceFEMAlgorithm()
  : State(std::make_unique<gridfem::FilterState>(this)),
    Surface(std::make_unique<gridfem::SurfaceInput>()), Inside(std::make_unique<gridfem::Domain>()),
    Time(std::make_unique<gridfem::InputTime>()), Dump(std::make_unique<gridfem::FailureDump>()),
    Ranked(std::make_unique<gridfem::GatheredRanks>()),
    Blocks(std::make_unique<gridfem::InputBlocks>()),
    Joined(std::make_unique<gridfem::JoinedBlocks>()),
    Tables(std::make_unique<gridfem::BlockTables>())
{
  // Ranks without a block would leave the others waiting. All ranks therefore get the same blocks.
  vtkNew<vtkCallbackCommand> begin;
  begin->SetClientData(this);
  begin->SetCallback([](vtkObject*, unsigned long, void* self, void*)
    { static_cast<vtkSurfaceFEMAlgorithm*>(self)->BeginBlocks(); });
  this->AddObserver(vtkCommand::StartEvent, begin);
  vtkNew<vtkCallbackCommand> end;
  end->SetClientData(this);
  end->SetCallback([](vtkObject*, unsigned long, void* self, void*)
    { static_cast<vtkSurfaceFEMAlgorithm*>(self)->EndBlocks(); });
  this->AddObserver(vtkCommand::EndEvent, end);
}

vtkSurfaceFEMAlgorithm::~vtkSurfaceFEMAlgorithm()
{
  this->Selection.reset();
  this->State.reset();
  gridfem::ReturnFreedMemory();
}

int vtkSurfaceFEMAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == this->SelectionPort ? "vtkSelection"
                                                      : port == 1                 ? "vtkPolyData"
                                                                                  : "vtkDataSet");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

void vtkSurfaceFEMAlgorithm::SetSelectionPort(int port)
{
  this->SetNumberOfInputPorts(port + 1);
  this->SelectionPort = port;
  this->Selection = std::make_unique<gridfem::SelectedPoints>(this);
}

void vtkSurfaceFEMAlgorithm::ReadSelection(vtkInformationVector** inputs)
{
  this->State->Surface().Select(
    *this->Selection, vtkSelection::GetData(inputs[this->SelectionPort]), this->JoinedInput());
}

void vtkSurfaceFEMAlgorithm::SetBasisConnection(vtkAlgorithmOutput* output)
{
  const bool isForSelection = this->SelectionPort == 1;
  this->SetInputConnection(isForSelection ? -1 : 1, output); // VTK refuses a port below 0
}

void vtkSurfaceFEMAlgorithm::SetSelectionConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(this->SelectionPort, output);
}

std::vector<double> vtkSurfaceFEMAlgorithm::OwnTimeSteps()
{
  return {};
}

std::vector<double> vtkSurfaceFEMAlgorithm::TimeSteps()
{
  return this->Ranked->StepsOf(this->OwnTimeSteps());
}

/// Replaces the input's time steps, which the pipeline has already passed on.
int vtkSurfaceFEMAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const std::vector<double> steps = this->TimeSteps();
  if (!steps.empty())
  {
    gridfem::SetTimeSteps(steps, outputs);
  }
  return 1;
}

int vtkSurfaceFEMAlgorithm::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (this->OwnTimeSteps().empty())
  {
    this->Time->Follow(inputs[0]);
  }
  else
  {
    this->Time->Fix(inputs, this->GetNumberOfInputPorts());
  }
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

int vtkSurfaceFEMAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (gridfem::IsStillAborted(this))
  {
    this->FinishAbort(outputs);
    return 1;
  }
  gridfem::FilterOptions& options = this->State->options;
  options.space.depth = this->Depth == 1 ? 2 : this->Depth; // a slider passes 1 on its way from 0
  options.space.connectivityAware = this->ConnectivityAware;
  options.space.weldCoincidentPoints = this->WeldCoincidentPoints;
  options.space.threads = this->NumberOfThreads;
  options.choice.kind = static_cast<gridfem::FunctionKind>(this->FunctionSpace);
  options.choice.quadratureDegree = this->QuadratureDegree;
  options.choice.normalStabilization = this->NormalStabilization;
  options.multigrid.threads = this->NumberOfThreads;
  options.multigrid.device = static_cast<gridfem::DeviceChoice>(this->Device);
  options.solve.tolerance = this->Tolerance;
  options.solve.maximumIterations = this->MaximumIterations;
  options.accuracy = this->WantedAccuracy();
  options.parameterUnits = static_cast<gridfem::ParameterUnits>(this->ParameterUnits);
  this->State->Read(nullptr, nullptr); // Compute sets it; the last input may be gone

  gridfem::EmptyOutputs(outputs);
  this->Dump->Print();
  this->State->bridge.Restart();
  const int result = this->RunCompute(inputs, outputs);
  if (!this->KeepsStages() || this->HasNoPoints(inputs))
  {
    this->FreeStages();
    this->Surface->Free(); // the run itself needs both to its end
    this->Inside->Free();
    gridfem::ReturnFreedMemory();
  }
  return result;
}

bool vtkSurfaceFEMAlgorithm::HasNoPoints(vtkInformationVector** inputs) const
{
  if (gridfem::Ranks::AreSeveral())
  {
    return this->Ranked->IsEmpty();
  }
  return this->JoinedInput() ? this->Joined->IsEmpty()
                             : gridfem::IsEmpty(vtkDataSet::GetData(inputs[0]));
}

/// Returns the result of RequestData.
int vtkSurfaceFEMAlgorithm::RunCompute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const gridfem::MemoryReuse reuse;
  try
  {
    if (this->JoinedInput())
    {
      this->ComputeBlock(inputs, outputs);
    }
    else if (gridfem::Ranks::AreSeveral())
    {
      this->ComputeOnRanks(inputs, outputs);
    }
    else if (!gridfem::IsEmpty(vtkDataSet::GetData(inputs[0])))
    {
      this->ComputeAlone(inputs, outputs);
    }
    return 1;
  }
  catch (const gridfem::FailedElsewhere&)
  {
    // The first rank reports the error.
  }
  catch (const gridfem::Aborted&)
  {
    this->FinishAbort(outputs);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    this->FreeStages(); // the next run and the message may need the memory
    vtkErrorMacro(<< OutOfMemory(this->State->Surface().UsedOptions().space.depth));
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  gridfem::EmptyOutputs(outputs);
  this->SetErrorCode(vtkErrorCode::UnknownError);
  this->Dump->Silence(this->GetExecutive());
  return 0;
}

/// Returns the blocks that the surface is joined from. Null if it is not joined.
const gridfem::JoinedBlocks* vtkSurfaceFEMAlgorithm::JoinedInput() const
{
  return this->BlocksAsOne && this->Blocks->Whole() ? this->Joined.get() : nullptr;
}

/// Calls Compute within the domain, and adds the field array that all outputs have: the depth of
/// the grid, if there is one.
void vtkSurfaceFEMAlgorithm::ComputeSurface(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->UseSurface(false);
  this->ComputeInside(inputs, outputs);
  this->WriteDepth(outputs);
}

bool vtkSurfaceFEMAlgorithm::NoteRange(
  const char* property, double value, double least, double most)
{
  return this->State->NoteRange(property, value, least, most);
}

/// Calls Compute on the inputs restricted to the domain. The outputs are not. Collective. Throws
/// InvalidInput if a property was given a value out of its range.
void vtkSurfaceFEMAlgorithm::ComputeInside(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->State->RequireRanges();
  vtkInformationVector** inside = inputs;
  this->State->Surface().Together(
    [&] { inside = this->Inside->Apply(this, inputs, this->GetNumberOfInputPorts()); });
  this->Compute(inside, outputs);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    gridfem::RemoveGivenReports(
      vtkDataObject::GetData(inputs[0]), vtkDataObject::GetData(outputs, port));
  }
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  this->Inside->PutBack(output);
  NoteCopies(this->State->Surface(), output);
  gridfem::NameResults(vtkPolyData::GetData(inputs[0]), this->ResultPrefix, output);
}

/// Frees the stages of the other surface.
/// @param isPiece  takes this rank's piece instead of the whole surface
void vtkSurfaceFEMAlgorithm::UseSurface(bool isPiece)
{
  if (this->State->UsesPiece() != isPiece)
  {
    this->FreeStages();
  }
  if (!isPiece)
  {
    this->State->UseWhole();
  }
}

void vtkSurfaceFEMAlgorithm::WriteDepth(vtkInformationVector* outputs)
{
  const int depth = this->State->Surface().UsedDepth();
  if (depth != gridfem::AutomaticDepth)
  {
    gridfem::AddFieldInt(vtkPolyData::GetData(outputs), "UsedDepth", depth);
  }
}

bool vtkSurfaceFEMAlgorithm::NeedsWholeSurface()
{
  return true;
}

void vtkSurfaceFEMAlgorithm::Warn(const std::vector<std::string>& warnings)
{
  if (gridfem::Ranks().IsFirst())
  {
    for (const std::string& warning : warnings)
    {
      vtkWarningMacro(<< warning);
    }
  }
}

bool vtkSurfaceFEMAlgorithm::KeepsStages()
{
  return !this->GetReleaseDataFlag();
}

void vtkSurfaceFEMAlgorithm::FreeStages()
{
  this->State->Free();
  this->Ranked->Free();
  if (this->Selection)
  {
    this->Selection->Free();
  }
}

void vtkSurfaceFEMAlgorithm::FinishAbort(vtkInformationVector* outputs)
{
  gridfem::EmptyOutputs(outputs);
  this->IsBlockAborted = true;
  gridfem::ServeAbort(this);
}

vtkIdType vtkSurfaceFEMAlgorithm::GetNumberOfRuns(const char* stage)
{
  return stage ? this->State->stages.Runs(stage) : 0;
}

double vtkSurfaceFEMAlgorithm::GetStageSeconds(const char* stage)
{
  return stage ? this->State->stages.Seconds(stage) : 0.0;
}

void vtkSurfaceFEMAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Depth: " << this->Depth << "\n";
  os << indent << "ConnectivityAware: " << this->ConnectivityAware << "\n";
  os << indent << "WeldCoincidentPoints: " << this->WeldCoincidentPoints << "\n";
  os << indent << "FunctionSpace: " << this->FunctionSpace << "\n";
  os << indent << "QuadratureDegree: " << this->QuadratureDegree << "\n";
  os << indent << "NormalStabilization: " << this->NormalStabilization << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "Device: " << this->Device << "\n";
  os << indent << "ParameterUnits: " << this->ParameterUnits << "\n";
  os << indent << "BlocksAsOne: " << this->BlocksAsOne << "\n";
  os << indent << "ResultPrefix: " << this->ResultPrefix << "\n";
}
