#include "vtkConnectivityAwareBasis.h"

#include "Output/ClippedArrays.h"
#include "Output/ClippedSurface.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkConnectivityAwareBasis);

vtkConnectivityAwareBasis::vtkConnectivityAwareBasis()
{
  this->SetNumberOfOutputPorts(2);
}

vtkConnectivityAwareBasis::~vtkConnectivityAwareBasis() = default;

int vtkConnectivityAwareBasis::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

bool vtkConnectivityAwareBasis::NeedsWholeSurface()
{
  return false;
}

void vtkConnectivityAwareBasis::Compute(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::InputSurface& surface = this->State->Read(vtkPolyData::GetData(inputs[0]), nullptr);
  const gridfem::Progress progress = this->State->GetProgress();
  gridfem::ClippedSurface& clip = surface.Clip();
  clip.UpdateBasis(this->KeepsStages(), progress.Part(0.0, 0.8));
  progress.Check(0.8);
  clip.WriteMesh(output);
  surface.Together([&] { gridfem::ColorByCells(output, gridfem::PatchColorName); });
  if (this->BasisId >= 0)
  {
    clip.AddBasisFunction(this->Level, this->BasisId, output);
  }
  progress.Check(0.9);
  clip.WriteFunctions(this->Level, vtkUnstructuredGrid::GetData(outputs, 1));
  progress.Check(1.0);
}

void vtkConnectivityAwareBasis::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << this->Level << "\n";
  os << indent << "BasisId: " << this->BasisId << "\n";
}
