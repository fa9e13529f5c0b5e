#include "vtkClipToOctree.h"

#include "Private/CanDistribute.h"
#include "Private/ClippedArrays.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/DistributedClip.h"
#include "Private/InputValidation.h"
#include "Private/OctreeOutput.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkClipToOctree);

namespace
{

constexpr double MostAutomaticPoints = 1e6; // some 50 MB

} // namespace

struct vtkClipToOctree::Internals
{
  gridfem::ClippedMesh Clipped;
  vtkNew<vtkPolyData> Frame;
  std::unique_ptr<gridfem::DistributedClip> OfRanks; // null if one clips all
};

vtkClipToOctree::vtkClipToOctree() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(3);
}

vtkClipToOctree::~vtkClipToOctree() = default;

int vtkClipToOctree::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

void vtkClipToOctree::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::SurfaceSolverState& state = *this->State;
  state.SetInput(input, nullptr);
  const gridfem::SpaceOptions& options = state.options.space;
  const gridfem::Progress progress = state.bridge.GetProgress();
  const gridfem::QuadratureRule& rule = gridfem::TriangleRule(this->QuadratureDegree);
  if (this->Data->OfRanks)
  {
    this->FreeStages();
  }

  gridfem::StageKey key;
  key.Add(state.meshVersion.Of(input, state.mesh, options.threads));
  key.Add(gridfem::OutputPrecision(input->GetPoints()));
  key.Add(options.depth).Add(options.weldCoincidentPoints);
  const auto clip = [&]
  {
    state.mesh = gridfem::ReadInputMesh(
      input, options.weldCoincidentPoints, options.threads, progress.Part(0.0, 0.1));
    gridfem::RequireSurface(*state.mesh.triangles);
    state.ChooseDepth();
    const gridfem::SpaceOptions& used = state.UsedOptions().space;
    gridfem::RequireMemory(*state.mesh.triangles, used.depth);
    this->Data->Clipped = gridfem::Clip(*state.mesh.triangles, used, progress.Part(0.1, 0.7));
    gridfem::WriteClippedFrame(input, state.mesh, this->Data->Clipped, options.weldCoincidentPoints,
      options.threads, this->Data->Frame);
  };
  state.stages.Run(gridfem::SpaceStage, key, clip);
  progress.Check(0.7);

  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  output->ShallowCopy(this->Data->Frame);
  gridfem::AddInputArrays(input, state.mesh, this->Data->Clipped, options.threads, output);
  output->GetCellData()->SetActiveScalars(gridfem::OctreeCellColorName);
  progress.Check(0.8);
  const int precision = gridfem::OutputPrecision(input->GetPoints());
  if (this->WantsQuadraturePoints(static_cast<double>(this->Data->Clipped.NumberOfTriangles())))
  {
    gridfem::WriteQuadraturePoints(state.mesh, this->Data->Clipped, rule, precision,
      options.threads, vtkPolyData::GetData(outputs, 1));
  }
  progress.Check(0.9);
  gridfem::WriteOctreeCells(this->Data->Clipped, this->Level, precision, options.threads,
    vtkUnstructuredGrid::GetData(outputs, 2));
  progress.Check(1.0);
}

bool vtkClipToOctree::WantsQuadraturePoints(double triangles) const
{
  const auto perTriangle =
    static_cast<double>(gridfem::TriangleRule(this->QuadratureDegree).points.size());
  return this->GenerateQuadraturePoints == QuadraturePointsOn ||
         (this->GenerateQuadraturePoints == QuadraturePointsAutomatic &&
           perTriangle * triangles <= MostAutomaticPoints);
}

/// Clips the pieces of all ranks together.
void vtkClipToOctree::ClipTogether(vtkPolyData* piece, int threads)
{
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::SurfaceOptions options = state.options;
  options.space.threads = threads;
  gridfem::StageKey key;
  state.together.Together(
    [&]
    {
      gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree
      key.Add(std::string("together")).Add(options.space.depth);
      if (piece)
      {
        gridfem::AddMesh(key, piece);
      }
    });
  state.stages.Run(gridfem::SpaceStage, key,
    [&]
    {
      this->Data->Clipped = {};
      this->Data->Frame->Initialize();
      this->Data->OfRanks = gridfem::DistributedClip::Make();
      this->Data->OfRanks->Build(
        state.together, piece, options, state.mesh, state.bridge.GetProgress().Part(0.1, 0.7));
    });
}

bool vtkClipToOctree::ComputeTogether(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  gridfem::SurfaceSolverState& state = *this->State;
  if (!gridfem::CanDistribute(this, inputs, false))
  {
    if (this->Data->OfRanks)
    {
      this->FreeStages();
    }
    return false;
  }
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const auto compute = [&](const gridfem::Progress& progress)
  {
    const int threads = state.together.ThreadsOfRank(this->NumberOfThreads);
    this->ClipTogether(piece, threads);
    progress.Check(0.7);
    const gridfem::DistributedClip& clip = *this->Data->OfRanks;
    clip.WriteMesh(piece, state.mesh, threads, output);
    progress.Check(0.8);
    auto triangles = static_cast<double>(clip.Clipped().NumberOfTriangles());
    state.together.Numbers().SumNumbers(&triangles, 1);
    state.together.Together(
      [&]
      {
        gridfem::AddFieldInt(output, gridfem::DistributedName, 1);
        output->GetCellData()->SetActiveScalars(gridfem::OctreeCellColorName);
        if (this->WantsQuadraturePoints(triangles))
        {
          gridfem::WriteQuadraturePoints(clip.Source(), clip.Clipped(),
            gridfem::TriangleRule(this->QuadratureDegree), clip.Precision(), threads,
            vtkPolyData::GetData(outputs, 1));
        }
        gridfem::WriteOctreeCells(clip.Clipped(), this->Level, clip.Precision(), threads,
          vtkUnstructuredGrid::GetData(outputs, 2), clip.CellBefore());
      });
    progress.Check(1.0);
  };
  state.RunTogether(compute);
  return true;
}

void vtkClipToOctree::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->OfRanks = nullptr;
  this->Data->Clipped = {};
  this->Data->Frame->Initialize();
}

void vtkClipToOctree::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GenerateQuadraturePoints: " << this->GenerateQuadraturePoints << "\n";
  os << indent << "Level: " << this->Level << "\n";
}
