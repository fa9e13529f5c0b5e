#include "CanDistribute.h"

#include "ClippedArrays.h"
#include "InputValidation.h"
#include "Integrals/QuadratureRule.h"
#include "Ranks.h"
#include "vtkSurfaceFEMAlgorithm.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>

namespace gridfem
{
namespace
{

bool HasPolygons(vtkPolyData* piece)
{
  return piece && piece->GetNumberOfPolys() + piece->GetNumberOfStrips() > 0;
}

/// Whether this rank can take part.
bool CanTakePart(vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs, int depth)
{
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  const bool isOnGrid = filter->GetFunctionSpace() == vtkSurfaceFEMAlgorithm::Grid &&
                        filter->GetSmoother() == vtkSurfaceFEMAlgorithm::PatchSmoother &&
                        depth >= MinimumDepth && !filter->GetBlocksAsOne();
  bool isAlone = !piece || !(CarriesBasis(piece) || piece->GetCellData()->HasArray(
                                                      vtkDataSetAttributes::GhostArrayName()));
  for (int port = 1; port < filter->GetNumberOfInputPorts(); ++port)
  {
    isAlone = isAlone && !vtkDataObject::GetData(inputs[port]);
  }
  return isOnGrid && isAlone;
}

} // namespace

bool IsArrayChosen(vtkSurfaceFEMAlgorithm* filter, std::initializer_list<int> indices)
{
  return std::any_of(indices.begin(), indices.end(),
    [filter](int index)
    {
      const char* name = filter->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_NAME());
      return name && *name && std::string(name) != "None";
    });
}

InputMesh ReadPiece(vtkSurfaceFEMAlgorithm* filter, vtkPolyData* piece)
{
  TriangleRule(filter->GetQuadratureDegree()); // refuses a wrong degree
  RequireNumber("Tolerance", filter->GetTolerance());
  if (HasPolygons(piece))
  {
    return ReadInputMesh(piece, filter->GetNumberOfThreads());
  }
  InputMesh mesh;
  mesh.triangles = std::make_shared<const TriangleMesh>();
  return mesh;
}

} // namespace gridfem

#if GRIDFEM_HAS_PARALLEL

#include "DistributedSpace.h"

#include "Base/Parallel.h"

#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"

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

bool gridfem::CanDistribute(
  vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs, int depth, bool isPlain)
{
  const Ranks ranks;
#if GRIDFEM_HAS_PARALLEL
  const bool isPossible = MpiOfVtk() != nullptr;
#else
  const bool isPossible = false;
#endif
  if (!isPossible)
  {
    if (ranks.IsFirst())
    {
      vtkWarningWithObjectMacro(
        filter, "Distributed needs a build with MPI: rank 0 gathers the surface.");
    }
    return false;
  }
  return !ranks.Any(!isPlain || !CanTakePart(filter, inputs, depth)) &&
         ranks.Any(HasPolygons(vtkPolyData::GetData(inputs[0])));
}
