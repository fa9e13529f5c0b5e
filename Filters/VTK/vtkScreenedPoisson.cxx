#include "vtkScreenedPoisson.h"

#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/SolverOutput.h"
#include "Private/SurfacePoisson.h"

#include "Base/Errors.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <cmath>
#include <optional>

vtkStandardNewMacro(vtkScreenedPoisson);

struct vtkScreenedPoisson::Internals
{
  gridfem::InputArray Value;
  gridfem::InputArray Gradient;
  gridfem::InputArray Scale;

  /// The factor on the gradients at points or cells, if one is chosen.
  std::optional<gridfem::Field> ReadScale(const gridfem::InputMesh& mesh) const
  {
    return this->Scale.array ? std::make_optional(gridfem::ReadField(this->Scale, mesh))
                             : std::nullopt;
  }

  gridfem::SurfacePoisson Equation;
};

vtkScreenedPoisson::vtkScreenedPoisson() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  this->Tolerance = 1e-6;
  this->MaximumIterations = 200;
}

vtkScreenedPoisson::~vtkScreenedPoisson() = default;

int vtkScreenedPoisson::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

void vtkScreenedPoisson::FindArrays(vtkPolyData* input)
{
  Internals& data = *this->Data;
  data.Value = gridfem::FindInputArray(this, 0, input, "ValueArray");
  data.Gradient = gridfem::FindInputArray(this, 1, input, "GradientArray");
  data.Scale = gridfem::FindInputArray(this, 2, input, "GradientScaleArray");
  const int components = data.Value.array ? data.Value.array->GetNumberOfComponents() : 3;
  if (data.Gradient.array && data.Gradient.array->GetNumberOfComponents() != 3 * components)
  {
    throw gridfem::InvalidInput("GradientArray '" + data.Gradient.name + "' has " +
                                std::to_string(data.Gradient.array->GetNumberOfComponents()) +
                                " components. The values have " + std::to_string(components) +
                                ", so " + std::to_string(3 * components) +
                                " are needed: a vector for each.");
  }
  if (data.Scale.array && data.Scale.array->GetNumberOfComponents() != 1)
  {
    throw gridfem::InvalidInput(
      "GradientScaleArray '" + data.Scale.name + "' must have one component.");
  }
  if (this->UseValueGradient && !data.Gradient.array &&
      data.Value.association != gridfem::FieldAssociation::Points)
  {
    throw gridfem::InvalidInput("UseValueGradient needs values at points, but '" + data.Value.name +
                                "' is a cell array. Cell Data to Point Data converts it.");
  }
  gridfem::RequireAtLeast("ScreeningWeight", this->ScreeningWeight, 0.0);
  if (!std::isfinite(this->GradientScale))
  {
    throw gridfem::InvalidInput("GradientScale must be a finite number.");
  }
}

gridfem::PoissonLoad vtkScreenedPoisson::Integrate(
  const gridfem::FiniteElementSpace& space, const gridfem::Job& job)
{
  const Internals& data = *this->Data;
  const gridfem::InputMesh& mesh = this->State->mesh;
  const gridfem::Field value =
    data.Value.array ? gridfem::ReadField(data.Value, mesh) : gridfem::CoordinatesField(mesh);
  const std::optional<gridfem::Field> factor = data.ReadScale(mesh);
  const gridfem::Field* scale = factor ? &*factor : nullptr;
  gridfem::PoissonLoad load;
  load.values = space.LoadOfValues(value, job.Part(0.0, 0.5));
  if (data.Gradient.array)
  {
    load.gradients =
      space.LoadOfGradients(gridfem::ReadField(data.Gradient, mesh), scale, job.Part(0.5, 1.0));
  }
  else if (this->UseValueGradient)
  {
    load.gradients = data.Value.array
                       ? space.LoadOfGradientsOf(value, scale, job.Part(0.5, 1.0))
                       : space.LoadOfGradientsOfCoordinates(scale, job.Part(0.5, 1.0));
  }
  return load;
}

void vtkScreenedPoisson::Solve(const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::StageKey fields;
  fields.Add(this->UseValueGradient);
  for (const gridfem::InputArray* array : { &data.Value, &data.Gradient, &data.Scale })
  {
    fields.Add(array->array).Add(static_cast<int>(array->association));
  }
<<<<<<< HEAD
  gridfem::PoissonRequest request;
  request.weight = this->ScreeningWeight;
  request.gradientScale = this->GradientScale;
  request.iteration = static_cast<gridfem::IterationType>(this->Iteration);
  data.Equation.Update(
    *this->State, fields,
    [this](const gridfem::FiniteElementSpace& space, const gridfem::Job& job)
    { return this->Integrate(space, job); },
    request, progress);
=======
  state.stages.Run(RightHandSideStage, key,
    [&]
    {
      const gridfem::Progress progress = state.bridge.GetProgress().Part(0.5, 0.6);
      const gridfem::Field value = data.Value.array ? gridfem::ReadField(data.Value, state.mesh)
                                                    : gridfem::CoordinatesField(state.mesh);
      if (state.hats)
      {
        this->IntegrateOnHats(value);
      }
      else
      {
        this->IntegrateOnGrid(value, progress);
      }
      progress.Check(1.0);
    });
}

