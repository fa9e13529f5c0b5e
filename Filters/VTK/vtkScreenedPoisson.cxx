#include "vtkScreenedPoisson.h"

#include "Private/ClippedMeshWriter.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/MovedMeshWriter.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceConstrainedPoisson.h"
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

namespace
{

/// Of the energy residual, where no Tolerance is given.
constexpr double ConstrainedTolerance = 1e-6;

} // namespace

struct vtkScreenedPoisson::Internals
{
  gridfem::InputArray Value;
  gridfem::InputArray Gradient;
  gridfem::InputArray Scale;
  gridfem::InputArray Weight;
  gridfem::InputArray Constraint;
  gridfem::InputArray Coordinates; // stand in for Value

  /// The factor on the gradients at points or cells, if one is chosen.
  std::optional<gridfem::Field> ReadScale(const gridfem::InputMesh& mesh) const
  {
    return this->Scale.array ? std::make_optional(gridfem::ReadField(this->Scale, mesh))
                             : std::nullopt;
  }

  gridfem::SurfacePoisson Equation;
  gridfem::SurfaceConstrainedPoisson Constrained;
};

vtkScreenedPoisson::vtkScreenedPoisson() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  this->Tolerance = 0.0;
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
  this->State->metricArray = gridfem::FindInputArray(this, 5, input, "MetricArray");
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
  gridfem::RequireNumber("Accuracy", this->Accuracy);
  gridfem::RequireAtLeast("ScreeningWeight", this->ScreeningWeight, 0.0);
  if (!std::isfinite(this->GradientScale))
  {
    throw gridfem::InvalidInput("GradientScale must be a finite number.");
  }
}

void vtkScreenedPoisson::FindConstraints(vtkPolyData* input)
{
  Internals& data = *this->Data;
  data.Weight = gridfem::FindInputArray(this, 3, input, "ValueWeightArray");
  data.Constraint = gridfem::FindInputArray(this, 4, input, "ConstraintArray");
  data.Coordinates.array = input->GetPoints()->GetData();
  data.Coordinates.name = "coordinates";
  if (data.Weight.array && data.Weight.array->GetNumberOfComponents() != 1)
  {
    throw gridfem::InvalidInput(
      "ValueWeightArray '" + data.Weight.name + "' must have one component.");
  }
  if (data.Constraint.array && data.Value.association != gridfem::FieldAssociation::Points)
  {
    throw gridfem::InvalidInput("ConstraintArray needs values at points, but '" + data.Value.name +
                                "' is a cell array. Cell Data to Point Data converts it.");
  }
  if (this->IsConstrained() && this->Iteration != ConjugateGradients)
  {
    throw gridfem::InvalidInput("Constraints, weights and unknown values need Iteration to be "
                                "ConjugateGradients.");
  }
}

bool vtkScreenedPoisson::IsConstrained() const
{
  return this->FillUnknown || this->Data->Weight.array || this->Data->Constraint.array;
}

const gridfem::SolveReport& vtkScreenedPoisson::Report() const
{
  return this->IsConstrained() ? this->Data->Constrained.Report() : this->Data->Equation.Report();
}

gridfem::SolutionAccuracy vtkScreenedPoisson::EstimatedErrors() const
{
  return this->IsConstrained() ? gridfem::SolutionAccuracy{} : this->Data->Equation.Accuracy();
}

