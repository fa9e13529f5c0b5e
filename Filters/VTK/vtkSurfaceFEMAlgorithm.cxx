#include "vtkSurfaceFEMAlgorithm.h"

#include "Private/InputValidation.h"
#include "Private/SurfaceSolverState.h"

#include "Base/LargeMemory.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"

#include <new>

namespace
{

void EmptyOutputs(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    if (vtkDataObject* output = vtkDataObject::GetData(outputs, port))
    {
      output->Initialize();
    }
  }
}

} // namespace

vtkSurfaceFEMAlgorithm::vtkSurfaceFEMAlgorithm()
  : State(std::make_unique<gridfem::SurfaceSolverState>(this))
{
}

vtkSurfaceFEMAlgorithm::~vtkSurfaceFEMAlgorithm() = default;

int vtkSurfaceFEMAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkSurfaceFEMAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  gridfem::SurfaceOptions& options = this->State->options;
  options.space.depth = this->Depth;
  options.space.connectivityAware = this->ConnectivityAware;
  options.space.weldCoincidentPoints = this->WeldCoincidentPoints;
  options.space.threads = this->NumberOfThreads;
  options.hatFunctions = this->FunctionSpace == HatFunctions;
  options.quadratureDegree = this->QuadratureDegree;
  options.multigrid.cycle = static_cast<gridfem::CycleType>(this->Cycle);
  options.multigrid.smoother = static_cast<gridfem::SmootherType>(this->Smoother);
  options.multigrid.preSweeps = this->NumberOfSweeps;
  options.multigrid.postSweeps = this->NumberOfSweeps;
  options.multigrid.sweepsPerSynchronisation = this->SweepsPerSynchronisation;
  options.coarsestSize = this->CoarsestSize;
  options.normalStabilization = this->NormalStabilization;
  options.multigrid.threads = this->NumberOfThreads;
  options.solve.tolerance = this->Tolerance;
  options.solve.maximumIterations = this->MaximumIterations;
  options.parameterUnits = this->ParameterUnits;

  EmptyOutputs(outputs);
  this->State->bridge.Restart();
  const gridfem::MemoryReuse reuse;
  try
  {
    gridfem::RequireSingleProcess();
    if (!gridfem::IsEmpty(vtkPolyData::GetData(inputs[0])))
    {
      this->Compute(inputs, outputs);
    }
    return 1;
  }
  catch (const gridfem::Aborted&)
  {
    EmptyOutputs(outputs);
    this->AbortExecute = 0; // the request is served; left standing, it would empty the next run
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("Out of memory at Depth " << this->Depth << ": choose a smaller Depth.");
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  EmptyOutputs(outputs);
  return 0;
}

vtkIdType vtkSurfaceFEMAlgorithm::GetNumberOfRuns(int stage)
{
  return stage >= 0 && stage < NumberOfStages ? this->State->stages.Runs(stage) : 0;
}

double vtkSurfaceFEMAlgorithm::GetStageSeconds(int stage)
{
  return stage >= 0 && stage < NumberOfStages ? this->State->stages.Seconds(stage) : 0.0;
}

void vtkSurfaceFEMAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Depth: " << this->Depth << "\n";
  os << indent << "ConnectivityAware: " << this->ConnectivityAware << "\n";
  os << indent << "WeldCoincidentPoints: " << this->WeldCoincidentPoints << "\n";
  os << indent << "FunctionSpace: " << this->FunctionSpace << "\n";
  os << indent << "QuadratureDegree: " << this->QuadratureDegree << "\n";
  os << indent << "Cycle: " << this->Cycle << "\n";
  os << indent << "Smoother: " << this->Smoother << "\n";
  os << indent << "NumberOfSweeps: " << this->NumberOfSweeps << "\n";
  os << indent << "SweepsPerSynchronisation: " << this->SweepsPerSynchronisation << "\n";
  os << indent << "CoarsestSize: " << this->CoarsestSize << "\n";
  os << indent << "NormalStabilization: " << this->NormalStabilization << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "ParameterUnits: " << this->ParameterUnits << "\n";
}