std::unique_ptr<gridfem::Multigrid> vtkScreenedPoisson::BuildHierarchy(double weight)
{
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress().Part(0.6, 0.7);
  if (state.hats)
  {
    return std::make_unique<gridfem::Multigrid>(
      gridfem::BuildHatMultigrid(*state.hats, state.Space(), *state.system, weight, 1.0,
        gridfem::HatCycle(state.options.multigrid), progress));
  }
  const gridfem::MultigridOptions& options = state.options.multigrid;
  if (options.hidden == gridfem::HiddenCorrection::Always && gridfem::AllowsHidden(options))
  {
    gridfem::RequireMemoryForLayers(state.Space().Finest().numberOfFunctions);
  }
  return std::make_unique<gridfem::Multigrid>(
    gridfem::BuildMultigrid(state.Space(), *state.system, weight, 1.0, options, progress));
}

void vtkScreenedPoisson::UpdateHierarchy()
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey shape;
  shape.Add(state.stages.Version(SystemStage));
  gridfem::AddMultigrid(shape, state.options.multigrid);
  const double weight = state.WeightInGridUnits(this->ScreeningWeight);
  gridfem::StageKey key = shape;
  key.Add(weight);
  const auto build = [&]
  {
    // Other threads give the same bits; so they are no reason to run, but used where it runs.
    const int threads = state.options.multigrid.threads;
    const bool update = data.Hierarchy && data.HierarchyShape == shape &&
                        data.Hierarchy->Options().threads == threads;
    if (update && state.hats)
    {
      gridfem::UpdateHatMultigrid(
        *state.hats, state.Space(), *state.system, weight, 1.0, *data.Hierarchy);
      return;
    }
    if (update)
    {
      gridfem::UpdateMultigrid(state.Space(), *state.system, weight, 1.0, *data.Hierarchy);
      return;
    }
    data.Hierarchy.reset();
    data.Hierarchy = this->BuildHierarchy(weight);
    data.HierarchyShape = shape;
  };
  state.stages.Run(HierarchyStage, key, build);
}

void vtkScreenedPoisson::UpdateSolution()
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey key;
  key.Add(state.stages.Version(HierarchyStage)).Add(state.stages.Version(RightHandSideStage));
  key.Add(this->Iteration).Add(this->Tolerance).Add(this->MaximumIterations);
  const auto solve = [&]
  {
    gridfem::PoissonOptions options;
    options.screeningWeight = state.WeightInGridUnits(this->ScreeningWeight);
    options.multigrid = state.options.multigrid;
    options.iteration = static_cast<gridfem::IterationType>(this->Iteration);
    options.solve = state.options.solve;
    const gridfem::Progress progress = state.bridge.GetProgress().Part(0.7, 0.95);
    data.Solution = state.hats
                      ? gridfem::SolvePoisson(gridfem::FunctionsOf(*state.hats), *data.Hierarchy,
                          data.ValueIntegrals, data.GradientIntegrals, options, progress)
                      : gridfem::SolvePoisson(state.Space(), *state.system, *data.Hierarchy,
                          data.ValueIntegrals, data.GradientIntegrals, options, progress);
  };
  state.stages.Run(SolveStage, key, solve);
>>>>>>> manners
}

void vtkScreenedPoisson::WriteSolution(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  gridfem::MultiVector values = data.Equation.Values(state);
  vtkDataArray* given = data.Value.array ? data.Value.array : input->GetPoints()->GetData();
  if (data.Value.association == gridfem::FieldAssociation::Points)
  {
    const std::vector<char> isSolved = state.space->PointsWithFunctions();
    for (gridfem::Id point = 0; point < values.rows(); ++point)
    {
      for (gridfem::Id c = 0; !isSolved[point] && c < values.cols(); ++c)
      {
        values(point, c) = given->GetComponent(point, static_cast<int>(c));
      }
    }
  }
  auto solution = gridfem::MakePointArray("Solution", values, given->GetDataType());
  if (data.Value.array)
  {
    solution->CopyComponentNames(data.Value.array);
  }
  output->ShallowCopy(input);
  output->GetPointData()->AddArray(solution);
  output->GetPointData()->SetActiveScalars("Solution");
  gridfem::AddReport(data.Equation.Report(), output);
}

void vtkScreenedPoisson::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  this->FindArrays(input);
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  progress.Check(0.3);
  state.UpdateSystem(progress.Part(0.3, 0.5));
  progress.Check(0.5);
  this->Solve(progress.Part(0.5, 0.95));
  this->WriteSolution(input, vtkPolyData::GetData(outputs, 0));
  gridfem::WriteHistory(this->Data->Equation.Report(), vtkTable::GetData(outputs, 1));
  const std::string warning = this->Data->Equation.Warning(this->Tolerance);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  progress.Check(1.0);
}

void vtkScreenedPoisson::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Equation = {};
}

void vtkScreenedPoisson::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ScreeningWeight: " << this->ScreeningWeight << "\n";
  os << indent << "GradientScale: " << this->GradientScale << "\n";
  os << indent << "Iteration: " << this->Iteration << "\n";
  os << indent << "UseValueGradient: " << this->UseValueGradient << "\n";
}
