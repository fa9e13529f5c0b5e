#include "vtkHarmonicInterpolation.h"

#include "Private/GivenValues.h"
#include "Private/InputArray.h"
#include "Private/SelectedPoints.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Problems/HarmonicInterpolation.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"

#include <algorithm>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkHarmonicInterpolation);

namespace
{

/// The array chosen for the second data set, else the one chosen for the first, else the active
/// scalars.
gridfem::InputArray FindArrayOf(vtkAlgorithm* algorithm, vtkDataSet* values)
{
  gridfem::InputArray array = gridfem::FindInputArray(algorithm, 2, values, "SourceArray");
  if (!array.array)
  {
    array = gridfem::FindInputArray(algorithm, 0, values, "ValueArray, of the input Values,");
  }
  vtkDataArray* scalars = values->GetPointData()->GetScalars();
  if (!array.array && scalars)
  {
    array.array = scalars;
    array.name = scalars->GetName() ? scalars->GetName() : "";
  }
  gridfem::RequirePointArray(
    array, "ValueArray", "the input Values has no active scalars to take instead");
  return array;
}

/// Whether values are known at some points, but not at all of them. A NaN makes a tuple unknown.
bool KnowsSome(vtkDataArray* array)
{
  const int components = array->GetNumberOfComponents();
  vtkIdType unknown = 0;
  for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k)
  {
    int c = 0;
    while (c < components && !std::isnan(array->GetComponent(k, c)))
    {
      ++c;
    }
    unknown += c < components ? 1 : 0;
  }
  return unknown > 0 && unknown < array->GetNumberOfTuples();
}

/// ValueArray, or where none is chosen the only point array that says itself what is not known.
gridfem::InputArray FindValueArray(vtkAlgorithm* algorithm, vtkDataSet* input)
{
  gridfem::InputArray array = gridfem::FindInputArray(algorithm, 0, input, "ValueArray");
  if (array.array)
  {
    return array;
  }
  return gridfem::OnlyArray(input, [input](vtkDataArray* other, vtkDataSetAttributes* attributes)
    { return attributes == input->GetPointData() && KnowsSome(other); });
}

} // namespace

struct vtkHarmonicInterpolation::Internals
{
  gridfem::InputArray Array; // where the values come from
  gridfem::GivenValues Given;
  int GivenVersion = 0; // changes when they do
  gridfem::ConstrainedSolution Solution;
};

vtkHarmonicInterpolation::vtkHarmonicInterpolation()
  : Data(std::make_unique<Internals>()), Selection(std::make_unique<gridfem::SelectedPoints>(this))
{
  this->SetNumberOfInputPorts(4);
  this->Tolerance = 1e-6;
  this->MaximumIterations = 200;
  this->NormalStabilization = 1e-2;
}

vtkHarmonicInterpolation::~vtkHarmonicInterpolation() = default;

int vtkHarmonicInterpolation::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  if (port >= 2)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 2 ? "vtkDataSet" : "vtkSelection");
  }
  return 1;
}

void vtkHarmonicInterpolation::FindValues(vtkPolyData* input, vtkDataSet* values)
{
  Internals& data = *this->Data;
  const gridfem::InputMesh& mesh = this->State->mesh;
  gridfem::GivenValues given;
  if (values)
  {
    data.Array = FindArrayOf(this, values);
    given = gridfem::ValuesOfPlaces(data.Array, *mesh.triangles, values);
  }
  else
  {
    const gridfem::InputArray mask = gridfem::FindInputArray(this, 1, input, "MaskArray");
    given = gridfem::KnownValues(data.Array, mask, *this->Selection, *mesh.triangles);
  }
  const bool isSame = given.points == data.Given.points &&
                      given.values.cols() == data.Given.values.cols() &&
                      given.values == data.Given.values;
  data.GivenVersion += !isSame;
  data.Given = std::move(given);
}

void vtkHarmonicInterpolation::Solve(const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(data.GivenVersion);
  key.Add(this->Smoothness).Add(this->Tolerance).Add(this->MaximumIterations);
  gridfem::AddMultigrid(key, state.options.multigrid);
  state.stages.Run(gridfem::SolveStage, key,
    [&]
    {
      gridfem::InterpolationOptions options;
      options.smoothness = static_cast<gridfem::Smoothness>(this->Smoothness);
      options.multigrid = state.options.multigrid;
      options.solve = state.options.solve;
      data.Solution = gridfem::InterpolateHarmonically(*state.space,
        state.space->RowsAtPoints(data.Given.points), data.Given.values, options, progress);
    });
}

void vtkHarmonicInterpolation::Write(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::SurfaceSolverState& state = *this->State;
  gridfem::MultiVector values =
    state.space->ValuesAtPoints(data.Solution.coefficients, state.Threads());
  const std::vector<char> has = state.space->PointsWithFunctions();
  for (gridfem::Id point = 0; point < values.rows(); ++point)
  {
    if (!has[point])
    {
      values.row(point).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  auto array = gridfem::MakePointArray("Interpolated", values, data.Array.array->GetDataType());
  array->CopyComponentNames(data.Array.array);
  output->ShallowCopy(input);
  output->GetPointData()->AddArray(array);
  output->GetPointData()->SetActiveScalars("Interpolated");
  gridfem::AddReport(data.Solution.report, output);
  gridfem::AddAccuracy(data.Solution.accuracy, output);
  gridfem::AddFieldNumber(output, "Misfit", data.Solution.misfit);
}

void vtkHarmonicInterpolation::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  if (!vtkDataSet::GetData(inputs[2]))
  {
    // Before the long work.
    this->Data->Array = FindValueArray(this, input);
    gridfem::RequirePointArray(this->Data->Array, "ValueArray",
      "values at some points, with NaN, a MaskArray or a Selection for the others");
    gridfem::FindInputArray(this, 1, input, "MaskArray");
  }
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.3));
  state.UpdateSystem(progress.Part(0.3, 0.5));
  this->Selection->Update(vtkSelection::GetData(inputs[3]), input, this->JoinedInput());
  this->FindValues(input, vtkDataSet::GetData(inputs[2]));
  this->Solve(progress.Part(0.5, 0.95));
  this->Write(input, vtkPolyData::GetData(outputs, 0));

  const gridfem::ConstrainedSolution& solution = this->Data->Solution;
  if (!solution.report.converged)
  {
    vtkWarningMacro(<< gridfem::WarningOf(
                      solution.report, solution.wanted > 0.0 ? solution.wanted : this->Tolerance));
  }
  const std::string warning = gridfem::WarningOfConstraints(solution);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  const auto free = std::count(solution.isHeld.begin(), solution.isHeld.end(), 0);
  if (free > 0)
  {
    vtkWarningMacro(<< free << " of " << solution.isHeld.size()
                    << " connected components of the surface have no value: they are NaN.");
  }
  progress.Check(1.0);
}

void vtkHarmonicInterpolation::FreeStages()
{
  this->Superclass::FreeStages();
  this->Selection->Free();
  *this->Data = {};
}

void vtkHarmonicInterpolation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Smoothness: " << this->Smoothness << "\n";
}
