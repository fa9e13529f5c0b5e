#include "vtkGeodesicDistance.h"

#include "Private/Allocation.h"
#include "Private/CanDistribute.h"
#include "Private/InputArray.h"
#include "Private/InputValidation.h"
#include "Private/Ranks.h"
#include "Private/SelectedPoints.h"
#include "Private/SolverOutput.h"
#include "Private/SourcePoints.h"
#include "Private/SurfaceCurves.h"
#include "Private/SurfaceSolverState.h"

#include "Base/Errors.h"
#include "Integrals/QuadratureRule.h"
#include "Problems/GeodesicDistance.h"
#include "Problems/NearestSource.h"

#include "vtkDataSet.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"

#include <algorithm>

vtkStandardNewMacro(vtkGeodesicDistance);

namespace
{

constexpr const char* CurveStage = "Curve";

/// The points of polygons where the array is not 0.
std::vector<gridfem::Id> MaskedPoints(
  const gridfem::InputArray& mask, const gridfem::InputMesh& mesh)
{
  if (mask.association != gridfem::FieldAssociation::Points ||
      mask.array->GetNumberOfComponents() != 1)
  {
    throw gridfem::InvalidInput("SourceArray '" + mask.name +
                                "' must be a point array with one "
                                "component: 0 where there is no source.");
  }
  const gridfem::Field field = gridfem::ReadField(mask, mesh);
  std::vector<gridfem::Id> points;
  for (gridfem::Id point = 0; point < field.values.rows(); ++point)
  {
    if (field.values(point, 0) != 0.0)
    {
      points.push_back(point);
    }
  }
  return points;
}

/// Those that the mask or the selection takes; a point of both twice.
std::vector<gridfem::Id> ChosenPoints(const gridfem::InputMesh& mesh,
  const gridfem::InputArray& mask, const gridfem::SelectedPoints& selection)
{
  std::vector<gridfem::Id> points =
    mask.array ? MaskedPoints(mask, mesh) : std::vector<gridfem::Id>();
  const std::vector<gridfem::Id> selected = selection.Ids(*mesh.triangles);
  points.insert(points.end(), selected.begin(), selected.end());
  return points;
}

} // namespace

struct vtkGeodesicDistance::Internals
{
  std::vector<gridfem::Id> SourceIds;
  std::unique_ptr<gridfem::GeodesicDistance> Method;
  std::unique_ptr<gridfem::DistanceMethod> OfRanks; // together, in its place
  gridfem::DistanceField Field;
  gridfem::SurfaceCurve Curve;

  std::vector<gridfem::Id> FindSources(const gridfem::InputMesh& mesh,
    const gridfem::InputArray& mask, vtkDataSet* places,
    const gridfem::SelectedPoints& selection) const
  {
    std::vector<gridfem::Id> ids = this->SourceIds;
    const std::vector<gridfem::Id> chosen = ChosenPoints(mesh, mask, selection);
    ids.insert(ids.end(), chosen.begin(), chosen.end());
    if (this->SourceIds.empty() && !mask.array && !places && !selection.IsGiven())
    {
      ids = { mesh.triangles->triangles.front()[0] };
    }
    std::vector<gridfem::Id> sources = gridfem::SourcePoints(*mesh.triangles, ids, places);
    if (sources.empty())
    {
      throw gridfem::InvalidInput(WhyNoSource(mask, selection));
    }
    return sources;
  }

  static std::string WhyNoSource(
    const gridfem::InputArray& mask, const gridfem::SelectedPoints& selection)
  {
    const std::string reason = mask.array
                                 ? "SourceArray '" + mask.name + "' is 0 at all points of polygons"
                               : selection.IsGiven() ? "The Selection takes no point of a polygon"
                                                     : "The input Sources has no points";
    return reason + ", so no distance starts.";
  }
};

vtkGeodesicDistance::vtkGeodesicDistance()
  : Data(std::make_unique<Internals>()), Selection(std::make_unique<gridfem::SelectedPoints>(this))
{
  this->SetNumberOfInputPorts(4);
  this->Tolerance = 1e-4;
  this->NormalStabilization = 0.1;
  this->MaximumIterations = 200;
}

