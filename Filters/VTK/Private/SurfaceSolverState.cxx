#include "SurfaceSolverState.h"

#include "Base/Errors.h"
#include "BasisReader.h"
#include "InputValidation.h"
#include "vtkSurfaceFEMAlgorithm.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace gridfem
{

void AddMesh(StageKey& key, vtkPolyData* data)
{
  key.Add(data->GetPoints()).Add(data->GetPoints() ? data->GetPoints()->GetData() : nullptr);
  for (vtkCellArray* cells : { data->GetPolys(), data->GetStrips() })
  {
    key.Add(cells);
    key.Add(cells ? cells->GetOffsetsArray() : nullptr);
    key.Add(cells ? cells->GetConnectivityArray() : nullptr);
  }
  // Cells of these kinds come first and shift the ids of the polygons.
  key.Add(std::int64_t{ data->GetNumberOfVerts() }).Add(std::int64_t{ data->GetNumberOfLines() });
}

void AddMultigrid(StageKey& key, const MultigridOptions& options)
{
  key.Add(static_cast<int>(options.cycle)).Add(static_cast<int>(options.smoother));
  key.Add(options.preSweeps).Add(options.postSweeps).Add(options.sweepsPerSynchronisation);
  key.Add(static_cast<int>(options.hidden)).Add(options.threads);
}

void AddClipArrays(StageKey& key, vtkPolyData* data)
{
  for (const char* name : { SourceCellIdName, OctreeCellIdName })
  {
    key.Add(data->GetCellData()->GetAbstractArray(name));
  }
  for (const char* name : { OctreeCellsName, GridOriginName, GridSpacingName, GridDepthName })
  {
    key.Add(data->GetFieldData()->GetAbstractArray(name));
  }
}

void AddBasisArrays(StageKey& key, vtkPolyData* data)
{
  AddClipArrays(key, data);
  key.Add(data->GetCellData()->GetAbstractArray(PatchIdName));
  for (const char* name : { PatchCellIdName, PatchBasisIdsName, NumberOfBasisFunctionsName,
         ConnectivityAwareName, WeldCoincidentPointsName })
  {
    key.Add(data->GetFieldData()->GetAbstractArray(name));
  }
}

void SurfaceSolverState::UpdateSpace(
  vtkPolyData* input, vtkPolyData* basisData, const Progress& progress)
{
  RequireNumber("Tolerance", options.solve.tolerance);
  StageKey key;
  AddMesh(key, input);
  const bool carries = CarriesBasis(input);
  if (carries || basisData)
  {
    vtkPolyData* source = carries ? input : basisData;
    AddMesh(key, source);
    AddBasisArrays(key, source);
  }
  else
  {
    key.Add(options.space.depth);
    key.Add(options.space.connectivityAware);
    key.Add(options.space.weldCoincidentPoints);
  }
  const auto update = [&]
  {
    if (!carries && !basisData)
    {
      this->BuildSpace(input, progress);
      return;
    }
    basis = {};
    mesh = ReadInputMesh(input, options.space.threads, progress.Part(0.0, 0.1));
    RequireSurface(*mesh.triangles);
    if (!carries && !CarriesBasis(basisData))
    {
      throw InvalidInput("The second input is not the output of a basis filter: the arrays "
                         "'PatchBasisIds' and 'PatchId' are missing.");
    }
    basis = carries ? ReadBasis(input, mesh, progress.Part(0.1, 1.0))
                    : ReadBasisFor(basisData, mesh, progress.Part(0.1, 1.0));
    RequireMemory(*mesh.triangles, basis.space->GetGrid().depth, options.hatFunctions);
    weldCoincidentPoints_ = WeldsCoincidentPoints(carries ? input : basisData);
  };
  stages.Run(vtkSurfaceFEMAlgorithm::SpaceStage, key, update);
}

void SurfaceSolverState::BuildSpace(vtkPolyData* input, const Progress& progress)
{
  basis = {}; // frees the memory of the last one first
  system = {};
  hats.reset();
  weldCoincidentPoints_ = options.space.weldCoincidentPoints;
  mesh = ReadInputMesh(input, options.space.threads, progress.Part(0.0, 0.1));
  RequireSurface(*mesh.triangles);
  RequireMemory(*mesh.triangles, options.space.depth, options.hatFunctions);
  basis = MakeSurfaceBasis(
    mesh.triangles, BuildGridFunctions(*mesh.triangles, options.space, progress.Part(0.1, 1.0)));
}

void SurfaceSolverState::UpdateSystem(const Progress& progress)
{
  constexpr int stage = vtkSurfaceFEMAlgorithm::SystemStage;
  StageKey key;
  key.Add(stages.Version(vtkSurfaceFEMAlgorithm::SpaceStage)).Add(options.quadratureDegree);
  key.Add(options.coarsestSize).Add(options.hatFunctions).Add(options.normalStabilization);
  const SystemKey wanted{ options.quadratureDegree, options.coarsestSize,
    options.normalStabilization };
  if (!options.hatFunctions && !stages.IsCurrent(stage, key))
  {
    system = basis.systems->Find(wanted);
    if (system)
    {
      hats.reset();
      stages.Adopt(stage, key);
      return;
    }
  }
  const auto build = [&]
  {
    hats.reset();
    system = basis.systems->Get(wanted, options.space.threads, progress.Part(0.0, 0.7));
    if (options.hatFunctions)
    {
      hats = this->BuildHats(progress.Part(0.7, 1.0));
    }
  };
  stages.Run(stage, key, build);
}

HatHierarchy SurfaceSolverState::BuildHats(const Progress& progress) const
{
  RequireMemoryForHats(*basis.mesh,
    basis.space->Finest().numberOfFunctions); // the space may be older than the wish for hats
  return BuildHatHierarchy(*basis.mesh, *basis.space, weldCoincidentPoints_,
    HatTransfer::Evaluation, options.space.threads, progress);
}

double SurfaceSolverState::WeightInGridUnits(double weight) const
{
  const Grid& grid = basis.space->GetGrid();
  double length2 = 1.0; // the squared unit of length, world units
  if (options.parameterUnits == vtkSurfaceFEMAlgorithm::UnitArea)
  {
    length2 = SurfaceArea(*mesh.triangles);
  }
  else if (options.parameterUnits == vtkSurfaceFEMAlgorithm::UnitCube)
  {
    const double side = grid.spacing * grid.CellsPerSide();
    length2 = side * side;
  }
  return weight / length2 * grid.spacing * grid.spacing;
}

} // namespace gridfem
