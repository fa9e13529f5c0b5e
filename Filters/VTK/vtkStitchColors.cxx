#include "vtkStitchColors.h"

#include "Private/Allocation.h"
#include "Private/ClippedArrays.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/InterpolatedArrays.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Problems/Stitching.h"

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

constexpr const char* CutStage = "Cut"; // the scans and a space on each
constexpr int WholeSurface = -1;        // as ReferenceLabel

/// As readers of scans give them.
bool AreColors(vtkDataArray* array)
{
  return array->GetDataType() == VTK_UNSIGNED_CHAR && array->GetNumberOfComponents() >= 3 &&
         array->GetNumberOfComponents() <= 4;
}

/// What numbers or marks points and cells for other ends than to tell scans.
bool IsForOtherEnds(vtkDataArray* array, vtkDataSetAttributes* attributes)
{
  const char* name = array->GetName();
  return array == attributes->GetGlobalIds() || array == attributes->GetPedigreeIds() ||
         (name && (std::string(name) == vtkDataSetAttributes::GhostArrayName() ||
                    gridfem::IsClipCellArray(name)));
}

/// Integers, of which each is there twice in the mean at least.
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
  gridfem::InputArray colors = gridfem::FindInputArray(algorithm, 0, input, "ColorArray");
  if (!colors.array)
  {
    colors = gridfem::OnlyArray(input, [](vtkDataArray* array, auto) { return AreColors(array); });
  }
  if (!colors.array)
  {
    throw gridfem::InvalidInput("Choose a ColorArray: the colours of the scans.");
  }
  if (colors.array->GetNumberOfComponents() > 4 || colors.array->GetNumberOfComponents() < 1)
  {
    throw gridfem::InvalidInput("ColorArray '" + colors.name + "' has " +
                                std::to_string(colors.array->GetNumberOfComponents()) +
                                " components; colours have 1 to 4.");
  }
  return colors;
}

gridfem::InputArray FindLabels(vtkAlgorithm* algorithm, vtkPolyData* input, vtkDataArray* colors)
{
  gridfem::InputArray labels = gridfem::FindInputArray(algorithm, 1, input, "LabelArray");
  if (!labels.array)
  {
    labels =
      gridfem::OnlyArray(input, [colors](vtkDataArray* array, vtkDataSetAttributes* attributes)
        { return array != colors && AreLabels(array) && !IsForOtherEnds(array, attributes); });
  }
  if (!labels.array)
  {
    throw gridfem::InvalidInput("Choose a LabelArray: it says which scan a colour comes from.");
  }
  if (labels.array->GetNumberOfComponents() != 1)
  {
    throw gridfem::InvalidInput("LabelArray '" + labels.name + "' must have one component.");
  }
  return labels;
}

/// What each label stands for: numbers, ascending.
std::vector<double> DistinctLabels(const gridfem::InputArray& labels, const gridfem::Field& field)
{
  std::vector<double> distinct;
  for (gridfem::Id row = 0; row < field.values.rows(); ++row)
  {
    const double label = field.values(row, 0);
    if (label != std::floor(label))
    {
      throw gridfem::InvalidInput("LabelArray '" + labels.name + "' has the value " +
                                  std::to_string(label) + "; labels must be integers.");
    }
    if (distinct.empty() || distinct.back() != label)
    {
      distinct.push_back(label);
    }
  }
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  return distinct;
}

gridfem::Index NumberOf(const std::vector<double>& distinct, double label)
{
  return static_cast<gridfem::Index>(
    std::lower_bound(distinct.begin(), distinct.end(), label) - distinct.begin());
}

/// The least and the largest value of a stitched colour.
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

/// A copy of the colours with new values where `isNew`.
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
  std::vector<double> Labels; // distinct ones, ascending; scans are their numbers
  gridfem::ScanCut Cut;
  std::unique_ptr<gridfem::FiniteElementSpace> Details;
  gridfem::StitchedColors Stitched;
};

vtkStitchColors::vtkStitchColors() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->NormalStabilization = 1e-2;
}

vtkStitchColors::~vtkStitchColors() = default;

