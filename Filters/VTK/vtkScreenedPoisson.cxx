#include "vtkScreenedPoisson.h"

#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Integrals/Evaluation.h"
#include "Problems/Poisson.h"
#include "Spaces/HatLoad.h"

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

  gridfem::MultiVector ValueIntegrals;
  gridfem::MultiVector GradientIntegrals;
  /// The factor on the gradients at points or cells, if one is chosen.
  std::optional<gridfem::Field> ReadScale(const gridfem::InputMesh& mesh) const
  {
    return this->Scale.array ? std::make_optional(gridfem::ReadField(this->Scale, mesh))
                             : std::nullopt;
  }

  std::unique_ptr<gridfem::Multigrid> Hierarchy;
  gridfem::StageKey HierarchyShape; // what the hierarchy depends on but for the weight
  gridfem::PoissonSolution Solution;
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
  if (!std::isfinite(this->ScreeningWeight) || !std::isfinite(this->GradientScale))
  {
    throw gridfem::InvalidInput("ScreeningWeight and GradientScale must be finite numbers.");
  }
}

void vtkScreenedPoisson::IntegrateOnGrid(
  const gridfem::Field& value, const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::QuadratureRule& rule = gridfem::TriangleRule(this->QuadratureDegree);
  const gridfem::GridFunctions& space = state.Space();
  const gridfem::TriangleMesh& mesh = *state.basis.mesh;
  const int threads = this->NumberOfThreads;
  const std::optional<gridfem::Field> scale = data.ReadScale(state.mesh);
  data.ValueIntegrals =
    gridfem::IntegrateValues(space, mesh, value, rule, threads, progress.Part(0.0, 0.5));
  data.GradientIntegrals.resize(0, 0);
  if (data.Gradient.array)
  {
    data.GradientIntegrals =
      gridfem::IntegrateGradients(space, mesh, gridfem::ReadField(data.Gradient, state.mesh),
        scale ? &*scale : nullptr, rule, threads, progress.Part(0.5, 1.0));
  }
  else if (this->UseValueGradient && !data.Value.array)
  {
    data.GradientIntegrals = gridfem::IntegrateGradientsOfCoordinates(space, mesh,
      scale ? &*scale : nullptr, rule, this->NormalStabilization, threads, progress.Part(0.5, 1.0));
  }
  else if (this->UseValueGradient)
  {
    data.GradientIntegrals = gridfem::IntegrateGradientsOf(
      space, mesh, value, scale ? &*scale : nullptr, rule, threads, progress.Part(0.5, 1.0));
  }
  data.GradientIntegrals *= this->GradientScale;
}

void vtkScreenedPoisson::IntegrateOnHats(const gridfem::Field& value)
{
  Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::HatFunctions& hats = state.hats->functions;
  const gridfem::TriangleMesh& mesh = *state.basis.mesh;
  const int threads = this->NumberOfThreads;
  const std::optional<gridfem::Field> scale = data.ReadScale(state.mesh);
  data.ValueIntegrals = gridfem::IntegrateValues(hats, mesh, value, threads);
  data.GradientIntegrals.resize(0, 0);
  if (data.Gradient.array)
  {
    data.GradientIntegrals = gridfem::IntegrateGradients(hats, mesh,
      gridfem::ReadField(data.Gradient, state.mesh), scale ? &*scale : nullptr, threads);
  }
  else if (this->UseValueGradient)
  {
    data.GradientIntegrals =
      gridfem::IntegrateGradientsOf(hats, mesh, value, scale ? &*scale : nullptr, threads);
  }
  data.GradientIntegrals *= this->GradientScale;
}

void vtkScreenedPoisson::UpdateRightHandSide()
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey key;
  key.Add(state.stages.Version(SpaceStage)).Add(this->QuadratureDegree).Add(this->FunctionSpace);
  key.Add(this->GradientScale).Add(this->UseValueGradient);
  key.Add(this->UseValueGradient && !data.Value.array ? this->NormalStabilization : 0.0);
  for (const gridfem::InputArray* array : { &data.Value, &data.Gradient, &data.Scale })
  {
    key.Add(array->array).Add(static_cast<int>(array->association));
  }
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
    const bool update = data.Hierarchy && data.HierarchyShape == shape;
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
}

void vtkScreenedPoisson::WriteSolution(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  gridfem::MultiVector values = state.hats ? gridfem::ValuesAtPoints(state.hats->functions,
                                               data.Solution.coefficients, this->NumberOfThreads)
                                           : gridfem::EvaluateAtPoints(state.Space(),
                                               data.Solution.coefficients, this->NumberOfThreads);
  vtkDataArray* given = data.Value.array ? data.Value.array : input->GetPoints()->GetData();
  if (data.Value.association == gridfem::FieldAssociation::Points)
  {
    const std::vector<char> used = gridfem::UsedPoints(*state.mesh.triangles);
    for (gridfem::Id point = 0; point < values.rows(); ++point)
    {
      const bool isSolved = state.hats ? state.hats->functions.ofPoint[point] >= 0 : used[point];
      for (gridfem::Id c = 0; !isSolved && c < values.cols(); ++c)
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
  gridfem::AddReport(data.Solution.report, output);
}

void vtkScreenedPoisson::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  state.options.multigrid.hidden = static_cast<gridfem::HiddenCorrection>(this->HiddenCorrection);
  this->FindArrays(input);
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  progress.Check(0.3);
  state.UpdateSystem(progress.Part(0.3, 0.5));
  progress.Check(0.5);
  this->UpdateRightHandSide();
  progress.Check(0.6);
  this->UpdateHierarchy();
  progress.Check(0.7);
  this->UpdateSolution();
  this->WriteSolution(input, vtkPolyData::GetData(outputs, 0));
  const gridfem::SolveReport& report = this->Data->Solution.report;
  gridfem::WriteHistory(report, vtkTable::GetData(outputs, 1));
  if (!report.converged)
  {
    vtkWarningMacro("Not converged after "
                    << report.iterations << " iterations, because " << gridfem::ReasonOf(report)
                    << ". The energy residual is " << gridfem::LastRecord(report).energy
                    << ", the residual " << gridfem::LastRecord(report).residual << ", wanted is "
                    << this->Tolerance << ". The result is kept.");
  }
  progress.Check(1.0);
}

void vtkScreenedPoisson::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ScreeningWeight: " << this->ScreeningWeight << "\n";
  os << indent << "GradientScale: " << this->GradientScale << "\n";
  os << indent << "Iteration: " << this->Iteration << "\n";
  os << indent << "HiddenCorrection: " << this->HiddenCorrection << "\n";
  os << indent << "UseValueGradient: " << this->UseValueGradient << "\n";
}
