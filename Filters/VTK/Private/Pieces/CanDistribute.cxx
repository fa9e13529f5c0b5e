#include "Pieces/CanDistribute.h"

#include "Input/BasisReader.h"
#include "Input/Domain.h"
#include "Input/InputArray.h"
#include "Pieces/Ranks.h"
#include "Pipeline/InputSurface.h"
#include "vtkSurfaceFEMAlgorithm.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#if GRIDFEM_HAS_PARALLEL
#include "Pieces/PieceSurface.h"

#include "vtkMPIController.h"
#endif

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

/// Whether a port from 2 on is connected. A selection does not count, because every rank evaluates
/// its part. Port 1 is for a basis.
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

/// Whether something keeps this rank from taking part.
bool HasObstacle(vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs)
{
  vtkPolyData* const piece = vtkPolyData::GetData(inputs[0]);
  // Filters with one port take a basis as a surface, or as a clip.
  const bool isSolver = filter->GetNumberOfInputPorts() > 1;
  vtkPolyData* const basis =
    isSolver && !CarriesBasis(piece) ? vtkPolyData::GetData(inputs[1]) : piece;
  const bool isGiven = isSolver && CarriesBasis(basis);
  return filter->GetBlocksAsOne() ||
         // A point where pieces meet may be inside the domain on one rank alone.
         IsArrayChosen(filter, DomainIndex) ||
         // Ranks together know no functions of degree two.
         filter->GetFunctionSpace() == vtkSurfaceFEMAlgorithm::SmoothGrid ||
         // Without welding, pieces would be apart along their borders.
         !filter->GetWeldCoincidentPoints() || (isGiven && !WeldsCoincidentPoints(basis)) ||
         (isGiven && basis == piece &&
           filter->GetFunctionSpace() != vtkSurfaceFEMAlgorithm::Grid) ||
         IsFurtherPortConnected(filter, inputs);
}

} // namespace

#if GRIDFEM_HAS_PARALLEL
std::unique_ptr<InputSurface> MakePieceSurface(
  Stages& stages, vtkAlgorithm* filter, const FilterOptions& options)
{
  return std::make_unique<PieceSurface>(stages, filter, options);
}
#else
std::unique_ptr<InputSurface> MakePieceSurface(Stages&, vtkAlgorithm*, const FilterOptions&)
{
  return nullptr;
}
#endif

bool HasPolygons(vtkPolyData* piece)
{
  return piece && piece->GetNumberOfPolys() + piece->GetNumberOfStrips() > 0;
}

bool IsArrayChosen(vtkSurfaceFEMAlgorithm* filter, int index)
{
  return IsChosen(filter->GetInputArrayInformation(index),
    vtkDataSet::SafeDownCast(filter->GetInputDataObject(0, 0)));
}

bool CanDistribute(vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs, bool needsAll)
{
  const Ranks ranks;
  return HasMpi() && ranks.Any(HasPolygons(vtkPolyData::GetData(inputs[0]))) &&
         !ranks.Any(needsAll || HasObstacle(filter, inputs));
}

} // namespace gridfem