void vtkStitchColors::UpdateCut(const gridfem::InputArray& colors,
  const gridfem::InputArray& labels, const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(labels.array);
  key.Add(static_cast<int>(labels.association)).Add(static_cast<int>(colors.association));
  key.Add(this->KeepDetails);
  state.stages.Run(CutStage, key,
    [&]
    {
      const gridfem::Field field = gridfem::ReadField(labels, state.mesh);
      data.Labels = DistinctLabels(labels, field);
      progress.Check(0.0);
      gridfem::ScanLabels scans;
      scans.association = labels.association;
      for (gridfem::Id row = 0; row < field.values.rows(); ++row)
      {
        scans.values.push_back(NumberOf(data.Labels, field.values(row, 0)));
      }
      data.Cut = gridfem::CutAtSeams(*state.mesh.triangles, scans, colors.association);
      progress.Check(0.1);
      data.Details.reset();
      if (this->KeepDetails && gridfem::SurfaceArea(data.Cut.pieces) > 0.0)
      {
        gridfem::SpaceOptions functions = state.options.space;
        functions.depth = state.Functions().GetGrid().depth;
        functions.connectivityAware = true;
        functions.weldCoincidentPoints = false; // points of two scans stay two
        gridfem::SpaceChoice choice = state.options.choice;
        choice.kind = gridfem::FunctionKind::Grid; // the change is smooth
        gridfem::RequireMemory(data.Cut.pieces, functions.depth);
        data.Details =
          gridfem::BuildSpace(data.Cut.pieces, functions, choice, progress.Part(0.1, 1.0));
      }
    });
}

void vtkStitchColors::Solve(const gridfem::InputArray& colors, const gridfem::Progress& progress)
{
  Internals& data = *this->Data;
  gridfem::SurfaceSolverState& state = *this->State;
  gridfem::StitchOptions options{ state.options,
    this->BlendWidth * state.space->Extent() * state.space->UnitLength(), {} };
  if (this->ReferenceLabel != WholeSurface)
  {
    options.reference = NumberOf(data.Labels, this->ReferenceLabel);
    if (!std::binary_search(data.Labels.begin(), data.Labels.end(), this->ReferenceLabel))
    {
      throw gridfem::InvalidInput(
        "There is no scan with the ReferenceLabel " + std::to_string(this->ReferenceLabel) + ".");
    }
  }
  gridfem::StageKey key;
  key.Add(state.stages.Version(CutStage)).Add(colors.array);
  key.Add(this->BlendWidth).Add(options.reference.value_or(-1));
  gridfem::AddSolver(key, state.options);
  state.stages.Run(gridfem::SolveStage, key,
    [&]
    {
      data.Stitched = gridfem::StitchColors(*state.space, *state.mesh.triangles, data.Cut,
        gridfem::ReadField(colors, state.mesh), options, data.Details.get(),
        state.MakeJob(progress));
    });
}

void vtkStitchColors::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  const gridfem::InputArray colors = FindColors(this, input);
  const gridfem::InputArray labels = FindLabels(this, input, colors.array);
  // Details are kept on the grid.
  state.options.functionsPerPoint =
    this->KeepDetails ? gridfem::AsManyAsWanted : gridfem::EnoughToPrecondition;
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.2));
  state.UpdateSystem(progress.Part(0.2, 0.35));
  this->UpdateCut(colors, labels, progress.Part(0.35, 0.6));
  this->Solve(colors, progress.Part(0.6, 0.95));

  const gridfem::StitchedColors& stitched = this->Data->Stitched;
  output->ShallowCopy(input);
  vtkDataSetAttributes* attributes = output->GetPointData();
  if (colors.association == gridfem::FieldAssociation::Points)
  {
    attributes->AddArray(
      WithValues(colors.array, stitched.values, state.space->PointsWithFunctions()));
  }
  else
  {
    attributes = output->GetCellData();
    std::vector<char> hasTriangles(input->GetNumberOfCells(), 0);
    for (const gridfem::Id cell : state.mesh.sourceCell)
    {
      hasTriangles[cell] = 1;
    }
    attributes->AddArray(WithValues(colors.array,
      gridfem::MeansOnCells(state.mesh, stitched.values, input->GetNumberOfCells()), hasTriangles));
  }
  attributes->SetActiveScalars("StitchedColors");
  this->WriteReport(stitched.report, stitched.accuracy, output);
  progress.Check(1.0);
}

void vtkStitchColors::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = {};
}

void vtkStitchColors::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ReferenceLabel: " << this->ReferenceLabel << "\n";
  os << indent << "KeepDetails: " << this->KeepDetails << "\n";
  os << indent << "BlendWidth: " << this->BlendWidth << "\n";
}
