#include "vtkScreenedPoisson.h"

#include "Input/InputArray.h"
#include "Input/JoinedArrays.h"
#include "Output/ClippedMeshWriter.h"
#include "Output/MovedMeshWriter.h"
#include "Output/SolverOutput.h"
#include "Pieces/CanDistribute.h"
#include "Pieces/Ranks.h"
#include "Pipeline/FilterState.h"

#include "Base/Errors.h"
#include "Integrals/QuadratureRule.h"
#include "Solvers/PoissonSolver.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkScreenedPoisson);

struct vtkScreenedPoisson::Internals
{
  gridfem::InputArray Value; // none: the coordinates
  gridfem::JoinedArrays Arrays;
  gridfem::InputArray Gradient;
  gridfem::InputArray Scale;
  gridfem::InputArray Weight;
  gridfem::InputArray Constraint;
  gridfem::InputArray Flux;
  gridfem::PoissonSolver Solver;
  const gridfem::PoissonSolver::Result* Result = nullptr; // of this run
};

vtkScreenedPoisson::vtkScreenedPoisson() : Data(std::make_unique<Internals>())
{
  this->SetSelectionPort(2);
  this->SetNumberOfOutputPorts(2);
}

vtkScreenedPoisson::~vtkScreenedPoisson() = default;

int vtkScreenedPoisson::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

bool vtkScreenedPoisson::NeedsWholeSurface()
{
  return this->WantedError > 0.0 || this->TrackMetric || gridfem::IsArrayChosen(this, 5) ||
         !gridfem::IsArrayChosen(this, 0);
}

void vtkScreenedPoisson::FindArrays()
{
  Internals& data = *this->Data;
  gridfem::InputSurface& surface = this->State->Surface();
  data.Value = data.Arrays.Join(this, surface, surface.Find(0, "Value Array"), "Value Array");
  data.Gradient = surface.Find(1, "Gradient Array");
  data.Scale = surface.Find(2, "Gradient Scale Array");
  data.Weight = surface.Find(3, "Value Weight Array");
  data.Constraint = surface.Find(4, "Constraint Array");
  this->State->options.metricArray = surface.Find(5, "Metric Array");
  data.Flux = surface.Find(6, "Boundary Flux Array");
  this->RequireFluxFits();
}

void vtkScreenedPoisson::RequireFluxFits() const
{
  if (this->Data->Flux.array && this->State->options.trackMetric)
  {
    throw gridfem::InvalidInput(
      "A Boundary Flux Array cannot be combined with Track Metric, because the flux is "
      "per length of the boundary, and the kept functions have its earlier length.");
  }
  if (this->Data->Flux.array && this->State->options.metricArray.array)
  {
    throw gridfem::InvalidInput(
      "A Boundary Flux Array cannot be combined with a Metric Array, because the flux is "
      "per length of the surface's own boundary.");
  }
}

void vtkScreenedPoisson::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  Internals& data = *this->Data;
  gridfem::FilterState& state = *this->State;
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  state.options.trackMetric = this->TrackMetric && !(this->WantedError > 0.0);
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  this->ReadSelection(inputs);
  this->FindArrays();

  gridfem::PoissonSolver::Options options;
  options.equation = state.options;
  options.screeningWeight = this->ScreeningWeight;
  options.gradientScale = this->GradientScale;
  options.useValueGradient = this->UseValueGradient;
  options.fillUnknown = this->FillUnknown;
  options.boundaryValues = this->BoundaryValues;
  options.wantedError = this->WantedError;
  const gridfem::Progress progress = state.GetProgress();
  const gridfem::PoissonSolver::Result& result = data.Solver.Update(surface,
    { surface.Given(data.Value), surface.Given(data.Gradient), surface.Given(data.Scale),
      surface.Given(data.Weight), surface.Given(data.Flux),
      surface.ConstraintsOf(data.Value, data.Constraint, *this->Selection) },
    options, { surface.Threads(), progress.Part(0.0, 0.95) });
  data.Result = &result;
  surface.Together(
    [&]
    {
      if (input && input->GetPoints())
      {
        this->WriteSolution(input, output);
      }
      gridfem::AddReport(result.report, output);
      gridfem::AddAccuracy(result.accuracy, output);
      surface.WriteTracking(output);
      if (result.holdsValues)
      {
        gridfem::AddFieldNumber(output, "Misfit", result.misfit);
      }
      if (!result.isAccurate)
      {
        gridfem::AddFieldInt(output, "Converged", 0);
      }
      if (gridfem::Ranks().IsFirst())
      {
        vtkTable* table = vtkTable::GetData(outputs, 1);
        gridfem::WriteHistory(result.report, table);
        gridfem::AddErrors(result.report, result.accuracy, table);
      }
    });
  this->Warn(result.warnings);
  progress.Check(1.0);
}

void vtkScreenedPoisson::WriteSolution(vtkPolyData* input, vtkPolyData* output)
{
  const Internals& data = *this->Data;
  const gridfem::InputSurface& surface = this->State->Surface();
  gridfem::MultiVector values = data.Result->atPoints;
  output->ShallowCopy(input);
  vtkPointData* points = output->GetPointData();
  if (data.Value.array)
  {
    data.Arrays.AddSolutions("Solution", values, points);
  }
  else
  {
    vtkDataArray* places = input->GetPoints()->GetData();
    gridfem::KeepUnsolved(places, values);
    points->AddArray(gridfem::MakePointArray("Solution", values, places->GetDataType()));
    gridfem::MoveSurface(surface.CurrentMesh(), values,
      gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  }
}

void vtkScreenedPoisson::AddFurtherArray(const char* name)
{
  gridfem::AddFurtherArray(this, name);
}

void vtkScreenedPoisson::ClearFurtherArrays()
{
  gridfem::ClearFurtherArrays(this);
}

void vtkScreenedPoisson::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
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