gridfem::ConstrainedLoad vtkScreenedPoisson::IntegrateConstrained(
  const gridfem::FiniteElementSpace& space, const gridfem::Job& job)
{
  const Internals& data = *this->Data;
  const gridfem::InputMesh& mesh = this->State->mesh;
  const gridfem::TriangleMesh& triangles = *mesh.triangles;
  const auto weight =
    data.Weight.array ? std::make_optional(gridfem::ReadField(data.Weight, mesh)) : std::nullopt;
  const gridfem::InputArray& value = data.Value.array ? data.Value : data.Coordinates;
  gridfem::ConstrainedLoad load;
  load.field =
    gridfem::SplitField(gridfem::ReadField(value, mesh,
                          this->FillUnknown ? gridfem::NaNs::Kept : gridfem::NaNs::Refused),
      weight ? &*weight : nullptr, triangles);
  if (data.Constraint.array)
  {
    load.held = gridfem::KnownValues(value, data.Constraint, triangles);
  }
  else
  {
    load.held.values.resize(0, load.field.values.values.cols());
  }
  const auto factor = data.ReadScale(mesh);
  if (data.Gradient.array)
  {
    load.gradients = space.LoadOfGradients(
      gridfem::ReadField(data.Gradient, mesh), factor ? &*factor : nullptr, job);
  }
  else if (this->UseValueGradient)
  {
    // Where a corner is unknown there is no gradient.
    const gridfem::Field known =
      gridfem::ScaleOfKnown(load.field, factor ? &*factor : nullptr, triangles);
    load.gradients = space.LoadOfGradientsOf(load.field.values, &known, job);
  }
  return load;
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
  gridfem::PoissonRequest request;
  request.weight = this->ScreeningWeight;
  request.gradientScale = this->GradientScale;
  request.accuracy = this->Tolerance == 0.0 ? this->Accuracy : 0.0;
  request.iteration = static_cast<gridfem::IterationType>(this->Iteration);
  if (this->IsConstrained())
  {
    if (this->Tolerance == 0.0)
    {
      this->State->options.solve.tolerance = ConstrainedTolerance;
    }
    fields.Add(data.Weight.array).Add(static_cast<int>(data.Weight.association));
    fields.Add(data.Constraint.array).Add(this->FillUnknown);
    data.Constrained.Update(
      *this->State, fields,
      [this](const gridfem::FiniteElementSpace& space, const gridfem::Job& job)
      { return this->IntegrateConstrained(space, job); },
      request, progress);
    return;
  }
  data.Equation.Update(
    *this->State, fields,
    [this](const gridfem::FiniteElementSpace& space, const gridfem::Job& job)
    { return this->Integrate(space, job); },
    request, progress);
}

void vtkScreenedPoisson::WriteSolution(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  gridfem::MultiVector values =
    this->IsConstrained() ? data.Constrained.Values(state) : data.Equation.Values(state);
  vtkDataArray* given = data.Value.array ? data.Value.array : input->GetPoints()->GetData();
  if (data.Value.association == gridfem::FieldAssociation::Points)
  {
    gridfem::KeepUnsolved(state.space->PointsWithFunctions(), given, values);
  }
  auto solution = gridfem::MakePointArray("Solution", values, given->GetDataType());
  if (data.Value.array)
  {
    solution->CopyComponentNames(data.Value.array);
  }
  output->ShallowCopy(input);
  output->GetPointData()->AddArray(solution);
  output->GetPointData()->SetActiveScalars("Solution");
  if (!data.Value.array && this->MovePoints)
  {
    gridfem::MoveSurface(*state.mesh.triangles, values,
      gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
  gridfem::AddReport(this->Report(), output);
  gridfem::AddAccuracy(this->EstimatedErrors(), output);
  if (data.Constraint.array)
  {
    gridfem::AddFieldNumber(output, "Misfit", data.Constrained.Misfit());
  }
}

void vtkScreenedPoisson::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  this->FindArrays(input);
  this->FindConstraints(input);
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  progress.Check(0.3);
  state.UpdateSystem(progress.Part(0.3, 0.5));
  progress.Check(0.5);
  this->Solve(progress.Part(0.5, 0.95));
  this->WriteSolution(input, vtkPolyData::GetData(outputs, 0));
  vtkTable* table = vtkTable::GetData(outputs, 1);
  gridfem::WriteHistory(this->Report(), table);
  gridfem::AddErrors(this->Report(), this->EstimatedErrors(), table);
  const Internals& data = *this->Data;
  const std::string warning = this->IsConstrained()
                                ? data.Constrained.Warning(state.options.solve.tolerance)
                                : data.Equation.Warning(this->Tolerance);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  progress.Check(1.0);
}

void vtkScreenedPoisson::SetTolerance(double tolerance)
{
  if (!(tolerance <= 0.0)) // NaN is refused when the filter runs
  {
    this->Superclass::SetTolerance(tolerance);
  }
  else if (this->Tolerance != 0.0)
  {
    this->Tolerance = 0.0;
    this->Modified();
  }
}

void vtkScreenedPoisson::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Equation = {};
  this->Data->Constrained = {};
}

void vtkScreenedPoisson::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ScreeningWeight: " << this->ScreeningWeight << "\n";
  os << indent << "GradientScale: " << this->GradientScale << "\n";
  os << indent << "Accuracy: " << this->Accuracy << "\n";
  os << indent << "Iteration: " << this->Iteration << "\n";
  os << indent << "FillUnknown: " << this->FillUnknown << "\n";
  os << indent << "MovePoints: " << this->MovePoints << "\n";
  os << indent << "UseValueGradient: " << this->UseValueGradient << "\n";
}
