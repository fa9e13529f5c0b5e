#include "vtkStitchColors.h"

#include "Input/InputArray.h"
#include "Input/InputValidation.h"
#include "Output/ClippedArrays.h"
#include "Output/InterpolatedArrays.h"
#include "Output/SolverOutput.h"
#include "Pipeline/Allocation.h"
#include "Pipeline/FilterState.h"

#include "Base/Errors.h"
#include "Solvers/StitchSolver.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

vtkStandardNewMacro(vtkStitchColors);

namespace
{

/// Whether an array has the form in which readers of scans give colors.
bool AreColors(vtkDataArray* array)
{
  return array->GetDataType() == VTK_UNSIGNED_CHAR && array->GetNumberOfComponents() >= 3 &&
         array->GetNumberOfComponents() <= 4;
}

/// Whether an array numbers or marks points and cells for another purpose than to tell scans apart.
bool IsForOtherEnds(vtkDataArray* array, vtkDataSetAttributes* attributes)
{
  const char* name = array->GetName();
  return array == attributes->GetGlobalIds() || array == attributes->GetPedigreeIds() ||
         (name && (std::string(name) == vtkDataSetAttributes::GhostArrayName() ||
                    gridfem::IsClipCellArray(name)));
}

/// Whether an array has integers that each appear at least twice on average.
bool AreLabels(vtkDataArray* array)
{
  constexpr std::size_t MostScans = 1000;
  const bool isReal = gridfem::IsReal(array);
  if (isReal || array->GetNumberOfComponents() != 1)
  {
    return false;
  }
  const auto most = std::min(MostScans, static_cast<std::size_t>(array->GetNumberOfTuples() / 2));
  std::set<double> labels;
  for (vtkIdType k = 0; k < array->GetNumberOfTuples() && labels.size() <= most; ++k)
  {
    labels.insert(array->GetComponent(k, 0));
  }
  return labels.size() >= 2 && labels.size() <= most;
}

gridfem::InputArray FindColors(vtkAlgorithm* algorithm, vtkPolyData* input)
{
  gridfem::InputArray colors = gridfem::FindInputArray(algorithm, 0, input, "Color Array");
  if (!colors.array)
  {
    colors = gridfem::OnlyArray(input, [](vtkDataArray* array, auto) { return AreColors(array); });
  }
  if (!colors.array)
  {
    throw gridfem::MissingChoice("Choose a Color Array with the colors of the scans.");
  }
  return colors;
}

gridfem::InputArray FindLabels(vtkAlgorithm* algorithm, vtkPolyData* input, vtkDataArray* colors)
{
  gridfem::InputArray labels = gridfem::FindInputArray(algorithm, 1, input, "Label Array");
  if (!labels.array)
  {
    labels =
      gridfem::OnlyArray(input, [colors](vtkDataArray* array, vtkDataSetAttributes* attributes)
        { return array != colors && AreLabels(array) && !IsForOtherEnds(array, attributes); });
  }
  if (!labels.array)
  {
    throw gridfem::MissingChoice(
      "Choose a Label Array with the number of the scan that each color comes from.");
  }
  return labels;
}

/// The least and the largest value of a stitched color.
std::pair<double, double> RangeOf(vtkDataArray* colors)
{
  if (colors->GetDataType() != VTK_FLOAT && colors->GetDataType() != VTK_DOUBLE)
  {
    return { colors->GetDataTypeMin(), colors->GetDataTypeMax() };
  }
  for (int c = 0; c < colors->GetNumberOfComponents(); ++c)
  {
    const double* range = colors->GetRange(c);
    if (!(range[0] >= 0.0 && range[1] <= 1.0))
    {
      return { -VTK_DOUBLE_MAX, VTK_DOUBLE_MAX };
    }
  }
  return { 0.0, 1.0 };
}

/// Returns a copy of the colors with new values where `isNew`.
vtkSmartPointer<vtkDataArray> WithValues(
  vtkDataArray* colors, const gridfem::MultiVector& values, const std::vector<char>& isNew)
{
  vtkSmartPointer<vtkDataArray> result;
  result.TakeReference(vtkDataArray::CreateDataArray(colors->GetDataType()));
  gridfem::RequireRoom(
    static_cast<std::size_t>(colors->GetNumberOfValues()) * colors->GetDataTypeSize());
  result->DeepCopy(colors);
  result->SetName("StitchedColors");
  const bool isReal = gridfem::IsReal(colors);
  const auto [least, largest] = RangeOf(colors);
  for (vtkIdType row = 0; row < values.rows(); ++row)
  {
    for (int c = 0; isNew[row] && c < values.cols(); ++c)
    {
      const double value = std::clamp(values(row, c), least, largest);
      result->SetComponent(row, c, isReal ? value : std::round(value));
    }
  }
  return result;
}

} // namespace

struct vtkStitchColors::Internals
{
  gridfem::StitchSolver Solver;
};

vtkStitchColors::vtkStitchColors() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->NormalStabilization = gridfem::StitchSolver::SurfaceDefaults().choice.normalStabilization;
}

vtkStitchColors::~vtkStitchColors() = default;

void vtkStitchColors::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  const gridfem::InputArray colors = FindColors(this, input);
  const gridfem::InputArray labels = FindLabels(this, input, colors.array);

  gridfem::StitchSolver::Options options;
  options.equation = state.options;
  options.referenceLabel = this->ReferenceLabel;
  options.keepDetails = this->KeepDetails;
  options.blendWidth = this->BlendWidth;
  state.options.functionsPerPoint = gridfem::StitchSolver::FunctionsPerPoint(options);
  const gridfem::Progress progress = state.GetProgress();
  const gridfem::StitchSolver::Result& stitched =
    this->Data->Solver.Update(surface, { surface.Given(colors), surface.Given(labels) }, options,
      { surface.Threads(), progress.Part(0.0, 0.95) });

  output->ShallowCopy(input);
  vtkDataSetAttributes* attributes = output->GetPointData();
  if (colors.association == gridfem::FieldAssociation::Points)
  {
    attributes->AddArray(WithValues(colors.array, stitched.values, stitched.isReached));
  }
  else
  {
    attributes = output->GetCellData();
    const gridfem::MultiVector means =
      surface.MeansOnCells(stitched.values, input->GetNumberOfCells());
    std::vector<char> hasArea(input->GetNumberOfCells());
    for (gridfem::Id cell = 0; cell < means.rows(); ++cell)
    {
      hasArea[cell] = means.row(cell).hasNaN() ? 0 : 1;
    }
    attributes->AddArray(WithValues(colors.array, means, hasArea));
  }
  attributes->SetActiveScalars("StitchedColors");
  gridfem::AddReport(stitched.report, output);
  gridfem::AddAccuracy(stitched.accuracy, output);
  this->Warn(stitched.warnings);
  progress.Check(1.0);
}

void vtkStitchColors::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkStitchColors::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ReferenceLabel: " << this->ReferenceLabel << "\n";
  os << indent << "KeepDetails: " << this->KeepDetails << "\n";
  os << indent << "BlendWidth: " << this->BlendWidth << "\n";
}
