#include "vtkHeatDiffusion.h"

#include "Private/ClippedMeshWriter.h"
#include "Private/GivenValues.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/MovedMeshWriter.h"
#include "Private/SelectedPoints.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Grid/SurfaceEdges.h"
#include "Integrals/QuadratureRule.h"
#include "Problems/HeatDiffusion.h"
#include "Problems/SolveWarnings.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <numeric>

vtkStandardNewMacro(vtkHeatDiffusion);

namespace
{

/// The step of the time that is asked for; the last when none is.
int ShownStep(vtkInformation* output, int lastStep)
{
  if (!output->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    return lastStep;
  }
  const double time = output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
  return time > 1.0 ? static_cast<int>(std::lround(std::min(time, double(lastStep)))) : 1;
}

struct Step
{
  gridfem::MultiVector atPoints;
  gridfem::SolveReport report;
  gridfem::SolutionAccuracy accuracy;
  gridfem::ConstrainedSolution met; // of held values
};

} // namespace

struct vtkHeatDiffusion::Internals
{
  gridfem::MultiVector Start;
  gridfem::MultiVector Sources;
  gridfem::HeldValues Held;
  std::unique_ptr<gridfem::HeatDiffusion> Diffusion;
  std::vector<Step> Steps; // the first is step 1
};

vtkHeatDiffusion::vtkHeatDiffusion()
  : Data(std::make_unique<Internals>()), Selection(std::make_unique<gridfem::SelectedPoints>(this))
{
  this->SetNumberOfInputPorts(3);
  this->NormalStabilization = 1e-2;
}

vtkHeatDiffusion::~vtkHeatDiffusion() = default;

int vtkHeatDiffusion::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkSelection");
  }
  return 1;
}

std::vector<double> vtkHeatDiffusion::OwnTimeSteps()
{
  std::vector<double> steps(static_cast<std::size_t>(this->NumberOfSteps));
  std::iota(steps.begin(), steps.end(), 1.0);
  return steps;
}

bool vtkHeatDiffusion::HoldsValues(vtkPolyData* input)
{
  return this->BoundaryValues || this->Selection->IsGiven() ||
         gridfem::FindInputArray(this, 2, input, "ConstraintArray").array;
}

/// Those of time 0. The space has to be up to date.
gridfem::HeldValues vtkHeatDiffusion::FindHeldValues(vtkPolyData* input)
{
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::TriangleMesh& mesh = *state.mesh.triangles;
  const gridfem::InputArray mask = gridfem::FindInputArray(this, 2, input, "ConstraintArray");
  gridfem::InputArray array = gridfem::FindInputArray(this, 0, input, "Array");
  gridfem::RequireValuesAtPoints(array, mask, *this->Selection);
  if (!array.array)
  {
    array.array = input->GetPoints()->GetData();
    array.name = "coordinates";
  }
  gridfem::GivenValues given;
  given.values.resize(0, array.array->GetNumberOfComponents());
  if (mask.array || this->Selection->IsGiven())
  {
    given = gridfem::KnownValues(array, mask, *this->Selection, mesh);
  }
  gridfem::HeldValues held =
    gridfem::HoldPoints(*state.space, given.points, std::move(given.values));
  if (this->BoundaryValues)
  {
    const std::vector<gridfem::TriangleEdge> edges =
      gridfem::FindSurfaceEdges(mesh, state.basis.weldCoincidentPoints).boundary;
    if (edges.empty())
    {
      vtkWarningMacro(<< "The surface has no boundary for BoundaryValues.");
    }
    held = gridfem::Join(held,
      gridfem::HoldEdges(*state.space, mesh, edges, gridfem::ReadField(array, state.mesh).values));
  }
  return held;
}

/// The integrals of the array and of the source, and what is held. The system has to be up to date.
void vtkHeatDiffusion::UpdateLoads(vtkPolyData* input)
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  const gridfem::InputArray start = gridfem::FindInputArray(this, 0, input, "Array");
  const gridfem::InputArray source = gridfem::FindInputArray(this, 1, input, "HeatSourceArray");
  const int components = start.array ? start.array->GetNumberOfComponents() : 3;
  if (source.array && source.array->GetNumberOfComponents() != components)
  {
    throw gridfem::InvalidInput("HeatSourceArray '" + source.name + "' has " +
                                std::to_string(source.array->GetNumberOfComponents()) +
                                " components instead of the " + std::to_string(components) +
                                " of the array that spreads.");
  }
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage));
  key.Add(start.array).Add(static_cast<int>(start.association));
  key.Add(source.array).Add(static_cast<int>(source.association));
  key.Add(gridfem::FindInputArray(this, 2, input, "ConstraintArray").array);
  key.Add(this->BoundaryValues).Add(this->Selection->Version());
  state.stages.Run(gridfem::RightHandSideStage, key,
    [&]
    {
      const gridfem::Progress progress = state.bridge.GetProgress();
      const double unit = state.space->UnitLength();
      data.Start = state.space->LoadOfValues(
        start.array ? gridfem::ReadField(start, state.mesh) : gridfem::CoordinatesField(state.mesh),
        state.MakeJob(progress.Part(0.3, 0.35)));
      data.Held = this->HoldsValues(input) ? this->FindHeldValues(input) : gridfem::HeldValues{};
      data.Sources = {};
      if (source.array)
      {
        // Per squared unit of length of the space.
        data.Sources = unit * unit *
                       state.space->LoadOfValues(gridfem::ReadField(source, state.mesh),
                         state.MakeJob(progress.Part(0.35, 0.4)));
      }
    });
}

