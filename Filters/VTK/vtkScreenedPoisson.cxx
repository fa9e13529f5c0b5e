#include "vtkScreenedPoisson.h"

#include "Private/CanDistribute.h"
#include "Private/ClippedArrays.h"
#include "Private/ClippedMeshWriter.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/MovedMeshWriter.h"
#include "Private/Ranks.h"
#include "Private/SelectedPoints.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceConstrainedPoisson.h"
#include "Private/SurfacePoisson.h"

#include "Base/Errors.h"
#include "Problems/DepthSearch.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
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
  gridfem::InputArray Flux;
  gridfem::InputArray Coordinates; // stand in for Value

  /// The factor on the gradients at points or cells, if one is chosen.
  std::optional<gridfem::Field> ReadScale(const gridfem::SurfaceSolverState& state) const
  {
    return this->Scale.array ? std::make_optional(state.Read(this->Scale)) : std::nullopt;
  }

  /// Of all ranks together, on this one's piece, until they are written.
  struct
  {
    gridfem::MultiVector Values;
    std::vector<char> IsSolved;
  } Together;

  gridfem::DepthSearch Search; // for the WantedError
  gridfem::StageKey Searched;  // all that its answer depends on
  gridfem::SurfacePoisson Equation;
  gridfem::SurfaceConstrainedPoisson Constrained;
};

vtkScreenedPoisson::vtkScreenedPoisson()
  : Data(std::make_unique<Internals>()), Selection(std::make_unique<gridfem::SelectedPoints>(this))
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
}

vtkScreenedPoisson::~vtkScreenedPoisson() = default;

int vtkScreenedPoisson::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkSelection");
  }
  return 1;
}

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
  gridfem::RequireNumber("WantedError", this->WantedError);
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
  if (this->HoldsValues())
  {
    gridfem::RequireValuesAtPoints(data.Value, data.Constraint, *this->Selection);
  }
  this->FindFlux(input);
}

void vtkScreenedPoisson::FindFlux(vtkPolyData* input)
{
  Internals& data = *this->Data;
  data.Flux = gridfem::FindInputArray(this, 6, input, "BoundaryFluxArray");
  const int components = data.Value.array ? data.Value.array->GetNumberOfComponents() : 3;
  if (data.Flux.array && (data.Flux.association != gridfem::FieldAssociation::Points ||
                           data.Flux.array->GetNumberOfComponents() != components))
  {
    throw gridfem::InvalidInput("BoundaryFluxArray '" + data.Flux.name +
                                "' must be a point array with as many components as the values, " +
                                std::to_string(components) + ".");
  }
  if (data.Flux.array && this->State->options.trackMetric)
  {
    throw gridfem::InvalidInput(
      "BoundaryFluxArray and TrackMetric do not go together: a flux is per "
      "length of the boundary as it was when the functions were made.");
  }
  if (data.Flux.array && this->State->metricArray.array)
  {
    throw gridfem::InvalidInput(
      "BoundaryFluxArray and MetricArray do not go together: a flux is per "
      "length of the surface's own boundary.");
  }
}

bool vtkScreenedPoisson::HoldsPoints() const
{
  return this->Data->Constraint.array || this->Selection->IsGiven();
}

bool vtkScreenedPoisson::HoldsValues() const
{
  return this->BoundaryValues || this->HoldsPoints();
}

bool vtkScreenedPoisson::IsConstrained() const
{
  return this->FillUnknown || this->Data->Weight.array || this->Data->Flux.array ||
         this->HoldsValues();
}

const gridfem::SolveReport& vtkScreenedPoisson::Report() const
{
  return this->IsConstrained() ? this->Data->Constrained.Report() : this->Data->Equation.Report();
}

gridfem::SolutionAccuracy vtkScreenedPoisson::EstimatedErrors() const
{
  return this->IsConstrained() ? this->Data->Constrained.Accuracy()
                               : this->Data->Equation.Accuracy();
}

