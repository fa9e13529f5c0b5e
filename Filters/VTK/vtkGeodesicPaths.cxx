#include "vtkGeodesicPaths.h"

#include "Input/PropertyList.h"
#include "Input/SelectedPoints.h"
#include "Output/PathOutput.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Solvers/PathSolver.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkGeodesicPaths);

struct vtkGeodesicPaths::Internals
{
  std::vector<gridfem::Id> SourceIds;
  std::vector<gridfem::Id> TargetIds;
  gridfem::PathSolver Solver;
};

vtkGeodesicPaths::vtkGeodesicPaths() : Data(std::make_unique<Internals>())
{
  this->SetSelectionPort(1);
  this->SetNumberOfOutputPorts(2);
}

vtkGeodesicPaths::~vtkGeodesicPaths() = default;

void vtkGeodesicPaths::AddSourcePointId(vtkIdType id)
{
  gridfem::AddToList(this->Data->SourceIds, id, this);
}

void vtkGeodesicPaths::ClearSourcePointIds()
{
  gridfem::ClearList(this->Data->SourceIds, this);
}

vtkIdType vtkGeodesicPaths::GetNumberOfSourcePointIds()
{
  return static_cast<vtkIdType>(this->Data->SourceIds.size());
}

vtkIdType vtkGeodesicPaths::GetSourcePointId(vtkIdType index)
{
  return gridfem::IdOfList(this->Data->SourceIds, index);
}

void vtkGeodesicPaths::AddTargetPointId(vtkIdType id)
{
  gridfem::AddToList(this->Data->TargetIds, id, this);
}

void vtkGeodesicPaths::ClearTargetPointIds()
{
  gridfem::ClearList(this->Data->TargetIds, this);
}

vtkIdType vtkGeodesicPaths::GetNumberOfTargetPointIds()
{
  return static_cast<vtkIdType>(this->Data->TargetIds.size());
}

vtkIdType vtkGeodesicPaths::GetTargetPointId(vtkIdType index)
{
  return gridfem::IdOfList(this->Data->TargetIds, index);
}

void vtkGeodesicPaths::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, nullptr);
  this->ReadSelection(inputs);
  gridfem::PathSolver::Input given;
  given.sources.ids = this->Data->SourceIds;
  given.sources.mask = surface.Given(surface.Find(0, "Source Array"));
  given.targets.ids = this->Data->TargetIds;
  given.targets.mask = surface.Given(surface.Find(1, "Target Array"));
  if (this->Selection->IsGiven())
  {
    given.targets.points.push_back({ "the Selection", "The Selection takes no point of a polygon",
      [&] { return this->Selection->Ids(surface.Mesh()); } });
  }
  gridfem::PathSolver::Options options;
  options.pathType = static_cast<gridfem::PathType>(this->PathType);
  const gridfem::PathSolver::Result& result =
    this->Data->Solver.Update(surface, given, options, { 0, state.GetProgress() });

  vtkPolyData* mesh = vtkPolyData::GetData(outputs, 0);
  mesh->ShallowCopy(input);
  mesh->GetCellData()->AddArray(gridfem::MakeIdArray("PathId",
    gridfem::FirstPathThroughCells(result.paths, surface.Triangles(), input->GetNumberOfCells())));
  mesh->GetFieldData()->AddArray(gridfem::MakeIdArray("UnreachedTargets", result.unreached));
  gridfem::WritePaths(result.paths, surface.Triangles(), input, vtkPolyData::GetData(outputs, 1));
  this->Warn(result.warnings);
}

void vtkGeodesicPaths::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Solver = {};
}

void vtkGeodesicPaths::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SourcePointIds: " << this->GetNumberOfSourcePointIds() << "\n";
  os << indent << "TargetPointIds: " << this->GetNumberOfTargetPointIds() << "\n";
  os << indent << "PathType: " << this->PathType << "\n";
}
