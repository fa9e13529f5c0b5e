#include "vtkClipToOctree.h"

#include "Output/ClippedArrays.h"
#include "Output/ClippedSurface.h"
#include "Output/OctreeOutput.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Algebra/DistributedRows.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkClipToOctree);

namespace
{

constexpr double MostAutomaticPoints = 1e6; // some 50 MB

} // namespace

vtkClipToOctree::vtkClipToOctree()
{
  this->SetNumberOfOutputPorts(3);
}

vtkClipToOctree::~vtkClipToOctree() = default;

int vtkClipToOctree::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

bool vtkClipToOctree::NeedsWholeSurface()
{
  return false;
}

void vtkClipToOctree::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::InputSurface& surface = this->State->Read(vtkPolyData::GetData(inputs[0]), nullptr);
  const gridfem::Progress progress = this->State->GetProgress();
  const gridfem::QuadratureRule& rule = gridfem::TriangleRule(this->QuadratureDegree);
  gridfem::ClippedSurface& clip = surface.Clip();
  clip.UpdateClip(progress.Part(0.0, 0.7));
  progress.Check(0.7);
  clip.WriteMesh(output);
  progress.Check(0.8);
  auto triangles = static_cast<double>(clip.Clipped().NumberOfTriangles());
  if (const gridfem::DistributedRows* sums = surface.SumsOverProcesses())
  {
    sums->SumNumbers(&triangles, 1);
  }
  surface.Together(
    [&]
    {
      gridfem::ColorByCells(output, gridfem::OctreeCellColorName);
      if (this->WantsQuadraturePoints(triangles))
      {
        gridfem::WriteQuadraturePoints(clip.Source(), clip.Clipped(), rule, clip.Precision(),
          surface.Threads(), vtkPolyData::GetData(outputs, 1));
      }
      gridfem::WriteOctreeCells(clip.Clipped(), this->Level, clip.Precision(), surface.Threads(),
        vtkUnstructuredGrid::GetData(outputs, 2), clip.CellBefore());
    });
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

void vtkClipToOctree::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GenerateQuadraturePoints: " << this->GenerateQuadraturePoints << "\n";
  os << indent << "Level: " << this->Level << "\n";
}