gridfem::ConstrainedLoad vtkScreenedPoisson::IntegrateConstrained(const gridfem::Job& job)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::SurfaceSpace& space = *state.SharedSpace();
  const gridfem::TriangleMesh& triangles = *state.mesh.triangles;
  const auto weight =
    data.Weight.array ? std::make_optional(state.Read(data.Weight)) : std::nullopt;
  const gridfem::Field value =
    data.Value.array
      ? state.Read(data.Value, this->FillUnknown ? gridfem::NaNs::Kept : gridfem::NaNs::Refused)
      : gridfem::CoordinatesField(state.CurrentInput());
  gridfem::ConstrainedLoad load;
  load.isWeighed = weight || this->FillUnknown;
  state.Together(
    [&] { load.field = gridfem::SplitField(value, weight ? &*weight : nullptr, triangles); });
  load.field.numberOfIgnoredPoints = gridfem::CountIgnoredPoints(space, load.field, triangles);
  load.held = state.HoldKnown(data.Value.array ? data.Value : data.Coordinates, data.Constraint,
    *this->Selection, value.values.cols());
  if (this->BoundaryValues || data.Flux.array)
  {
    this->AddBoundary(value, load);
  }
  const auto factor = data.ReadScale(state);
  if (data.Gradient.array)
  {
    load.gradients = space.LoadOfGradients(
      state.OnReference(state.Read(data.Gradient)), factor ? &*factor : nullptr, job);
  }
  else if (this->UseValueGradient)
  {
    // Where a corner is unknown there is no gradient.
    gridfem::Field known;
    state.Together(
      [&] { known = gridfem::ScaleOfKnown(load.field, factor ? &*factor : nullptr, triangles); });
    load.gradients = space.LoadOfGradientsOf(load.field.values, &known, job);
  }
  return load;
}

void vtkScreenedPoisson::AddBoundary(const gridfem::Field& value, gridfem::ConstrainedLoad& load)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  gridfem::MultiVector flux;
  if (data.Flux.array)
  {
    flux = state.Read(data.Flux).values;
  }
  gridfem::BoundaryTerms terms = state.OnBoundary(
    data.Flux.array ? &flux : nullptr, this->BoundaryValues ? &value.values : nullptr);
  if (!terms.isThere)
  {
    load.warning = "The surface has no boundary for BoundaryValues or a BoundaryFluxArray.";
    return;
  }
  load.flux = std::move(terms.load);
  if (this->BoundaryValues)
  {
    state.Together([&] { load.held = gridfem::Join(load.held, terms.held); });
  }
}

