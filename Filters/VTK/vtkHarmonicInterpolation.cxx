#include "vtkHarmonicInterpolation.h"

#include "Input/GivenValues.h"
#include "Input/InputArray.h"
#include "Input/JoinedArrays.h"
#include "Input/PropertyList.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Solvers/InterpolationSolver.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <array>
#include <vector>

vtkStandardNewMacro(vtkHarmonicInterpolation);

namespace
{

/// Whether values are known at some points, but not at all of them. A NaN makes a tuple unknown.
bool KnowsSome(vtkDataArray* array)
{
  gridfem::InputArray one;
  one.array = array;
  vtkIdType unknown = 0;
  for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k)
  {
    unknown += gridfem::IsUnknown(one, k) ? 1 : 0;
  }
  return unknown > 0 && unknown < array->GetNumberOfTuples();
}

/// Returns ValueArray. If none is chosen, it returns the only point array whose NaN mark the
/// unknown values.
gridfem::InputArray FindValueArray(vtkAlgorithm* algorithm, vtkDataSet* input)
{
  gridfem::InputArray array = gridfem::FindInputArray(algorithm, 0, input, "Value Array");
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
  gridfem::InputArray Array; // where the values come from; none for the table
  gridfem::JoinedArrays Arrays;
  std::vector<std::array<double, 2>> Table;
  std::vector<std::string> FarValues; // warnings of this run
  gridfem::InterpolationSolver Solver;

  void Write(const gridfem::MultiVector& values, vtkPointData* points) const
  {
    if (this->Array.array)
    {
      this->Arrays.AddSolutions("Interpolated", values, points);
      return;
    }
    points->AddArray(gridfem::MakePointArray("Interpolated", values, VTK_DOUBLE));
    points->SetActiveScalars("Interpolated");
  }
};

vtkHarmonicInterpolation::vtkHarmonicInterpolation() : Data(std::make_unique<Internals>())
{
  this->SetSelectionPort(3);
  this->Tolerance = 1e-6;
  this->MaximumIterations = 200;
  this->NormalStabilization = 1e-2;
}

vtkHarmonicInterpolation::~vtkHarmonicInterpolation() = default;

gridfem::GivenConstraints vtkHarmonicInterpolation::FindValues(
  vtkPolyData* input, vtkDataSet* places)
{
  gridfem::InputArray& array = this->Data->Array;
  gridfem::InputSurface& surface = this->State->Surface();
  gridfem::GivenConstraints values;
  if (places)
  {
    array = this->Data->Arrays.Join(this, surface,
      gridfem::FindArrayOfPlaces(this, places, "Values", "Value Array"), "Value Array",
      [this, places](int index, const std::string& property)
      {
        return gridfem::FindArrayAmongPlaces(
          this, index, places, "In the input Values, the " + property);
      });
    values.find = [this, array, places, &surface] {
      return gridfem::ValuesOfPlaces(
        array, surface.Mesh(), places, "Values", this->Data->FarValues);
    };
    return values;
  }
  array = FindValueArray(this, input);
  if (!array.array && !this->Data->Table.empty())
  {
    return this->ReadTable();
  }
  gridfem::RequirePointArray(array, "Value Array",
    "Mark the known points by a Mask Array or a selection, or put NaN at the unknown points. "
    "Or type points with their values into Known Values.");
  array = this->Data->Arrays.Join(this, surface, array, "Value Array");
  const gridfem::InputArray mask = surface.Find(1, "Mask Array");
  values.find = [this, array, mask, &surface]
  { return gridfem::KnownValues(array, mask, *this->Selection, surface.Mesh()); };
  return values;
}

gridfem::GivenConstraints vtkHarmonicInterpolation::ReadTable()
{
  gridfem::InputSurface& surface = this->State->Surface();
  gridfem::GivenConstraints values;
  values.find = [this, &surface]
  {
    std::string outside;
    gridfem::PointValues given = gridfem::TypedValues(this->Data->Table, surface.Mesh(), outside);
    if (given.points.empty())
    {
      throw gridfem::MissingChoice(
        "No point of Known Values is on the surface. Type ids of points of the surface.");
    }
    if (!outside.empty())
    {
      this->Warn({ "These points of Known Values are not on the surface, and do not count: " +
                   outside + "." });
    }
    return given;
  };
  return values;
}

void vtkHarmonicInterpolation::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  Internals& data = *this->Data;
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  this->ReadSelection(inputs);
  data.FarValues.clear();
  const gridfem::GivenConstraints values = this->FindValues(input, vtkDataSet::GetData(inputs[2]));
  gridfem::InterpolationSolver::Options options;
  options.equation = state.options;
  options.smoothness = static_cast<gridfem::Smoothness>(this->Smoothness);
  const gridfem::InterpolationSolver::Result& result =
    data.Solver.Update(surface, { values }, options, { 0, state.GetProgress() });

  output->ShallowCopy(input);
  data.Write(result.atPoints, output->GetPointData());
  gridfem::AddReport(result.report, output);
  gridfem::AddAccuracy(result.accuracy, output);
  gridfem::AddFieldNumber(output, "Misfit", result.misfit);
  this->Warn(data.FarValues);
  this->Warn(result.warnings);
}

void vtkHarmonicInterpolation::AddFurtherArray(const char* name)
{
  gridfem::AddFurtherArray(this, name);
}

void vtkHarmonicInterpolation::ClearFurtherArrays()
{
  gridfem::ClearFurtherArrays(this);
}

void vtkHarmonicInterpolation::AddKnownValue(double point, double value)
{
  gridfem::AddToList(this->Data->Table, { point, value }, this);
}

void vtkHarmonicInterpolation::ClearKnownValues()
{
  gridfem::ClearList(this->Data->Table, this);
}

int vtkHarmonicInterpolation::GetNumberOfKnownValues()
{
  return static_cast<int>(this->Data->Table.size());
}

void vtkHarmonicInterpolation::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Array = gridfem::InputArray();
  this->Data->Arrays = gridfem::JoinedArrays();
  this->Data->Solver = gridfem::InterpolationSolver();
}

void vtkHarmonicInterpolation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Smoothness: " << this->Smoothness << "\n";
  os << indent << "KnownValues: " << this->GetNumberOfKnownValues() << "\n";
}
