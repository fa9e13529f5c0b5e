#include "vtkSurfaceGradient.h"

#include "Private/InputArray.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Problems/SurfaceDerivatives.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkSurfaceGradient);

struct vtkSurfaceGradient::Internals
{
  gridfem::SurfaceDerivatives Derivatives;
};

vtkSurfaceGradient::vtkSurfaceGradient() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->Tolerance = 1e-4;
  this->NormalStabilization = 1e-2;
  this->MaximumIterations = 200;
}

vtkSurfaceGradient::~vtkSurfaceGradient() = default;

void vtkSurfaceGradient::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  const gridfem::InputArray array = gridfem::FindInputArray(this, 0, input, "Array");
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  state.UpdateSystem(progress.Part(0.3, 0.5));

  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(array.array);
  key.Add(static_cast<int>(array.association)).Add(this->Tolerance).Add(this->MaximumIterations);
  gridfem::AddMultigrid(key, state.options.multigrid);
  gridfem::SurfaceDerivatives& derivatives = this->Data->Derivatives;
  state.stages.Run(gridfem::SolveStage, key,
    [&]
    {
      derivatives = gridfem::ComputeDerivatives(*state.space, *state.mesh.triangles,
        array.array ? gridfem::ReadField(array, state.mesh) : gridfem::CoordinatesField(state.mesh),
        { state.options.multigrid, state.options.solve }, state.MakeJob(progress.Part(0.5, 0.95)));
    });

  output->ShallowCopy(input);
  const auto add = [](vtkDataSetAttributes* data, const char* name, const gridfem::MultiVector& v)
  { data->AddArray(gridfem::MakePointArray(name, v, VTK_DOUBLE)); };
  const auto onCells = [&](const gridfem::MultiVector& onTriangles)
  { return gridfem::MeansOnCells(state.mesh, onTriangles, input->GetNumberOfCells()); };
  add(output->GetPointData(), "Gradient", derivatives.gradientAtPoints);
  add(output->GetPointData(), "Laplacian", derivatives.laplacianAtPoints);
  add(output->GetCellData(), "Gradient", onCells(derivatives.gradientOnTriangles));
  add(output->GetCellData(), "Laplacian", onCells(derivatives.laplacianOnTriangles));
  if (array.array && derivatives.divergenceAtPoints.cols() == 1)
  {
    add(output->GetPointData(), "Divergence", derivatives.divergenceAtPoints);
    add(output->GetPointData(), "Curl", derivatives.curlAtPoints);
    add(output->GetCellData(), "Divergence", onCells(derivatives.divergenceOnTriangles));
    add(output->GetCellData(), "Curl", onCells(derivatives.curlOnTriangles));
  }
  output->GetPointData()->SetActiveScalars("Laplacian");
  if (derivatives.laplacianAtPoints.cols() == 1)
  {
    output->GetPointData()->SetActiveVectors("Gradient");
  }
  gridfem::AddReport(derivatives.report, output);
  if (!derivatives.report.converged)
  {
    vtkWarningMacro(<< gridfem::WarningOf(derivatives.report, this->Tolerance));
  }
  progress.Check(1.0);
}

void vtkSurfaceGradient::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Derivatives = {};
}
