#include "Pipeline/WholeClip.h"

#include "Input/BasisReader.h"
#include "Output/ClippedMeshWriter.h"
#include "Output/OctreeOutput.h"
#include "Output/SolverOutput.h"
#include "Pipeline/vtkSurfaceBasisHolder.h"

#include "Integrals/Evaluation.h"

#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

namespace gridfem
{

WholeClip::WholeClip(WholeSurface& surface) : surface_(surface)
{
}

WholeClip::~WholeClip() = default;

const ClippedMesh& WholeClip::Clipped() const
{
  return surface_.Basis() ? surface_.Basis().space->clipped : clipped_;
}

int WholeClip::Precision() const
{
  return OutputPrecision(surface_.Input()->GetPoints());
}

/// What both clips depend on.
StageKey WholeClip::KeyOfMesh() const
{
  StageKey key;
  key.Add(surface_.MeshNumber()).Add(this->Precision());
  key.Add(surface_.Options().space.weldCoincidentPoints);
  return key;
}

void WholeClip::MakeFrame()
{
  const SpaceOptions& options = surface_.Options().space;
  WriteClippedFrame(surface_.Input(), this->Source(), this->Clipped(), options.weldCoincidentPoints,
    options.threads, frame_);
}

void WholeClip::UpdateClip(const Progress& progress)
{
  SpaceOptions options = surface_.Options().space;
  StageKey key = this->KeyOfMesh();
  key.Add(options.depth);
  surface_.GetStages().Run(SpaceStage, key,
    [&]
    {
      surface_.ReadAnew(options.weldCoincidentPoints, progress.Part(0.0, 0.1));
      const TriangleMesh& mesh = surface_.Mesh();
      options.depth = ChooseDepth(mesh, options.depth, FunctionKind::Grid, AsManyAsWanted);
      RequireMemory(mesh, options.depth, FunctionKind::Grid);
      clipped_ = gridfem::Clip(mesh, options, progress.Part(0.1, 1.0));
      this->MakeFrame();
    });
}

void WholeClip::UpdateBasis(bool isShared, const Progress& progress)
{
  const SpaceOptions& options = surface_.Options().space;
  isInputClipped_ = CarriesClip(surface_.Input());
  StageKey key = this->KeyOfMesh();
  key.Add(isShared).Add(options.connectivityAware).Add(isInputClipped_);
  if (isInputClipped_)
  {
    AddClipArrays(key, surface_.Input());
  }
  else
  {
    key.Add(options.depth);
  }
  surface_.GetStages().Run(SpaceStage, key,
    [&]
    {
      isInputClipped_ ? this->ReadFunctions(progress) : this->BuildFunctions(progress);
      if (isShared)
      {
        vtkSurfaceBasisHolder::Attach(
          frame_->GetFieldData()->GetAbstractArray(PatchBasisIdsName), surface_.Basis());
      }
    });
}

void WholeClip::AddBasisToFrame(const std::vector<Id>& cellPatch)
{
  const GridFunctions& space = *surface_.Basis().space;
  WriteBasis(space.Finest(), space.clipped.cells, space.support, cellPatch,
    surface_.Basis().weldCoincidentPoints, frame_);
}

void WholeClip::BuildFunctions(const Progress& progress)
{
  SurfaceOptions options = surface_.Options();
  options.choice.kind = FunctionKind::Grid;
  surface_.BuildFunctions(options, progress);
  this->MakeFrame();
  this->AddBasisToFrame(PatchesOfTriangles(*surface_.Basis().space, options.space.threads));
}

/// Makes functions on the cells of an input that is clipped already. Its triangles stay.
void WholeClip::ReadFunctions(const Progress& progress)
{
  const SpaceOptions& options = surface_.Options().space;
  vtkPolyData* const input = surface_.Input();
  surface_.ReadAnew(false, progress.Part(0.0, 0.1));
  ClippedMesh clipped =
    ReadClippedMesh(input, this->Source(), options.weldCoincidentPoints, progress.Part(0.1, 0.5));
  RequireMemory(surface_.Mesh(), clipped.grid.depth, FunctionKind::Grid);
  const auto support =
    options.connectivityAware ? FunctionSupport::ConnectivityAware : FunctionSupport::Plain;
  surface_.TakeFunctions(
    BuildGridFunctions(std::move(clipped), support, { options.threads, progress.Part(0.5, 1.0) }));
  const GridFunctions& space = *surface_.Basis().space;
  std::vector<Id> cellPatch(input->GetNumberOfCells(), -1);
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    cellPatch[this->Source().sourceCell[space.clipped.pieceTriangle[piece]]] =
      space.piecePatch[piece];
  }
  frame_->Initialize();
  this->AddBasisToFrame(cellPatch);
}

void WholeClip::WriteMesh(vtkPolyData* output) const
{
  vtkPolyData* const input = surface_.Input();
  if (isInputClipped_)
  {
    output->ShallowCopy(input);
    PassArrays(frame_, output);
    return;
  }
  output->ShallowCopy(frame_);
  AddInputArrays(input, this->Source(), this->Clipped(), surface_.Options().space.threads, output);
}

void WholeClip::WriteFunctions(int level, vtkUnstructuredGrid* output) const
{
  const GridFunctions& space = *surface_.Basis().space;
  WriteBasisFunctions(space.GetGrid(),
    DescribeLevel(
      space.levels, PatchAreas(space), space.component, LevelOfDepth(space.levels, level)),
    this->Precision(), output);
}

void WholeClip::AddBasisFunction(int level, Id function, vtkPolyData* output) const
{
  const GridFunctions& space = *surface_.Basis().space;
  const MultiVector values = EvaluateAtClippedPoints(space,
    BasisFunctionCoefficients(space.levels, level, function), surface_.Options().space.threads);
  output->GetPointData()->AddArray(MakePointArray(BasisFunctionName, values, VTK_DOUBLE));
  output->GetPointData()->SetActiveScalars(BasisFunctionName);
}

} // namespace gridfem