vtkGeodesicDistance::~vtkGeodesicDistance() = default;

int vtkGeodesicDistance::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  if (port >= 2)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 2 ? "vtkDataSet" : "vtkSelection");
  }
  return 1;
}

void vtkGeodesicDistance::AddSourcePointId(vtkIdType id)
{
  this->Data->SourceIds.push_back(id);
  this->Modified();
}

void vtkGeodesicDistance::ClearSourcePointIds()
{
  if (!this->Data->SourceIds.empty())
  {
    this->Data->SourceIds.clear();
    this->Modified();
  }
}

vtkIdType vtkGeodesicDistance::GetNumberOfSourcePointIds()
{
  return static_cast<vtkIdType>(this->Data->SourceIds.size());
}

vtkIdType vtkGeodesicDistance::GetSourcePointId(vtkIdType index)
{
  return index >= 0 && index < this->GetNumberOfSourcePointIds() ? this->Data->SourceIds[index]
                                                                 : -1;
}

void vtkGeodesicDistance::Warn()
{
  for (const std::string& warning : gridfem::WarningsOf(this->Data->Field, this->Tolerance))
  {
    vtkWarningMacro(<< warning);
  }
}

/// The system has to be up to date.
void vtkGeodesicDistance::UpdateHierarchies(const gridfem::Progress& progress)
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SystemStage)).Add(this->Smoothing);
  gridfem::AddMultigrid(key, state.options.multigrid);
  state.stages.Run(gridfem::HierarchyStage, key,
    [&]
    {
      data.Method.reset(); // frees its memory first
      data.OfRanks.reset();
      gridfem::DistanceOptions options;
      options.smoothing = this->Smoothing;
      options.multigrid = state.options.multigrid;
      const gridfem::Job job = state.MakeJob(progress.Part(0.3, 0.4));
      if (state.together.IsUsed())
      {
        data.OfRanks = state.together.MakeDistance(state.mesh, options, job);
        return;
      }
      data.Method = std::make_unique<gridfem::GeodesicDistance>(
        state.space, state.mesh.triangles, options, job);
    });
}

void vtkGeodesicDistance::UpdateDistance(
  const std::vector<vtkIdType>& sources, const gridfem::Progress& progress)
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  gridfem::StageKey key;
  key.Add(false); // not from a curve
  key.Add(state.stages.Version(gridfem::HierarchyStage));
  key.Add(this->Tolerance).Add(this->MaximumIterations);
  for (const vtkIdType source : sources)
  {
    key.Add(static_cast<std::int64_t>(source));
  }
  state.stages.Run(gridfem::SolveStage, key,
    [&]
    {
      const gridfem::DistanceMethod* method = data.OfRanks.get();
      if (!method)
      {
        method = data.Method.get();
      }
      data.Field = method->From({ sources.begin(), sources.end() }, state.options.solve,
        state.MakeJob(progress.Part(0.4, 0.98)));
      if (state.together.IsUsed())
      {
        Eigen::Map<Eigen::VectorXd> column(
          data.Field.atPoints.data(), static_cast<Eigen::Index>(data.Field.atPoints.size()));
        gridfem::MultiVector atPoints = column;
        state.FillCopies(atPoints);
        column = atPoints.col(0);
      }
    });
}

/// Points have no sides.
void vtkGeodesicDistance::RefusePoints(const std::string& sourceArray) const
{
  const char* given = !this->Data->SourceIds.empty() ? "SourcePointIds"
                      : !sourceArray.empty()         ? "a SourceArray"
                      : this->Selection->IsGiven()   ? "a Selection"
                      : this->NearestSource          ? "NearestSource"
                                                     : nullptr;
  if (given)
  {
    throw gridfem::InvalidInput(std::string("Signed distances are from curves, which divide the "
                                            "surface into two sides: clear ") +
                                given + ", which is about points, or turn Signed off.");
  }
}

