#include "vtkConnectivityAwareBasis.h"

#include "Private/BasisReader.h"
#include "Private/CanDistribute.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/DistributedClip.h"
#include "Private/InputValidation.h"
#include "Private/OctreeOutput.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"
#include "Private/vtkSurfaceBasisHolder.h"

#include "Integrals/Evaluation.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

vtkStandardNewMacro(vtkConnectivityAwareBasis);

namespace
{

constexpr const char* ClipStage = "ClipOfRanks";

} // namespace

struct vtkConnectivityAwareBasis::Internals
{
  vtkNew<vtkPolyData> Frame;                         // independent of the input's arrays
  std::unique_ptr<gridfem::DistributedClip> OfRanks; // null where one computes for all
};

vtkConnectivityAwareBasis::vtkConnectivityAwareBasis() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
}

vtkConnectivityAwareBasis::~vtkConnectivityAwareBasis() = default;

int vtkConnectivityAwareBasis::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

void vtkConnectivityAwareBasis::ReadClip(vtkPolyData* input)
{
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::SpaceOptions& options = state.options.space;
  const gridfem::Progress progress = state.bridge.GetProgress();
  state.basis = {};
  state.mesh = gridfem::ReadInputMesh(input, false, options.threads, progress.Part(0.0, 0.1));
  gridfem::RequireSurface(*state.mesh.triangles);
  gridfem::ClippedMesh clipped = gridfem::ReadClippedMesh(
    input, state.mesh, options.weldCoincidentPoints, progress.Part(0.1, 0.4));
  gridfem::RequireMemory(*state.mesh.triangles, clipped.grid.depth);
  const auto support = options.connectivityAware ? gridfem::FunctionSupport::ConnectivityAware
                                                 : gridfem::FunctionSupport::Plain;
  state.basis = gridfem::MakeSurfaceBasis(state.mesh.triangles,
    gridfem::BuildGridFunctions(
      std::move(clipped), support, { options.threads, progress.Part(0.4, 0.8) }),
    options.weldCoincidentPoints);

  const gridfem::GridFunctions& space = state.Functions();
  std::vector<gridfem::Id> cellPatch(input->GetNumberOfCells(), -1);
  for (gridfem::Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    cellPatch[state.mesh.sourceCell[space.clipped.pieceTriangle[piece]]] = space.piecePatch[piece];
  }
  this->Data->Frame->Initialize();
  gridfem::WriteBasis(space.Finest(), space.clipped.cells, space.support, cellPatch,
    options.weldCoincidentPoints, this->Data->Frame);
}

void vtkConnectivityAwareBasis::UpdateBasis(vtkPolyData* input)
{
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::SpaceOptions& options = state.options.space;
  const bool isClipped = gridfem::CarriesClip(input);
  gridfem::StageKey key;
  key.Add(state.meshVersion.Of(input, state.mesh, options.threads));
  key.Add(gridfem::OutputPrecision(input->GetPoints()));
  key.Add(this->KeepsStages())
    .Add(options.connectivityAware)
    .Add(options.weldCoincidentPoints)
    .Add(isClipped);
  if (isClipped)
  {
    gridfem::AddClipArrays(key, input);
  }
  else
  {
    key.Add(options.depth);
  }
  const auto build = [&]
  {
    if (isClipped)
    {
      this->ReadClip(input);
    }
    else
    {
      state.BuildSpace(input, state.bridge.GetProgress().Part(0.0, 0.8));
      gridfem::WriteClippedFrame(input, state.mesh, state.Functions().clipped,
        options.weldCoincidentPoints, options.threads, this->Data->Frame);
      const gridfem::GridFunctions& space = state.Functions();
      gridfem::WriteBasis(space.Finest(), space.clipped.cells, space.support,
        gridfem::PatchesOfTriangles(space, options.threads), options.weldCoincidentPoints,
        this->Data->Frame);
    }
    if (this->KeepsStages())
    {
      vtkSurfaceBasisHolder::Attach(
        this->Data->Frame->GetFieldData()->GetAbstractArray(gridfem::PatchBasisIdsName),
        state.basis);
    }
  };
  state.stages.Run(gridfem::SpaceStage, key, build);
}

