#include "vtkSurfaceGradient.h"

#include "Private/CanDistribute.h"
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

#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkSurfaceGradient);

namespace
{

constexpr const char* HodgeStage = "HodgeDecomposition";

/// The same on points and, unless it has no columns, on cells.
struct OutputArray
{
  const char* name;
  gridfem::MultiVector atPoints;
  gridfem::MultiVector onCells;
};

void AddArray(vtkDataSetAttributes* data, const char* name, const gridfem::MultiVector& values)
{
  data->AddArray(gridfem::MakePointArray(name, values, VTK_DOUBLE));
}

} // namespace

struct vtkSurfaceGradient::Internals
{
  gridfem::SurfaceDerivatives Derivatives;
  gridfem::HodgeDecomposition Parts;
  std::vector<OutputArray> Arrays; // until they are written

  /// On ranks that compute together collective.
  void Collect(const gridfem::SurfaceSolverState& state, const char* name,
    gridfem::MultiVector atPoints, const gridfem::MultiVector& onTriangles, vtkPolyData* input)
  {
    state.FillCopies(atPoints);
    this->Arrays.push_back({ name, std::move(atPoints),
      state.MeansOnCells(onTriangles, input ? input->GetNumberOfCells() : 0) });
  }
};

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
        gridfem::ReadField(array, state.mesh), { state.options, state.basis.weldCoincidentPoints },
        state.MakeJob(progress));
    });
  if (parts.numberOfOneSided > 0)
  {
    vtkWarningMacro(<< parts.numberOfOneSided << " of " << parts.numberOfComponents
                    << " connected components have only one side, so that no rotation can be told "
                       "there: what turns is in the HarmonicPart.");
  }
}

void vtkSurfaceGradient::CollectParts(vtkPolyData* input)
{
  const gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  const gridfem::HodgeDecomposition& parts = data.Parts;
  data.Collect(state, "GradientPart", parts.gradientAtPoints, parts.gradientOnTriangles, input);
  data.Collect(state, "RotationPart", parts.rotationAtPoints, parts.rotationOnTriangles, input);
  data.Collect(state, "HarmonicPart", parts.restAtPoints, parts.restOnTriangles, input);
  data.Arrays.push_back({ "Potential", parts.potentialAtPoints, {} });
  data.Arrays.push_back({ "StreamFunction", parts.streamAtPoints, {} });
}

/// The space has to be up to date.
void vtkSurfaceGradient::Derive(const gridfem::InputArray& array, const gridfem::Progress& progress)
{
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(array.array);
  key.Add(static_cast<int>(array.association));
  gridfem::AddSolver(key, state.options);
  gridfem::SurfaceDerivatives& derivatives = this->Data->Derivatives;
  state.stages.Run(gridfem::SolveStage, key,
    [&]
    {
      derivatives = gridfem::ComputeDerivatives(*state.SharedSpace(), *state.mesh.triangles,
        array.array ? state.Read(array) : gridfem::CoordinatesField(state.mesh), state.options,
        state.MakeJob(progress));
    });
}

void vtkSurfaceGradient::CollectArrays(bool hasArray, vtkPolyData* input)
{
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::SurfaceDerivatives& found = this->Data->Derivatives;
  Internals& data = *this->Data;
  data.Arrays.clear();
  data.Collect(state, "Gradient", found.gradientAtPoints, found.gradientOnTriangles, input);
  data.Collect(state, "Laplacian", found.laplacianAtPoints, found.laplacianOnTriangles, input);
  if (hasArray && found.divergenceAtPoints.cols() == 1)
  {
    data.Collect(state, "Divergence", found.divergenceAtPoints, found.divergenceOnTriangles, input);
    data.Collect(state, "Curl", found.curlAtPoints, found.curlOnTriangles, input);
  }
}

void vtkSurfaceGradient::WriteArrays(vtkPolyData* output)
{
  for (const OutputArray& array : this->Data->Arrays)
  {
    AddArray(output->GetPointData(), array.name, array.atPoints);
    if (array.onCells.cols() > 0)
    {
      AddArray(output->GetCellData(), array.name, array.onCells);
    }
  }
  this->Data->Arrays.clear();
  output->GetPointData()->SetActiveScalars("Laplacian");
  if (this->Data->Derivatives.laplacianAtPoints.cols() == 1)
  {
    output->GetPointData()->SetActiveVectors("Gradient");
  }
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
  this->Derive(array, progress.Part(0.5, 0.7));
  this->CollectArrays(array.array, input);
  gridfem::SolveReport report = this->Data->Derivatives.report;
  gridfem::SolutionAccuracy accuracy = this->Data->Derivatives.accuracy;
  if (this->HodgeDecomposition)
  {
    this->Decompose(array, progress.Part(0.7, 0.95));
    this->CollectParts(input);
    gridfem::KeepWorse(this->Data->Parts.report, report);
    gridfem::KeepWorse(this->Data->Parts.accuracy, accuracy);
  }
  output->ShallowCopy(input);
  this->WriteArrays(output);
  this->WriteReport(report, accuracy, output);
  progress.Check(1.0);
}

bool vtkSurfaceGradient::ComputeTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  gridfem::SurfaceSolverState& state = *this->State;
  if (!gridfem::CanDistribute(this, inputs, this->HodgeDecomposition))
  {
    return false;
  }
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  state.RunTogether(
    [&](const gridfem::Progress& progress)
    {
      state.UpdateTogether(piece, vtkPolyData::GetData(inputs[1]));
      progress.Check(0.4);
      const gridfem::InputArray array = state.together.Find(this, 0, piece, state.mesh, "Array");
      this->Derive(array, progress.Part(0.4, 1.0));
      this->CollectArrays(array.array, piece);
      gridfem::SolutionAccuracy accuracy = this->Data->Derivatives.accuracy;
      accuracy.largest = state.together.Largest(accuracy.largest);
      state.together.Together(
        [&]
        {
          if (piece)
          {
            output->ShallowCopy(piece);
            this->WriteArrays(output);
          }
          this->WriteReport(this->Data->Derivatives.report, accuracy, output);
          gridfem::AddDistributed(this->State->together.Depth(), output);
        });
    });
  return true;
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
