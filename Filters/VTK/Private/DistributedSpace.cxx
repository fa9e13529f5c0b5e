#include "CanDistribute.h"

#include "ClippedArrays.h"
#include "Ranks.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"

#include <string>

bool gridfem::IsArrayChosen(vtkAlgorithm* algorithm, int index)
{
  const char* name = algorithm->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_NAME());
  return name && *name && std::string(name) != "None";
}

bool gridfem::HasBasisOrGhosts(vtkPolyData* piece)
{
  return piece && (CarriesBasis(piece) ||
                    piece->GetCellData()->HasArray(vtkDataSetAttributes::GhostArrayName()));
}

#if GRIDFEM_HAS_PARALLEL

#include "DistributedSpace.h"

#include "Base/Parallel.h"

#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"

#include <algorithm>

namespace gridfem
{
namespace
{

vtkMPICommunicator* MpiOfVtk()
{
  auto* controller =
    vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
  return controller ? vtkMPICommunicator::SafeDownCast(controller->GetCommunicator()) : nullptr;
}

} // namespace

Communicator RanksOfVtk()
{
  return Communicator(*MpiOfVtk()->GetMPIComm()->GetHandle());
}

RankSpaceOptions DistributedOptions(const Communicator& ranks, const SurfaceOptions& options)
{
  RankSpaceOptions result;
  result.space.functions = options.space;
  result.space.functions.threads = options.space.threads > 0
                                     ? options.space.threads
                                     : std::max(1, NumberOfThreads(0) / ranks.RanksOfMachine());
  result.space.quadratureDegree = options.choice.quadratureDegree;
  result.space.coarsestSize = options.choice.coarsestSize;
  result.space.normalStabilization = options.choice.normalStabilization;
  return result;
}

} // namespace gridfem

#endif

bool gridfem::CanDistribute(vtkAlgorithm* filter)
{
#if GRIDFEM_HAS_PARALLEL
  const bool isPossible = MpiOfVtk() != nullptr;
#else
  const bool isPossible = false;
#endif
  if (!isPossible && Ranks().IsFirst())
  {
    vtkWarningWithObjectMacro(
      filter, "Distributed needs a build with MPI: rank 0 gathers the surface.");
  }
  return isPossible;
}
