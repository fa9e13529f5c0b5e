#include "vtkGaussianField.h"

#include "Input/GivenValues.h"
#include "Input/InputArray.h"
#include "Input/PropertyList.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Grid/PlaceNumbers.h"
#include "Solvers/GaussianFieldSolver.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkGaussianField);

namespace
{

/// Coincident points have copies of one observation. The first of them gets the mean.
gridfem::PointValues OnePerPlace(
  const gridfem::PointValues& known, const gridfem::TriangleMesh& mesh)
{
  std::map<gridfem::Place, gridfem::Id> rowAt;
  std::vector<double> copies;
  gridfem::PointValues ofPlaces;
  ofPlaces.values.setZero(known.values.rows(), known.values.cols());
  for (std::size_t k = 0; k < known.points.size(); ++k)
  {
    const gridfem::Place place = gridfem::PlaceOf(mesh.points[known.points[k]]);
    const auto [found, isNew] =
      rowAt.try_emplace(place, static_cast<gridfem::Id>(ofPlaces.points.size()));
    if (isNew)
    {
      ofPlaces.points.push_back(known.points[k]);
      copies.push_back(0.0);
    }
    ofPlaces.values.row(found->second) += known.values.row(static_cast<gridfem::Id>(k));
    copies[found->second] += 1.0;
  }
  ofPlaces.values.conservativeResize(static_cast<gridfem::Id>(copies.size()), Eigen::NoChange);
  for (gridfem::Id row = 0; row < ofPlaces.values.rows(); ++row)
  {
    ofPlaces.values.row(row) /= copies[row];
  }
  return ofPlaces;
}

} // namespace

struct vtkGaussianField::Internals
{
  std::vector<std::pair<gridfem::Id, double>> Added;
  gridfem::GaussianFieldSolver Solver;
  const gridfem::GaussianFieldSolver::Result* Result = nullptr; // of this run
  std::vector<std::string> FarObservations;                     // warnings of this run

  gridfem::PointValues AddedValues() const
  {
    gridfem::PointValues values;
    values.values.resize(static_cast<gridfem::Id>(this->Added.size()), 1);
    for (const auto& [point, value] : this->Added)
    {
      values.values(static_cast<gridfem::Id>(values.points.size()), 0) = value;
      values.points.push_back(point);
    }
    return values;
  }
};

vtkGaussianField::vtkGaussianField() : Data(std::make_unique<Internals>())
{
  this->SetSelectionPort(3);
  const gridfem::GaussianFieldSolver::Options defaults;
  this->Tolerance = defaults.equation.solve.tolerance;
  this->MaximumIterations = defaults.equation.solve.maximumIterations;
  this->NormalStabilization =
    gridfem::GaussianFieldSolver::SurfaceDefaults().choice.normalStabilization;
}

vtkGaussianField::~vtkGaussianField() = default;

gridfem::GivenConstraints vtkGaussianField::FindObservations(vtkDataSet* places)
{
  gridfem::InputSurface& surface = this->State->Surface();
  gridfem::GivenConstraints observations;
  if (places)
  {
    const gridfem::InputArray array =
      gridfem::FindArrayOfPlaces(this, places, "Observations", "Observation Array");
    observations.find = [this, array, places, &surface]
    {
      return gridfem::ValuesOfPlaces(
        array, surface.Mesh(), places, "Observations", this->Data->FarObservations);
    };
    return observations;
  }
  const gridfem::InputArray array = surface.Find(0, "Observation Array");
  if (!array.array)
  {
    if (!this->Data->Added.empty())
    {
      observations.find = [this] { return this->Data->AddedValues(); };
    }
    return observations;
  }
  gridfem::RequirePointArray(array, "Observation Array", "");
  const gridfem::InputArray mask = surface.Find(1, "Mask Array");
  observations.find = [this, array, mask, &surface]
  {
    const gridfem::PointValues known =
      gridfem::KnownValues(array, mask, *this->Selection, surface.Mesh());
    return surface.AreCoincidentPointsWelded() ? OnePerPlace(known, surface.Mesh()) : known;
  };
  return observations;
}

void vtkGaussianField::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  this->ReadSelection(inputs);
  this->Data->FarObservations.clear();
  gridfem::GaussianFieldSolver::Options options;
  options.equation = state.options;
  options.range = this->Range;
  options.smoothness = this->Smoothness;
  options.standardDeviation = this->StandardDeviation;
  options.seed = this->Seed;
  options.numberOfSamples = this->NumberOfSamples;
  options.statistics = this->Statistics;
  options.observationNoise = this->ObservationNoise;
  const gridfem::GaussianFieldSolver::Result& result =
    this->Data->Solver.Update(surface, { this->FindObservations(vtkDataSet::GetData(inputs[2])) },
      options, { 0, state.GetProgress() });
  this->Data->Result = &result;
  output->ShallowCopy(input);
  this->WriteResult(output);
  gridfem::AddReport(result.report, output);
  this->Warn(this->Data->FarObservations);
  this->Warn(result.warnings);
}

void vtkGaussianField::WriteResult(vtkPolyData* output)
{
  const gridfem::GaussianFieldSolver::Result& result = *this->Data->Result;
  const gridfem::GaussianFieldSolver::Prediction& prediction = result.prediction;
  vtkPointData* points = output->GetPointData();
  const auto add = [points](const std::string& name, const gridfem::MultiVector& values)
  { points->AddArray(gridfem::MakePointArray(name.c_str(), values, VTK_DOUBLE)); };
  const bool isPredicted = prediction.mean.size() > 0;
  if (isPredicted)
  {
    add("Prediction", prediction.mean);
    add("LeaveOneOutError", prediction.leaveOneOutError);
    gridfem::AddFieldNumber(output, "LeaveOneOutRatio", prediction.leaveOneOutRatio);
    gridfem::AddFieldNumber(output, "LogLikelihood", prediction.logLikelihood);
  }
  if (!this->Statistics)
  {
    for (gridfem::Id column = 0; column < result.atPoints.cols(); ++column)
    {
      add(gridfem::NumberedName("Sample", column), result.atPoints.col(column));
    }
    points->SetActiveScalars(isPredicted ? "Prediction" : "Sample000");
  }
  else if (isPredicted)
  {
    add("PredictionStandardDeviation", result.atPoints.col(1));
    points->SetActiveScalars("Prediction");
  }
  else
  {
    add("SampleMean", result.atPoints.col(0));
    add("SampleStandardDeviation", result.atPoints.col(1));
    points->SetActiveScalars("SampleStandardDeviation");
  }
}

void vtkGaussianField::AddObservation(vtkIdType point, double value)
{
  gridfem::AddToList(this->Data->Added, { point, value }, this);
}

void vtkGaussianField::ClearObservations()
{
  gridfem::ClearList(this->Data->Added, this);
}

vtkIdType vtkGaussianField::GetNumberOfObservations()
{
  return static_cast<vtkIdType>(this->Data->Added.size());
}

void vtkGaussianField::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data->Solver = {};
  this->Data->Result = nullptr;
}

void vtkGaussianField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Range: " << this->Range << "\n";
  os << indent << "Smoothness: " << this->Smoothness << "\n";
  os << indent << "StandardDeviation: " << this->StandardDeviation << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "Statistics: " << this->Statistics << "\n";
  os << indent << "ObservationNoise: " << this->ObservationNoise << "\n";
  os << indent << "Observations: " << this->GetNumberOfObservations() << "\n";
}
