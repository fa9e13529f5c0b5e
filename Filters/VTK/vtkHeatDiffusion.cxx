#include "vtkHeatDiffusion.h"

#include "Input/InputArray.h"
#include "Input/JoinedArrays.h"
#include "Output/ClippedMeshWriter.h"
#include "Output/MovedMeshWriter.h"
#include "Output/SolverOutput.h"
#include "Pieces/CanDistribute.h"
#include "Pipeline/FilterState.h"
#include "Pipeline/PipelineTime.h"

#include "Integrals/QuadratureRule.h"
#include "Solvers/DiffusionSolver.h"

#include "vtkDataArray.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <numeric>

vtkStandardNewMacro(vtkHeatDiffusion);

struct vtkHeatDiffusion::Internals
{
  gridfem::InputArray Array; // none: the coordinates
  gridfem::JoinedArrays Arrays;
  gridfem::InputArray Source;
  gridfem::InputArray Mask;
  gridfem::DiffusionSolver Solver;
  const gridfem::DiffusionSolver::Result* Result = nullptr; // of this run
};

vtkHeatDiffusion::vtkHeatDiffusion() : Data(std::make_unique<Internals>())
{
  this->SetSelectionPort(2);
  this->NormalStabilization =
    gridfem::DiffusionSolver::SurfaceDefaults().choice.normalStabilization;
}

vtkHeatDiffusion::~vtkHeatDiffusion() = default;

std::vector<double> vtkHeatDiffusion::OwnTimeSteps()
{
  if (this->TimeFrom == Input || this->NumberOfSteps == 1)
  {
    return {};
  }
  std::vector<double> steps(static_cast<std::size_t>(this->NumberOfSteps));
  std::iota(steps.begin(), steps.end(), 1.0);
  return steps;
}

/// Moved points need the whole surface: their normals and the arrays that follow them come from it.
bool vtkHeatDiffusion::NeedsWholeSurface()
{
  return !gridfem::IsArrayChosen(this, 0);
}

void vtkHeatDiffusion::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  Internals& data = *this->Data;
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  this->ReadSelection(inputs);
  data.Array = data.Arrays.Join(this, surface, surface.Find(0, "Array"), "Array");
  data.Source = surface.Find(1, "Heat Source Array");
  data.Mask = surface.Find(2, "Constraint Array");

  gridfem::DiffusionSolver::Options options;
  options.equation = state.options;
  options.amount = static_cast<gridfem::DiffusionAmount>(this->Amount);
  options.diffusionTime = this->DiffusionTime;
  options.fullWidth = this->FWHM;
  options.sigma = this->Sigma;
  options.numberOfSteps = this->NumberOfSteps;
  options.boundaryValues = this->BoundaryValues;
  const gridfem::Progress progress = state.GetProgress();
  const gridfem::DiffusionSolver::Result& result = data.Solver.Update(surface,
    { surface.Given(data.Array), surface.Given(data.Source),
      surface.ConstraintsOf(data.Array, data.Mask, *this->Selection) },
    options, { surface.Threads(), progress.Part(0.0, 0.95) });
  data.Result = &result;

  const int shown =
    this->OwnTimeSteps().empty()
      ? this->NumberOfSteps
      : gridfem::ShownStep(outputs->GetInformationObject(0), 1, this->NumberOfSteps);
  const gridfem::DiffusionSolver::Step& step = result.steps[static_cast<std::size_t>(shown) - 1];
  surface.Together(
    [&]
    {
      if (input && input->GetPoints())
      {
        this->WriteStep(shown, input, output);
      }
      gridfem::AddFieldInt(output, "Step", shown);
      if (!step.met.isHeld.empty()) // the same on all ranks
      {
        gridfem::AddFieldNumber(output, "Misfit", step.met.misfit);
      }
      gridfem::AddReport(step.report, output);
      gridfem::AddAccuracy(step.accuracy, output);
      gridfem::AddFieldNumber(output, "DiffusionTime", shown * result.stepLength);
    });
  this->Warn(data.Solver.Warnings(shown));
  progress.Check(1.0);
}

void vtkHeatDiffusion::WriteStep(int shown, vtkPolyData* input, vtkPolyData* output)
{
  const gridfem::DiffusionSolver::Result& result = *this->Data->Result;
  gridfem::MultiVector values = result.steps[static_cast<std::size_t>(shown) - 1].atPoints;
  output->ShallowCopy(input);
  vtkPointData* points = output->GetPointData();
  if (this->Data->Array.array)
  {
    this->Data->Arrays.AddSolutions("Diffused", values, points);
  }
  else
  {
    gridfem::KeepUnsolved(input->GetPoints()->GetData(), values);
    points->AddArray(gridfem::MakePointArray("Diffused", values, VTK_DOUBLE));
    gridfem::MoveSurface(this->State->Surface().Mesh(), values,
      gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
}

void vtkHeatDiffusion::AddFurtherArray(const char* name)
{
  gridfem::AddFurtherArray(this, name);
}

void vtkHeatDiffusion::ClearFurtherArrays()
{
  gridfem::ClearFurtherArrays(this);
}

void vtkHeatDiffusion::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkHeatDiffusion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Amount: " << this->Amount << "\n";
  os << indent << "DiffusionTime: " << this->DiffusionTime << "\n";
  os << indent << "FWHM: " << this->FWHM << "\n";
  os << indent << "Sigma: " << this->Sigma << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "TimeFrom: " << this->TimeFrom << "\n";
  os << indent << "BoundaryValues: " << this->BoundaryValues << "\n";
}