/// The border of labels, else the lines. The space has to be up to date.
void vtkGeodesicDistance::UpdateCurve(vtkPolyData* input, vtkDataSet* lines)
{
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::InputArray labels = gridfem::FindInputArray(this, 1, input, "LabelArray");
  const bool weld = this->WeldCoincidentPoints;
  gridfem::StageKey key;
  key.Add(state.stages.Version(gridfem::SpaceStage)).Add(weld).Add(labels.array);
  key.Add(static_cast<int>(labels.association)).Add(this->InsideLabel);
  key.Add(labels.array ? nullptr : lines);
  state.stages.Run(CurveStage, key,
    [&]
    {
      this->Data->Curve = labels.array
                            ? gridfem::BorderOfLabel(labels, this->InsideLabel, state.mesh, weld)
                            : gridfem::CurveOfLines(lines, *state.mesh.triangles, weld);
    });
}

void vtkGeodesicDistance::UpdateSignedDistance()
{
  gridfem::SurfaceSolverState& state = *this->State;
  Internals& data = *this->Data;
  gridfem::StageKey key;
  key.Add(true).Add(state.stages.Version(gridfem::HierarchyStage));
  key.Add(state.stages.Version(CurveStage)).Add(this->Tolerance).Add(this->MaximumIterations);
  state.stages.Run(gridfem::SolveStage, key,
    [&]
    {
      data.Field = data.Method->FromCurve(
        data.Curve, state.options.solve, state.MakeJob(state.bridge.GetProgress().Part(0.4, 0.98)));
    });
}

void vtkGeodesicDistance::WriteDistance(vtkPolyData* output)
{
  const gridfem::DistanceField& field = this->Data->Field;
  const Eigen::Map<const Eigen::VectorXd> column(
    field.atPoints.data(), static_cast<Eigen::Index>(field.atPoints.size()));
  output->GetPointData()->AddArray(gridfem::MakePointArray("Distance", column, VTK_DOUBLE));
  output->GetPointData()->SetActiveScalars("Distance");
  gridfem::AddReport(field.report, output);
  gridfem::AddFieldNumber(output, "HeatSweeps", field.heatSweeps);
}

void vtkGeodesicDistance::WriteNearestSource(
  const std::vector<vtkIdType>& sources, vtkPolyData* output)
{
  gridfem::SurfaceSolverState& state = *this->State;
  const std::vector<gridfem::Id> nearest = gridfem::NearestSources(*state.mesh.triangles,
    this->Data->Field.atPoints, { sources.begin(), sources.end() }, this->WeldCoincidentPoints,
    state.MakeJob(state.bridge.GetProgress().Part(0.98, 1.0)));
  vtkNew<vtkIdTypeArray> array;
  array->SetName("NearestSource");
  gridfem::SetTuples(array, static_cast<vtkIdType>(nearest.size()));
  std::copy(nearest.begin(), nearest.end(), array->GetPointer(0));
  output->GetPointData()->AddArray(array);
}

void vtkGeodesicDistance::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::RequireNumber("Smoothing", this->Smoothing);
  const gridfem::InputArray mask = gridfem::FindInputArray(this, 0, input, "SourceArray");
  state.options.space.joinAtPoints = true; // paths lead through points where sheets touch
  state.options.functionsPerPoint = gridfem::AsManyAsWanted; // heat flows on the grid
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.2));
  this->Selection->Update(vtkSelection::GetData(inputs[3]), input, this->JoinedInput());
  vtkDataSet* const places = vtkDataSet::GetData(inputs[2]);
  std::vector<vtkIdType> sources;
  if (this->Signed)
  {
    this->RefusePoints(mask.name);
    this->UpdateCurve(input, places);
  }
  else
  {
    const std::vector<gridfem::Id> found =
      this->Data->FindSources(state.mesh, mask, places, *this->Selection);
    sources.assign(found.begin(), found.end());
  }
  state.UpdateSystem(progress.Part(0.2, 0.3));

  this->UpdateHierarchies(progress);
  if (this->Signed)
  {
    this->UpdateSignedDistance();
  }
  else
  {
    this->UpdateDistance(sources, progress);
  }
  output->ShallowCopy(input);
  this->WriteDistance(output);
  if (this->NearestSource)
  {
    this->WriteNearestSource(sources, output);
  }
  this->Warn();
  progress.Check(1.0);
}

