#include "CanDistribute.h"

#include "BasisReader.h"
#include "Ranks.h"
#include "vtkSurfaceFEMAlgorithm.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#if GRIDFEM_HAS_PARALLEL
#include "vtkMPIController.h"
#endif

#include <algorithm>

namespace gridfem
{
namespace
{

bool HasMpi()
{
#if GRIDFEM_HAS_PARALLEL
  return vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
#else
  return false;
#endif
}

bool HasPolygons(vtkPolyData* piece)
{
  return piece && piece->GetNumberOfPolys() + piece->GetNumberOfStrips() > 0;
}

/// But for a selection, of which every rank evaluates its part. Port 1 is that of a basis.
bool IsFurtherPortConnected(vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs)
{
  for (int port = 2; port < filter->GetNumberOfInputPorts(); ++port)
  {
    vtkDataObject* const data = vtkDataObject::GetData(inputs[port]);
    if (data && !vtkSelection::SafeDownCast(data))
    {
      return true;
    }
  }
  return false;
}

/// What keeps this rank from taking part.
std::string ObstacleHere(vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs)
{
  vtkPolyData* const piece = vtkPolyData::GetData(inputs[0]);
  // To filters with one port a basis is a surface, or a clip.
  const bool isSolver = filter->GetNumberOfInputPorts() > 1;
  vtkPolyData* const basis =
    isSolver && !CarriesBasis(piece) ? vtkPolyData::GetData(inputs[1]) : piece;
  const bool isGiven = isSolver && CarriesBasis(basis);
  return FirstObstacle({ { filter->GetBlocksAsOne(), "BlocksAsOne" },
    // Pieces would be apart along their borders: nothing else tells which points are one.
    { !filter->GetWeldCoincidentPoints(), "points that are not welded" },
    { isGiven && !WeldsCoincidentPoints(basis), "a basis whose points are not welded" },
    { isGiven && basis == piece && filter->GetFunctionSpace() != vtkSurfaceFEMAlgorithm::Grid,
      "hat functions on a basis" },
    { IsFurtherPortConnected(filter, inputs), "a further input" } });
}

} // namespace

bool IsArrayChosen(vtkSurfaceFEMAlgorithm* filter, int index)
{
  const char* name = filter->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_NAME());
  return name && *name && std::string(name) != "None";
}

std::string FirstObstacle(std::initializer_list<Obstacle> obstacles)
{
  const auto* first = std::find_if(
    obstacles.begin(), obstacles.end(), [](const Obstacle& one) { return one.isThere; });
  return first == obstacles.end() ? "" : first->name;
}

bool CanDistribute(
  vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs, const std::string& obstacle)
{
  const Ranks ranks;
  if (!ranks.Any(HasPolygons(vtkPolyData::GetData(inputs[0]))))
  {
    return false;
  }
  std::string reason = HasMpi() ? "" : "needs a build with MPI";
  const std::string own = obstacle.empty() ? ObstacleHere(filter, inputs) : obstacle;
  for (const std::string& other : ranks.Exchange(own))
  {
    if (reason.empty() && !other.empty())
    {
      reason = "does not go with " + other;
    }
  }
  if (!reason.empty() && ranks.IsFirst())
  {
    vtkWarningWithObjectMacro(
      filter, << "Distributed " << reason << ": rank 0 gathers the surface.");
  }
  return reason.empty();
}

} // namespace gridfem
