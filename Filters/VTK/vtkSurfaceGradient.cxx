#include "vtkSurfaceGradient.h"

#include "Private/InputArray.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Problems/HodgeDecomposition.h"
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
  gridfem::HodgeDecomposition Parts;
};

namespace
{

constexpr const char* HodgeStage = "HodgeDecomposition";

void AddArray(vtkDataSetAttributes* data, const char* name, const gridfem::MultiVector& values)
{
  data->AddArray(gridfem::MakePointArray(name, values, VTK_DOUBLE));
}

/// The same on points and cells.
void AddArrays(const gridfem::InputMesh& mesh, const char* name,
  const gridfem::MultiVector& atPoints, const gridfem::MultiVector& onTriangles,
  vtkPolyData* output)
{
  AddArray(output->GetPointData(), name, atPoints);
  AddArray(output->GetCellData(), name,
    gridfem::MeansOnCells(mesh, onTriangles, output->GetNumberOfCells()));
}

} // namespace

vtkSurfaceGradient::vtkSurfaceGradient() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->NormalStabilization = 1e-2;
}

vtkSurfaceGradient::~vtkSurfaceGradient() = default;

void vtkSurfaceGradient::Decompose(
  const gridfem::InputArray& array, const gridfem::Progress& progress)
{
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(array.array);
  key.Add(static_cast<int>(array.association));
  gridfem::AddSolver(key, state.options);
  gridfem::HodgeDecomposition& parts = this->Data->Parts;
  state.stages.Run(HodgeStage, key,
    [&]
    {
      parts = gridfem::DecomposeField(*state.space, *state.mesh.triangles,
        gridfem::ReadField(array, state.mesh),
        { state.options.multigrid, state.options.solve, state.options.accuracy,
          state.basis.weldCoincidentPoints },
        state.MakeJob(progress));
    });
  if (parts.numberOfOneSided > 0)
  {
    vtkWarningMacro(<< parts.numberOfOneSided << " of " << parts.numberOfComponents
                    << " connected components have only one side, so that no rotation can be told "
                       "there: what turns is in the HarmonicPart.");
  }
}

void vtkSurfaceGradient::WriteParts(vtkPolyData* output)
{
  const gridfem::InputMesh& mesh = this->State->mesh;
  const gridfem::HodgeDecomposition& parts = this->Data->Parts;
  AddArrays(mesh, "GradientPart", parts.gradientAtPoints, parts.gradientOnTriangles, output);
  AddArrays(mesh, "RotationPart", parts.rotationAtPoints, parts.rotationOnTriangles, output);
  AddArrays(mesh, "HarmonicPart", parts.restAtPoints, parts.restOnTriangles, output);
  AddArray(output->GetPointData(), "Potential", parts.potentialAtPoints);
  AddArray(output->GetPointData(), "StreamFunction", parts.streamAtPoints);
}

void vtkSurfaceGradient::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  const gridfem::InputArray array = gridfem::FindInputArray(this, 0, input, "Array");
  if (this->HodgeDecomposition && (!array.array || array.array->GetNumberOfComponents() != 3))
  {
    throw gridfem::InvalidInput("HodgeDecomposition needs an Array with three components: "
                                "vectors. Without one it has to be off.");
  }
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  state.UpdateSystem(progress.Part(0.3, 0.5));

  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(array.array);
  key.Add(static_cast<int>(array.association));
  gridfem::AddSolver(key, state.options);
  gridfem::SurfaceDerivatives& derivatives = this->Data->Derivatives;
  state.stages.Run(gridfem::SolveStage, key,
    [&]
    {
      derivatives = gridfem::ComputeDerivatives(*state.space, *state.mesh.triangles,
        array.array ? gridfem::ReadField(array, state.mesh) : gridfem::CoordinatesField(state.mesh),
        { state.options.multigrid, state.options.solve, state.options.accuracy },
        state.MakeJob(progress.Part(0.5, 0.7)));
    });

  output->ShallowCopy(input);
  AddArrays(
    state.mesh, "Gradient", derivatives.gradientAtPoints, derivatives.gradientOnTriangles, output);
  AddArrays(state.mesh, "Laplacian", derivatives.laplacianAtPoints,
    derivatives.laplacianOnTriangles, output);
  if (array.array && derivatives.divergenceAtPoints.cols() == 1)
  {
    AddArrays(state.mesh, "Divergence", derivatives.divergenceAtPoints,
      derivatives.divergenceOnTriangles, output);
    AddArrays(state.mesh, "Curl", derivatives.curlAtPoints, derivatives.curlOnTriangles, output);
  }
  output->GetPointData()->SetActiveScalars("Laplacian");
  if (derivatives.laplacianAtPoints.cols() == 1)
  {
    output->GetPointData()->SetActiveVectors("Gradient");
  }
  gridfem::SolveReport report = derivatives.report;
  gridfem::SolutionAccuracy accuracy = derivatives.accuracy;
  if (this->HodgeDecomposition)
  {
    this->Decompose(array, progress.Part(0.7, 0.95));
    this->WriteParts(output);
    gridfem::KeepWorse(this->Data->Parts.report, report);
    gridfem::KeepWorse(this->Data->Parts.accuracy, accuracy);
  }
  this->WriteReport(report, accuracy, output);
  progress.Check(1.0);
}

void vtkSurfaceGradient::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Derivatives = {};
  this->Data->Parts = {};
}

void vtkSurfaceGradient::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HodgeDecomposition: " << this->HodgeDecomposition << "\n";
}