bool vtkGeodesicDistance::ComputeTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  gridfem::SurfaceSolverState& state = *this->State;
  const bool needsAll = !this->Data->SourceIds.empty() || this->Signed || this->NearestSource ||
                        this->Smoothing >= gridfem::MostSmoothing;
  if (!gridfem::CanDistribute(this, inputs, needsAll))
  {
    return false;
  }
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  state.options.space.joinAtPoints = true; // paths lead through points where sheets touch
  state.options.functionsPerPoint = gridfem::AsManyAsWanted; // heat flows on the grid
  state.RunTogether(
    [&](const gridfem::Progress& progress)
    {
      this->Selection->UpdateTogether(state.together, vtkSelection::GetData(inputs[3]), piece);
      this->SolveTogether(inputs, outputs, progress);
    });
  return true;
}

/// The rank's own points among the sources: where none are chosen the first point of the first
/// rank.
std::vector<vtkIdType> vtkGeodesicDistance::FindSourcesTogether(vtkPolyData* piece)
{
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::TriangleMesh& mesh = *state.mesh.triangles;
  const gridfem::InputArray mask = state.together.Find(this, 0, piece, state.mesh, "SourceArray");
  std::vector<vtkIdType> sources;
  if (mask.array || this->Selection->IsGiven())
  {
    state.Together(
      [&]
      {
        const std::vector<gridfem::Id> chosen = ChosenPoints(state.mesh, mask, *this->Selection);
        sources.assign(chosen.begin(), chosen.end());
      });
  }
  else
  {
    const double own = gridfem::Ranks().Own();
    std::vector<double> first;
    if (!mesh.triangles.empty())
    {
      first.push_back(own);
    }
    state.together.Agree(first);
    if (!mesh.triangles.empty() && first.front() == own)
    {
      sources.push_back(mesh.triangles.front()[0]);
    }
  }
  if (!state.together.Any(!sources.empty()))
  {
    throw gridfem::InvalidInput(Internals::WhyNoSource(mask, *this->Selection));
  }
  return sources;
}

void vtkGeodesicDistance::SolveTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs, const gridfem::Progress& progress)
{
  gridfem::SurfaceSolverState& state = *this->State;
  state.together.Together([&] { gridfem::RequireNumber("Smoothing", this->Smoothing); });
  vtkPolyData* piece = vtkPolyData::GetData(inputs[0]);
  state.UpdateTogether(piece, vtkPolyData::GetData(inputs[1]));
  progress.Check(0.3);
  const std::vector<vtkIdType> sources = this->FindSourcesTogether(piece);
  this->UpdateHierarchies(progress);
  this->UpdateDistance(sources, progress);
  state.together.Together(
    [&]
    {
      vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
      if (piece)
      {
        output->ShallowCopy(piece);
      }
      this->WriteDistance(output);
      gridfem::AddDistributed(this->State->together.Depth(), output);
      if (gridfem::Ranks().IsFirst())
      {
        this->Warn();
      }
    });
}

void vtkGeodesicDistance::FreeStages()
{
  this->Superclass::FreeStages();
  this->Selection->Free();
  this->Data->OfRanks.reset();
  this->Data->Method.reset();
  this->Data->Field = {};
  this->Data->Curve = {};
}

void vtkGeodesicDistance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SourcePointIds: " << this->GetNumberOfSourcePointIds() << "\n";
  os << indent << "Smoothing: " << this->Smoothing << "\n";
  os << indent << "NearestSource: " << this->NearestSource << "\n";
  os << indent << "Signed: " << this->Signed << "\n";
  os << indent << "InsideLabel: " << this->InsideLabel << "\n";
}