void vtkConnectivityAwareBasis::AddBasisFunction(vtkPolyData* output)
{
  const gridfem::GridFunctions& space = this->State->Functions();
  const gridfem::MultiVector values = gridfem::EvaluateAtClippedPoints(space,
    gridfem::BasisFunctionCoefficients(space.levels, this->Level, this->BasisId),
    this->NumberOfThreads);
  output->GetPointData()->AddArray(
    gridfem::MakePointArray(gridfem::BasisFunctionName, values, VTK_DOUBLE));
  output->GetPointData()->SetActiveScalars(gridfem::BasisFunctionName);
}

void vtkConnectivityAwareBasis::Compute(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const gridfem::Progress progress = this->State->bridge.GetProgress();
  if (this->Data->OfRanks)
  {
    this->FreeStages();
  }
  this->UpdateBasis(input);
  progress.Check(0.8);

  const gridfem::GridFunctions& space = this->State->Functions();
  if (gridfem::CarriesClip(input))
  {
    output->ShallowCopy(input);
    gridfem::PassArrays(this->Data->Frame, output);
  }
  else
  {
    output->ShallowCopy(this->Data->Frame);
    gridfem::AddInputArrays(input, this->State->mesh, space.clipped, this->NumberOfThreads, output);
  }
  output->GetCellData()->SetActiveScalars(gridfem::PatchColorName);
  if (this->BasisId >= 0)
  {
    this->AddBasisFunction(output);
  }
  progress.Check(0.9);
  gridfem::WriteBasisFunctions(space.GetGrid(),
    gridfem::DescribeLevel(space.levels, gridfem::PatchAreas(space), space.component,
      gridfem::LevelOfDepth(space.levels, this->Level)),
    gridfem::OutputPrecision(input->GetPoints()), vtkUnstructuredGrid::GetData(outputs, 1));
  progress.Check(1.0);
}

bool vtkConnectivityAwareBasis::ComputeTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  gridfem::SurfaceSolverState& state = *this->State;
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  if (!gridfem::CanDistribute(this, inputs, false))
  {
    return false;
  }
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  std::unique_ptr<gridfem::DistributedClip>& clip = this->Data->OfRanks;
  const auto update = [&](const gridfem::Progress& progress)
  {
    state.options.choice.kind = gridfem::FunctionKind::Grid;
    const bool isClipped = state.together.Any(gridfem::CarriesClip(piece));
    state.BuildTogether(piece, isClipped, [&] { clip = nullptr; });
    gridfem::StageKey key;
    key.Add(state.stages.Version(gridfem::SpaceStage));
    state.stages.Run(ClipStage, key,
      [&]
      {
        this->Data->Frame->Initialize();
        clip = gridfem::DistributedClip::Make();
        clip->Take(state.together, piece, isClipped, state.options, state.mesh);
      });
    progress.Check(0.8);
    const int threads = state.Threads();
    clip->WriteMesh(piece, state.mesh, threads, output);
    state.together.Together(
      [&]
      {
        output->GetCellData()->SetActiveScalars(gridfem::PatchColorName);
        gridfem::AddDistributed(state.together.Depth(), output);
      });
    if (this->BasisId >= 0)
    {
      clip->AddBasisFunction(this->Level, this->BasisId, threads, output);
    }
    progress.Check(0.9);
    clip->WriteFunctions(this->Level, vtkUnstructuredGrid::GetData(outputs, 1));
    progress.Check(1.0);
  };
  state.RunTogether(update);
  return true;
}

void vtkConnectivityAwareBasis::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->OfRanks = nullptr;
  this->Data->Frame->Initialize();
}

void vtkConnectivityAwareBasis::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << this->Level << "\n";
  os << indent << "BasisId: " << this->BasisId << "\n";
}
