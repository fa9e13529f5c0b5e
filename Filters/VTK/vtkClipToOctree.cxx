#include "vtkClipToOctree.h"

#include "Private/ClippedArrays.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/InputValidation.h"
#include "Private/OctreeOutput.h"
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
  const gridfem::SpaceOptions& options = state.options.space;
  const gridfem::Progress progress = state.bridge.GetProgress();
  const gridfem::QuadratureRule& rule = gridfem::TriangleRule(this->QuadratureDegree);

  gridfem::StageKey key;
  key.Add(state.meshVersion.Of(input, state.mesh, options.threads));
  key.Add(gridfem::OutputPrecision(input->GetPoints()));
  key.Add(options.depth).Add(options.weldCoincidentPoints);
  const auto clip = [&]
  {
    state.mesh = gridfem::ReadInputMesh(input, options.threads, progress.Part(0.0, 0.1));
    gridfem::RequireSurface(*state.mesh.triangles);
    state.ChooseDepth();
    gridfem::RequireMemory(*state.mesh.triangles, options.depth);
    const gridfem::ClipOptions clipOptions{ options.depth, options.weldCoincidentPoints,
      options.threads };
    this->Data->Clipped =
      gridfem::Clip(*state.mesh.triangles, clipOptions, progress.Part(0.1, 0.7));
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
  const auto quadraturePoints = static_cast<double>(rule.points.size()) *
                                static_cast<double>(this->Data->Clipped.NumberOfTriangles());
  if (this->GenerateQuadraturePoints == QuadraturePointsOn ||
      (this->GenerateQuadraturePoints == QuadraturePointsAutomatic &&
        quadraturePoints <= MostAutomaticPoints))
  {
    gridfem::WriteQuadraturePoints(state.mesh, this->Data->Clipped, rule, precision,
      options.threads, vtkPolyData::GetData(outputs, 1));
  }
  progress.Check(0.9);
  gridfem::WriteOctreeCells(this->Data->Clipped, this->Level, precision, options.threads,
    vtkUnstructuredGrid::GetData(outputs, 2));
  progress.Check(1.0);
}

void vtkClipToOctree::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Clipped = {};
  this->Data->Frame->Initialize();
}

void vtkClipToOctree::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GenerateQuadraturePoints: " << this->GenerateQuadraturePoints << "\n";
  os << indent << "Level: " << this->Level << "\n";
}
