#include "vtkGeodesicDistance.h"

#include "Input/NearestPoints.h"
#include "Input/PropertyList.h"
#include "Input/SelectedPoints.h"
#include "Input/SurfaceCurves.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Distance/NearestSource.h"
#include "Integrals/QuadratureRule.h"
#include "Solvers/DistanceSolver.h"

#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkGeodesicDistance);

struct vtkGeodesicDistance::Internals
{
  std::vector<gridfem::Id> SourceIds;
  gridfem::DistanceSolver Solver;
  gridfem::DistanceSolver::Input Input; // of this run
  std::vector<std::string> FarSources;  // warnings of this run
};

vtkGeodesicDistance::vtkGeodesicDistance() : Data(std::make_unique<Internals>())
{
  this->SetSelectionPort(3);
  this->Tolerance = 1e-4;
  this->NormalStabilization = gridfem::DistanceOptions::LeastStabilization;
  this->MaximumIterations = 200;
}

vtkGeodesicDistance::~vtkGeodesicDistance() = default;

double vtkGeodesicDistance::GetNormalStabilizationMinValue()
{
  return gridfem::DistanceOptions::LeastStabilization;
}

void vtkGeodesicDistance::AddSourcePointId(vtkIdType id)
{
  gridfem::AddToList(this->Data->SourceIds, id, this);
}

void vtkGeodesicDistance::ClearSourcePointIds()
{
  gridfem::ClearList(this->Data->SourceIds, this);
}

vtkIdType vtkGeodesicDistance::GetNumberOfSourcePointIds()
{
  return static_cast<vtkIdType>(this->Data->SourceIds.size());
}

vtkIdType vtkGeodesicDistance::GetSourcePointId(vtkIdType index)
{
  return gridfem::IdOfList(this->Data->SourceIds, index);
}

bool vtkGeodesicDistance::NeedsWholeSurface()
{
  return !this->Data->SourceIds.empty() || this->UseSourcePosition || this->Signed ||
         this->NearestSource || this->Smoothing >= gridfem::MostSmoothing;
}

void vtkGeodesicDistance::FindSources(vtkDataSet* places)
{
  gridfem::InputSurface& surface = this->State->Surface();
  gridfem::DistanceSolver::Input& input = this->Data->Input;
  input.ids = this->Data->SourceIds;
  input.mask = surface.Given(surface.Find(0, "Source Array"));
  if (this->Selection->IsGiven())
  {
    input.points.push_back({ "The Selection", "The Selection takes no point of a polygon",
      [this, &surface] { return this->Selection->Ids(surface.Mesh()); } });
  }
  if (places && !this->Signed)
  {
    input.points.push_back({ "Sources", "The input Sources has no points",
      [this, places, &surface]
      {
        return places->GetNumberOfPoints() > 0 ? gridfem::NearestPointsAlongLines(surface.Mesh(),
                                                   places, "Sources", this->Data->FarSources)
                                               : std::vector<gridfem::Id>();
      } });
  }
  if (this->UseSourcePosition)
  {
    input.points.push_back({ "Use Source Position", "No polygon has a point",
      [this, &surface]
      {
        return std::vector<gridfem::Id>{ gridfem::NearestUsedPoint(
          "Source Position", gridfem::Vec3(this->SourcePosition), surface.Mesh()) };
      } });
  }
}

void vtkGeodesicDistance::FindCurve(vtkDataSet* lines)
{
  gridfem::InputSurface& surface = this->State->Surface();
  gridfem::DistanceSolver::Input& input = this->Data->Input;
  input.labels = surface.Given(surface.Find(1, "Label Array"));
  input.curve.version.Add(lines);
  input.curve.divide = [this, &surface, lines]
  {
    if (lines && lines->GetNumberOfPoints() > 0)
    {
      gridfem::NearestPoints(surface.Mesh(), lines, "Sources", this->Data->FarSources);
    }
    return gridfem::CurveOfLines(lines, surface.Mesh(), surface.AreCoincidentPointsWelded());
  };
}

void vtkGeodesicDistance::Write(vtkPolyData* input, vtkPolyData* output)
{
  const gridfem::DistanceSolver::Result& result = this->Data->Solver.GetResult();
  if (input)
  {
    output->ShallowCopy(input);
  }
  output->GetPointData()->AddArray(
    gridfem::MakePointArray("Distance", result.atPoints, VTK_DOUBLE));
  output->GetPointData()->SetActiveScalars("Distance");
  if (this->NearestSource)
  {
    output->GetPointData()->AddArray(gridfem::MakeIdArray("NearestSource", result.nearest));
  }
  gridfem::AddReport(result.report, output);
  gridfem::AddFieldNumber(output, "HeatSweeps", result.heatSweeps);
}

void vtkGeodesicDistance::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkDataSet* places = vtkDataSet::GetData(inputs[2]);
  Internals& data = *this->Data;
  gridfem::FilterState& state = *this->State;
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  const gridfem::SurfaceOptions defaults = gridfem::DistanceSolver::SurfaceDefaults();
  state.options.space.joinAtPoints = defaults.space.joinAtPoints;
  state.options.functionsPerPoint = defaults.functionsPerPoint;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  this->ReadSelection(inputs);
  data.Input = {};
  data.FarSources.clear();
  this->FindSources(places);
  if (this->Signed)
  {
    this->FindCurve(places);
  }
  gridfem::DistanceSolver::Options options;
  options.equation = state.options;
  options.smoothing = this->Smoothing;
  options.nearestSource = this->NearestSource;
  options.isSigned = this->Signed;
  options.insideLabel = this->InsideLabel;
  const gridfem::DistanceSolver::Result& result =
    data.Solver.Update(surface, data.Input, options, { 0, state.GetProgress() });
  surface.Together([&] { this->Write(input, vtkPolyData::GetData(outputs, 0)); });
  this->Warn(data.FarSources);
  this->Warn(result.warnings);
}

void vtkGeodesicDistance::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Solver = {};
  this->Data->Input = {};
}

void vtkGeodesicDistance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SourcePointIds: " << this->GetNumberOfSourcePointIds() << "\n";
  os << indent << "UseSourcePosition: " << this->UseSourcePosition << "\n";
  os << indent << "SourcePosition: " << this->SourcePosition[0] << " " << this->SourcePosition[1]
     << " " << this->SourcePosition[2] << "\n";
  os << indent << "Smoothing: " << this->Smoothing << "\n";
  os << indent << "NearestSource: " << this->NearestSource << "\n";
  os << indent << "Signed: " << this->Signed << "\n";
  os << indent << "InsideLabel: " << this->InsideLabel << "\n";
}