gridfem::PoissonLoad vtkScreenedPoisson::Integrate(
  const gridfem::SurfaceSpace& space, const gridfem::Job& job)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Field value =
    data.Value.array ? state.Read(data.Value) : gridfem::CoordinatesField(state.CurrentInput());
  const std::optional<gridfem::Field> factor = data.ReadScale(state);
  const gridfem::Field* scale = factor ? &*factor : nullptr;
  gridfem::PoissonLoad load;
  load.values = space.LoadOfValues(value, job.Part(0.0, 0.5));
  if (data.Gradient.array)
  {
    load.gradients = space.LoadOfGradients(
      state.OnReference(state.Read(data.Gradient)), scale, job.Part(0.5, 1.0));
  }
  else if (this->UseValueGradient)
  {
    const bool isValue = data.Value.array || &state.CurrentInput() != &state.mesh;
    load.gradients = isValue ? space.LoadOfGradientsOf(value, scale, job.Part(0.5, 1.0))
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
  if (this->IsConstrained())
  {
    if (this->Tolerance == 0.0)
    {
      this->State->options.solve.tolerance = ConstrainedTolerance;
    }
    fields.Add(data.Weight.array).Add(static_cast<int>(data.Weight.association));
    fields.Add(data.Constraint.array).Add(this->FillUnknown);
    fields.Add(data.Flux.array).Add(this->BoundaryValues).Add(this->Selection->Version());
    data.Constrained.Update(
      *this->State, fields,
      [this](const gridfem::Job& job) { return this->IntegrateConstrained(job); }, request,
      progress);
    return;
  }
  data.Equation.Update(
    *this->State, fields,
    [this](const gridfem::SurfaceSpace& space, const gridfem::Job& job)
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
  if (!data.Value.array)
  {
    gridfem::MoveSurface(*state.CurrentInput().triangles, values,
      gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
  gridfem::AddReport(this->Report(), output);
  gridfem::AddAccuracy(this->EstimatedErrors(), output);
  state.WriteTracking(output);
  if (this->HoldsValues())
  {
    gridfem::AddFieldNumber(output, "Misfit", data.Constrained.Misfit());
  }
}

void vtkScreenedPoisson::SolveAtDepth(
  vtkPolyData* input, vtkPolyData* basis, const gridfem::Progress& progress)
{
  gridfem::SurfaceSolverState& state = *this->State;
  state.UpdateSpace(input, basis, progress.Part(0.0, 0.3));
  progress.Check(0.3);
  state.UpdateSystem(progress.Part(0.3, 0.5));
  progress.Check(0.5);
  this->Solve(progress.Part(0.5, 1.0));
}

void vtkScreenedPoisson::SolveAccurately(vtkPolyData* input, const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey asked;
  gridfem::AddMesh(asked, input);
  asked.Add(static_cast<std::int64_t>(this->GetMTime())).Add(this->Selection->Version());
  for (const gridfem::InputArray* array : { &data.Value, &data.Gradient, &data.Scale, &data.Weight,
         &data.Constraint, &data.Flux, &state.metricArray })
  {
    asked.Add(array->array).Add(static_cast<int>(array->association));
  }
  if (!(data.Search.IsFound() && asked == data.Searched))
  {
    data.Search = {};
    data.Searched = asked;
  }
  int solved = 0;
  for (double done = 0.0; solved != data.Search.Depth(); done = 0.5 + 0.5 * done)
  {
    solved = data.Search.Depth();
    state.options.space.depth = solved;
    this->SolveAtDepth(input, nullptr, progress.Part(done, 0.5 + 0.5 * done));
    data.Search.Judge(*state.mesh.triangles, this->EstimatedErrors(), this->WantedError);
  }
}

bool vtkScreenedPoisson::IsAccurate() const
{
  return this->WantedError == 0.0 || this->EstimatedErrors().discretization <= this->WantedError;
}

void vtkScreenedPoisson::Warn()
{
  const Internals& data = *this->Data;
  const std::string warning =
    this->IsConstrained()
      ? data.Constrained.Warning(this->State->options.solve.tolerance)
      : gridfem::WarningOf(data.Equation.Report(), data.Equation.Accuracy(), this->Tolerance);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  if (!this->IsAccurate())
  {
    vtkWarningMacro(<< gridfem::WarningOfWantedError(this->WantedError,
                      this->EstimatedErrors().discretization, this->State->options.choice.kind));
  }
}

void vtkScreenedPoisson::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* basis = vtkPolyData::GetData(inputs[1]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const gridfem::Progress progress = this->State->bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  this->State->options.trackMetric = this->TrackMetric && this->WantedError == 0.0;
  this->FindArrays(input);
  this->Selection->Update(vtkSelection::GetData(inputs[2]), input);
  this->FindConstraints(input);
  const bool hasBasis = basis || gridfem::CarriesBasis(input);
  if (this->WantedError > 0.0 && !hasBasis &&
      gridfem::IsRefinedByDepth(this->State->options.choice.kind))
  {
    this->SolveAccurately(input, progress.Part(0.0, 0.95));
  }
  else
  {
    this->SolveAtDepth(input, basis, progress.Part(0.0, 0.95));
  }
  this->WriteSolution(input, output);
  if (!this->IsAccurate())
  {
    gridfem::AddFieldInt(output, "Converged", 0);
  }
  this->WriteTables(outputs);
  progress.Check(1.0);
}

/// The history, and what it gives reason to warn of.
void vtkScreenedPoisson::WriteTables(vtkInformationVector* outputs)
{
  vtkTable* table = vtkTable::GetData(outputs, 1);
  gridfem::WriteHistory(this->Report(), table);
  gridfem::AddErrors(this->Report(), this->EstimatedErrors(), table);
  this->Warn();
}

bool vtkScreenedPoisson::ComputeTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const bool needsAll = this->WantedError > 0.0 || this->TrackMetric ||
                        gridfem::IsArrayChosen(this, 5) || !gridfem::IsArrayChosen(this, 0);
  if (!gridfem::CanDistribute(this, inputs, needsAll))
  {
    return false;
  }
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  this->State->RunTogether(
    [&](const gridfem::Progress& progress)
    {
      this->Selection->UpdateTogether(
        this->State->together, vtkSelection::GetData(inputs[2]), piece);
      this->SolveTogether(inputs, outputs, progress);
    });
  return true;
}

/// Port 0 is the rank's own piece with the solution; the table is on the first rank.
void vtkScreenedPoisson::SolveTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs, const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  state.options.trackMetric = false;
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  state.UpdateTogether(piece, vtkPolyData::GetData(inputs[1]));
  progress.Check(0.4);
  state.together.Together(
    [&]
    {
      data.Value = data.Gradient = data.Scale = {};
      data.Weight = data.Constraint = data.Flux = data.Coordinates = {};
      if (!state.mesh.triangles->triangles.empty())
      {
        this->FindArrays(piece);
        this->FindConstraints(piece);
      }
    });
  state.together.Agree(0, data.Value);
  state.together.Agree(1, data.Gradient);
  state.together.Agree(2, data.Scale);
  state.together.Agree(3, data.Weight);
  state.together.Agree(4, data.Constraint);
  state.together.Agree(6, data.Flux);
  this->Solve(progress.Part(0.4, 1.0));

  data.Together.Values =
    this->IsConstrained() ? data.Constrained.Values(state) : data.Equation.Values(state);
  data.Together.IsSolved = state.PointsWithFunctions();
  state.together.Together([&] { this->WriteDistributed(piece, outputs); });
  data.Together = {};
}

void vtkScreenedPoisson::WriteDistributed(vtkPolyData* piece, vtkInformationVector* outputs)
{
  Internals& data = *this->Data;
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  if (piece)
  {
    output->ShallowCopy(piece);
    vtkDataArray* given = data.Value.array     ? data.Value.array
                          : piece->GetPoints() ? piece->GetPoints()->GetData()
                                               : nullptr;
    if (given && data.Value.association == gridfem::FieldAssociation::Points)
    {
      gridfem::KeepUnsolved(data.Together.IsSolved, given, data.Together.Values);
    }
    auto array = gridfem::MakePointArray("Solution", data.Together.Values,
      data.Value.array ? this->State->together.DataTypeOf(0)
      : given          ? given->GetDataType()
                       : VTK_DOUBLE);
    if (data.Value.array)
    {
      array->CopyComponentNames(data.Value.array);
    }
    output->GetPointData()->AddArray(array);
    output->GetPointData()->SetActiveScalars("Solution");
  }
  gridfem::AddReport(this->Report(), output);
  gridfem::AddAccuracy(this->EstimatedErrors(), output);
  if (this->HoldsValues())
  {
    gridfem::AddFieldNumber(output, "Misfit", data.Constrained.Misfit());
  }
  gridfem::AddDistributed(this->State->together.Depth(), output);
  if (gridfem::Ranks().IsFirst())
  {
    this->WriteTables(outputs);
  }
}

void vtkScreenedPoisson::FreeStages()
{
  this->Superclass::FreeStages();
  this->Selection->Free();
  this->Data->Search = {};
  this->Data->Equation = {};
  this->Data->Constrained = {};
}

void vtkScreenedPoisson::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ScreeningWeight: " << this->ScreeningWeight << "\n";
  os << indent << "GradientScale: " << this->GradientScale << "\n";
  os << indent << "TrackMetric: " << this->TrackMetric << "\n";
  os << indent << "WantedError: " << this->WantedError << "\n";
  os << indent << "FillUnknown: " << this->FillUnknown << "\n";
  os << indent << "BoundaryValues: " << this->BoundaryValues << "\n";
  os << indent << "UseValueGradient: " << this->UseValueGradient << "\n";
}
