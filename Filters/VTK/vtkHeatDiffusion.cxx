#include "vtkHeatDiffusion.h"

#include "Private/CanDistribute.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/GivenValues.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/MovedMeshWriter.h"
#include "Private/PipelineTime.h"
#include "Private/Ranks.h"
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

#include <cmath>
#include <numeric>

vtkStandardNewMacro(vtkHeatDiffusion);

namespace
{

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
  gridfem::InputArray Array; // none: the coordinates
  gridfem::InputArray Source;
  gridfem::InputArray Mask;
  gridfem::MultiVector Start;
  gridfem::MultiVector Sources;
  gridfem::HeldValues Held;
  std::unique_ptr<gridfem::HeatDiffusion> Diffusion;
  std::vector<Step> Steps;     // the first is step 1
  std::vector<char> IsReached; // points, by functions
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

bool vtkHeatDiffusion::HoldsValues() const
{
  return this->BoundaryValues || this->Selection->IsGiven() || this->Data->Mask.array;
}

/// Those of time 0. The space has to be up to date.
gridfem::HeldValues vtkHeatDiffusion::FindHeldValues(vtkPolyData* input)
{
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::InputArray& mask = this->Data->Mask;
  gridfem::InputArray array = this->Data->Array;
  gridfem::RequireValuesAtPoints(array, mask, *this->Selection);
  const gridfem::Field values =
    array.array ? state.Read(array) : gridfem::CoordinatesField(state.mesh);
  if (!array.array)
  {
    array.array = input && input->GetPoints() ? input->GetPoints()->GetData() : nullptr;
    array.name = "coordinates";
  }
  gridfem::HeldValues held = state.HoldKnown(array, mask, *this->Selection, values.values.cols());
  if (this->BoundaryValues)
  {
    const gridfem::BoundaryTerms terms = state.OnBoundary(nullptr, &values.values);
    if (terms.isThere)
    {
      state.Together([&] { held = gridfem::Join(held, terms.held); });
    }
    else if (gridfem::Ranks().IsFirst())
    {
      vtkWarningMacro(<< "The surface has no boundary for BoundaryValues.");
    }
  }
  return held;
}

/// The integrals of the array and of the source, and what is held. The system has to be up to date.
void vtkHeatDiffusion::UpdateLoads(vtkPolyData* input, const gridfem::Progress& progress)
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  const gridfem::InputArray& start = data.Array;
  const gridfem::InputArray& source = data.Source;
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
  key.Add(data.Mask.array);
  key.Add(this->BoundaryValues).Add(this->Selection->Version());
  state.stages.Run(gridfem::RightHandSideStage, key,
    [&]
    {
      const gridfem::SurfaceSpace& space = *state.SharedSpace();
      data.Start =
        space.LoadOfValues(start.array ? state.Read(start) : gridfem::CoordinatesField(state.mesh),
          state.MakeJob(progress.Part(0.0, 0.5)));
      data.Held = this->HoldsValues() ? this->FindHeldValues(input) : gridfem::HeldValues{};
      data.Sources = {};
      if (source.array)
      {
        // Per squared unit of length of the space.
        data.Sources = std::pow(space.UnitLength(), 2) * space.LoadOfValues(state.Read(source),
                                                           state.MakeJob(progress.Part(0.5, 1.0)));
      }
      data.IsReached = state.PointsWithFunctions();
    });
}

/// The length of a step, squared units of length of the space.
double vtkHeatDiffusion::GridStep() const
{
  return this->DiffusionTime / this->NumberOfSteps / this->State->WeightInSpaceUnits(1.0);
}

/// Makes the steps that are missing.
void vtkHeatDiffusion::UpdateSteps(const gridfem::Progress& progress)
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  const double step = this->GridStep();
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::RightHandSideStage)).Add(step);
  gridfem::AddSolver(key, state.options);
  state.stages.Run(gridfem::HierarchyStage, key,
    [&]
    {
      const gridfem::DiffusionOptions options{ state.options, step,
        gridfem::TimeScheme::SecondOrder, data.Held };
      data.Steps.clear();
      data.Diffusion.reset(); // frees its memory first
      data.Diffusion = std::make_unique<gridfem::HeatDiffusion>(state.SharedSpace(), data.Start,
        data.Sources, options, state.MakeJob(progress.Part(0.0, 0.2)));
    });
  const auto wanted = static_cast<std::size_t>(this->NumberOfSteps);
  const auto first = static_cast<double>(data.Steps.size());
  while (data.Steps.size() < wanted)
  {
    const double share = 0.8 / (static_cast<double>(wanted) - first);
    const double done = 0.2 + share * (static_cast<double>(data.Steps.size()) - first);
    key = {};
    key.Add(state.stages.Version(gridfem::HierarchyStage));
    key.Add(static_cast<std::int64_t>(data.Steps.size()));
    state.stages.Run(gridfem::SolveStage, key,
      [&]
      {
        gridfem::SolveReport report =
          data.Diffusion->Advance(state.MakeJob(progress.Part(done, done + share)));
        gridfem::SolutionAccuracy accuracy = data.Diffusion->Accuracy();
        if (state.together.IsUsed())
        {
          accuracy.largest = state.together.Largest(accuracy.largest);
        }
        data.Steps.push_back({ state.ValuesAtPoints(data.Diffusion->Coefficients()),
          std::move(report), accuracy, data.Diffusion->Held() });
      });
  }
}

