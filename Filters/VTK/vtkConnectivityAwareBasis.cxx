#include "vtkConnectivityAwareBasis.h"

#include "Private/Allocation.h"
#include "Private/BasisReader.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/InputValidation.h"
#include "Private/OctreeOutput.h"
#include "Private/SurfaceSolverState.h"
#include "Private/vtkSurfaceBasisHolder.h"

#include "Integrals/Evaluation.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
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

struct vtkConnectivityAwareBasis::Internals
{
  vtkNew<vtkPolyData> Frame; // what does not depend on the input's arrays
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
  state.mesh = gridfem::ReadInputMesh(input, options.threads, progress.Part(0.0, 0.1));
  gridfem::RequireSurface(*state.mesh.triangles);
  gridfem::ClippedMesh clipped = gridfem::ReadClippedMesh(
    input, state.mesh, options.weldCoincidentPoints, progress.Part(0.1, 0.4));
  gridfem::RequireMemory(*state.mesh.triangles, clipped.grid.depth);
  const auto support = options.connectivityAware ? gridfem::FunctionSupport::ConnectivityAware
                                                 : gridfem::FunctionSupport::Plain;
  state.basis = gridfem::MakeSurfaceBasis(state.mesh.triangles,
    gridfem::BuildGridFunctions(
      std::move(clipped), support, options.threads, progress.Part(0.4, 0.8)),
    options.weldCoincidentPoints);

  const gridfem::GridFunctions& space = state.Functions();
  std::vector<gridfem::Id> cellPatch(input->GetNumberOfCells(), -1);
  for (gridfem::Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    cellPatch[state.mesh.sourceCell[space.clipped.pieceTriangle[piece]]] = space.piecePatch[piece];
  }
  this->Data->Frame->Initialize();
  gridfem::WriteBasis(space, cellPatch, options.weldCoincidentPoints, this->Data->Frame);
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
      gridfem::WriteBasis(state.Functions(),
        gridfem::PatchesOfTriangles(state.Functions(), options.threads),
        options.weldCoincidentPoints, this->Data->Frame);
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
    gridfem::BasisFunctionCoefficients(space, this->Level, this->BasisId), this->NumberOfThreads);
  vtkNew<vtkDoubleArray> array;
  array->SetName("BasisFunction");
  gridfem::SetTuples(array, values.rows());
  std::copy(values.data(), values.data() + values.size(), array->GetPointer(0));
  output->GetPointData()->AddArray(array);
  output->GetPointData()->SetActiveScalars("BasisFunction");
}

void vtkConnectivityAwareBasis::Compute(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const gridfem::Progress progress = this->State->bridge.GetProgress();
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
  gridfem::WriteBasisFunctions(space, this->Level, gridfem::OutputPrecision(input->GetPoints()),
    vtkUnstructuredGrid::GetData(outputs, 1));
  progress.Check(1.0);
}

void vtkConnectivityAwareBasis::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Frame->Initialize();
}

void vtkConnectivityAwareBasis::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << this->Level << "\n";
  os << indent << "BasisId: " << this->BasisId << "\n";
}