/// Makes the steps that are missing.
/// @param step  length of a step, squared units of length of the space
void vtkHeatDiffusion::UpdateSteps(double step)
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::RightHandSideStage)).Add(step).Add(this->Scheme);
  gridfem::AddSolver(key, state.options);
  state.stages.Run(gridfem::HierarchyStage, key,
    [&]
    {
      gridfem::DiffusionOptions options;
      options.timeStep = step;
      options.scheme = static_cast<gridfem::TimeScheme>(this->Scheme);
      options.multigrid = state.options.multigrid;
      options.solve = state.options.solve;
      options.accuracy = state.options.accuracy;
      options.held = data.Held;
      data.Steps.clear();
      data.Diffusion.reset(); // frees its memory first
      data.Diffusion = std::make_unique<gridfem::HeatDiffusion>(
        state.space, data.Start, data.Sources, options, state.MakeJob(progress.Part(0.4, 0.5)));
    });
  const auto wanted = static_cast<std::size_t>(this->NumberOfSteps);
  const auto first = static_cast<double>(data.Steps.size());
  while (data.Steps.size() < wanted)
  {
    const double share = 0.45 / (static_cast<double>(wanted) - first);
    const double done = 0.5 + share * (static_cast<double>(data.Steps.size()) - first);
    key = {};
    key.Add(state.stages.Version(gridfem::HierarchyStage));
    key.Add(static_cast<std::int64_t>(data.Steps.size()));
    state.stages.Run(gridfem::SolveStage, key,
      [&]
      {
        gridfem::SolveReport report =
          data.Diffusion->Advance(state.MakeJob(progress.Part(done, done + share)));
        data.Steps.push_back(
          { state.space->ValuesAtPoints(data.Diffusion->Coefficients(), this->NumberOfThreads),
            std::move(report), data.Diffusion->Accuracy(), data.Diffusion->Held() });
      });
  }
}

void vtkHeatDiffusion::WriteStep(int shown, vtkPolyData* input, vtkPolyData* output)
{
  const Step& step = this->Data->Steps[static_cast<std::size_t>(shown) - 1];
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::InputArray array = gridfem::FindInputArray(this, 0, input, "Array");
  vtkDataArray* given = array.array ? array.array : input->GetPoints()->GetData();
  gridfem::MultiVector values = step.atPoints;
  if (array.association == gridfem::FieldAssociation::Points)
  {
    gridfem::KeepUnsolved(state.space->PointsWithFunctions(), given, values);
  }
  output->ShallowCopy(input);
  auto diffused = gridfem::MakePointArray("Diffused", values, VTK_DOUBLE);
  if (array.array)
  {
    diffused->CopyComponentNames(array.array);
  }
  output->GetPointData()->AddArray(diffused);
  output->GetPointData()->SetActiveScalars("Diffused");
  if (!array.array && this->MovePoints)
  {
    gridfem::MoveSurface(*state.mesh.triangles, values,
      gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
  gridfem::AddFieldInt(output, "Step", shown);
  if (this->Data->Held.values.rows() > 0)
  {
    gridfem::AddFieldNumber(output, "Misfit", step.met.misfit);
    const std::string warning = gridfem::WarningOfConstraints(step.met);
    if (!warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
  }
  this->WriteReport(step.report, step.accuracy, output);
}

void vtkHeatDiffusion::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::RequireAtLeast("DiffusionTime", this->DiffusionTime, 0.0);
  if (this->DiffusionTime == 0.0)
  {
    throw gridfem::InvalidInput("DiffusionTime is 0: nothing spreads. It must be above 0.");
  }
  this->Selection->Update(vtkSelection::GetData(inputs[2]), input);
  if ((this->NumberOfSteps > 1 || this->HoldsValues(input)) && this->Tolerance == 0.0)
  {
    state.options.accuracy = 0.0;
    state.options.solve.tolerance = gridfem::ToleranceOfSteps;
  }
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.2));
  state.UpdateSystem(progress.Part(0.2, 0.3));
  this->UpdateLoads(input);
  const double worldPerGrid = std::pow(state.space->UnitLength(), 2);
  const double step = this->DiffusionTime / this->NumberOfSteps / state.WeightInGridUnits(1.0);
  this->UpdateSteps(step);

  const int shown = ShownStep(outputs->GetInformationObject(0), this->NumberOfSteps);
  this->WriteStep(shown, input, output);
  gridfem::AddFieldNumber(output, "DiffusionTime", shown * step * worldPerGrid);
  progress.Check(1.0);
}

void vtkHeatDiffusion::FreeStages()
{
  this->Superclass::FreeStages();
  this->Selection->Free();
  *this->Data = Internals();
}

void vtkHeatDiffusion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DiffusionTime: " << this->DiffusionTime << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "MovePoints: " << this->MovePoints << "\n";
  os << indent << "Scheme: " << this->Scheme << "\n";
  os << indent << "BoundaryValues: " << this->BoundaryValues << "\n";
}