void vtkHeatDiffusion::WriteStep(int shown, vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const Step& step = data.Steps[static_cast<std::size_t>(shown) - 1];
  const gridfem::SurfaceSolverState& state = *this->State;
  vtkDataArray* given = data.Array.array ? data.Array.array : input->GetPoints()->GetData();
  gridfem::MultiVector values = step.atPoints;
  if (data.Array.association == gridfem::FieldAssociation::Points)
  {
    gridfem::KeepUnsolved(data.IsReached, given, values);
  }
  output->ShallowCopy(input);
  auto diffused = gridfem::MakePointArray("Diffused", values, VTK_DOUBLE);
  if (data.Array.array)
  {
    diffused->CopyComponentNames(data.Array.array);
  }
  output->GetPointData()->AddArray(diffused);
  output->GetPointData()->SetActiveScalars("Diffused");
  if (!data.Array.array)
  {
    gridfem::MoveSurface(*state.mesh.triangles, values,
      gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
}

/// What is known of a step besides its values.
void vtkHeatDiffusion::WriteFacts(int shown, vtkPolyData* output)
{
  const Step& step = this->Data->Steps[static_cast<std::size_t>(shown) - 1];
  gridfem::AddFieldInt(output, "Step", shown);
  if (!step.met.isHeld.empty()) // the same on all ranks
  {
    gridfem::AddFieldNumber(output, "Misfit", step.met.misfit);
    const std::string warning = gridfem::WarningOfConstraints(step.met);
    if (!warning.empty() && gridfem::Ranks().IsFirst())
    {
      vtkWarningMacro(<< warning);
    }
  }
  this->WriteReport(step.report, step.accuracy, output);
  const double unit = this->State->SharedSpace()->UnitLength();
  gridfem::AddFieldNumber(output, "DiffusionTime", shown * this->GridStep() * unit * unit);
}

void vtkHeatDiffusion::RequireTime() const
{
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::RequireAtLeast("DiffusionTime", this->DiffusionTime, 0.0);
  if (this->DiffusionTime == 0.0)
  {
    throw gridfem::InvalidInput("DiffusionTime is 0: nothing spreads. It must be above 0.");
  }
}

/// Errors of several steps add up, and held values are met by steps of their own.
void vtkHeatDiffusion::ChooseTolerance()
{
  if ((this->NumberOfSteps > 1 || this->HoldsValues()) && this->Tolerance == 0.0)
  {
    this->State->options.accuracy = 0.0;
    this->State->options.solve.tolerance = gridfem::ToleranceOfSteps;
  }
}

void vtkHeatDiffusion::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  const gridfem::Progress progress = state.bridge.GetProgress();
  this->RequireTime();
  this->Selection->Update(vtkSelection::GetData(inputs[2]), input);
  data.Array = gridfem::FindInputArray(this, 0, input, "Array");
  data.Source = gridfem::FindInputArray(this, 1, input, "HeatSourceArray");
  data.Mask = gridfem::FindInputArray(this, 2, input, "ConstraintArray");
  this->ChooseTolerance();
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.2));
  state.UpdateSystem(progress.Part(0.2, 0.3));
  this->UpdateLoads(input, progress.Part(0.3, 0.4));
  this->UpdateSteps(progress.Part(0.4, 0.95));

  const int shown = gridfem::ShownStep(outputs->GetInformationObject(0), 1, this->NumberOfSteps);
  this->WriteStep(shown, input, output);
  this->WriteFacts(shown, output);
  progress.Check(1.0);
}

bool vtkHeatDiffusion::ComputeTogether(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  gridfem::SurfaceSolverState& state = *this->State;
  const bool moves = !gridfem::IsArrayChosen(this, 0);
  if (!gridfem::CanDistribute(this, inputs, moves))
  {
    return false;
  }
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  Internals& data = *this->Data;
  state.RunTogether(
    [&](const gridfem::Progress& progress)
    {
      state.together.Together([&] { this->RequireTime(); });
      this->Selection->UpdateTogether(state.together, vtkSelection::GetData(inputs[2]), piece);
      state.UpdateTogether(piece, vtkPolyData::GetData(inputs[1]));
      progress.Check(0.3);
      data.Mask = state.together.Find(this, 2, piece, state.mesh, "ConstraintArray");
      this->ChooseTolerance();
      data.Array = state.together.Find(this, 0, piece, state.mesh, "Array");
      data.Source = state.together.Find(this, 1, piece, state.mesh, "HeatSourceArray");
      this->UpdateLoads(piece, progress.Part(0.3, 0.4));
      this->UpdateSteps(progress.Part(0.4, 0.95));
      state.together.Together([&] { this->WriteDistributed(piece, outputs); });
    });
  return true;
}

void vtkHeatDiffusion::WriteDistributed(vtkPolyData* piece, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const int shown = gridfem::ShownStep(outputs->GetInformationObject(0), 1, this->NumberOfSteps);
  if (piece && piece->GetPoints())
  {
    this->WriteStep(shown, piece, output);
  }
  this->WriteFacts(shown, output);
  gridfem::AddDistributed(this->State->together.Depth(), output);
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
  os << indent << "BoundaryValues: " << this->BoundaryValues << "\n";
}
