#include "vtkSurfaceDynamics.h"

#include "Input/InputArray.h"
#include "Input/ReactionFormulas.h"
#include "Input/SelectedPoints.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"
#include "Pipeline/PipelineTime.h"

#include "Solvers/DynamicsSolver.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <numeric>

vtkStandardNewMacro(vtkSurfaceDynamics);

struct vtkSurfaceDynamics::Internals
{
  gridfem::DynamicsSolver Solver;
  const gridfem::DynamicsSolver::Result* Result = nullptr; // of this run
};

vtkSurfaceDynamics::vtkSurfaceDynamics() : Data(std::make_unique<Internals>())
{
  this->SetSelectionPort(2);
  const gridfem::DynamicsSolver::Options defaults;
  const gridfem::SurfaceOptions ofSurface = gridfem::DynamicsSolver::SurfaceDefaults();
  this->Tolerance = defaults.equation.solve.tolerance;
  this->MaximumIterations = defaults.equation.solve.maximumIterations;
  this->Depth = ofSurface.space.depth;
  this->NormalStabilization = ofSurface.choice.normalStabilization;
}

vtkSurfaceDynamics::~vtkSurfaceDynamics() = default;

std::vector<double> vtkSurfaceDynamics::OwnTimeSteps()
{
  std::vector<double> steps(static_cast<std::size_t>(this->NumberOfSteps) + 1);
  std::iota(steps.begin(), steps.end(), 0.0);
  return steps;
}

void vtkSurfaceDynamics::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  this->ReadSelection(inputs);
  const gridfem::InputArray start = surface.Find(0, "Start Array");
  const gridfem::InputArray velocity = surface.Find(1, "Velocity Array");
  const int shown = gridfem::ShownStep(outputs->GetInformationObject(0), 0, this->NumberOfSteps);

  gridfem::DynamicsSolver::Options options;
  options.equation = state.options;
  options.model = static_cast<gridfem::DynamicsModel>(this->Model);
  options.patternLength = this->PatternLength;
  options.numberOfSteps = std::max(shown, 1); // later steps are computed when they are asked for
  options.timeStep = this->TimeStep;
  options.seed = this->Seed;
  options.feed = this->Feed;
  options.kill = this->Kill;
  options.damping = this->Damping;
  options.diffusivity = this->Diffusivity;
  options.diffusivityV = this->DiffusivityV;
  gridfem::DynamicsSolver::Input given;
  given.start = surface.Given(start);
  given.velocity = surface.Given(velocity);
  if (this->Model == Custom)
  {
    given.reactions = gridfem::ReactionsOfFormulas(this->ReactionU, this->ReactionV);
  }
  if (this->Selection->IsGiven())
  {
    given.disturbed.property = "Selection";
    given.disturbed.version.Add(this->Selection->Version());
    given.disturbed.find = [this, &surface]
    {
      gridfem::PointValues selected;
      selected.points = this->Selection->Ids(surface.Mesh());
      return selected;
    };
  }
  this->Data->Result =
    &this->Data->Solver.Update(surface, given, options, { 0, state.GetProgress() });
  this->WriteStep(shown, input, vtkPolyData::GetData(outputs, 0));
  this->Warn(this->Data->Solver.Warnings(shown));
  if (given.start && this->Selection->IsGiven())
  {
    this->Warn({ "The Selection has no effect, because the Start Array is the start." });
  }
}

void vtkSurfaceDynamics::WriteStep(int shown, vtkPolyData* input, vtkPolyData* output)
{
  const gridfem::DynamicsSolver::Result& result = *this->Data->Result;
  const gridfem::DynamicsSolver::Frame& frame = result.frames[static_cast<std::size_t>(shown)];
  output->ShallowCopy(input);
  vtkPointData* points = output->GetPointData();
  constexpr const char* Names[] = { "U", "V" };
  for (gridfem::Id c = 0; c < frame.atPoints.cols(); ++c)
  {
    points->AddArray(
      gridfem::MakePointArray(Names[c], gridfem::MultiVector(frame.atPoints.col(c)), VTK_DOUBLE));
  }
  points->SetActiveScalars("U");
  gridfem::AddFieldInt(output, "Step", shown);
  gridfem::AddFieldNumber(output, "Time", shown * result.timeStep);
  const gridfem::MultiVector integral = frame.integral.matrix().transpose();
  output->GetFieldData()->AddArray(gridfem::MakePointArray("Integral", integral, VTK_DOUBLE));
  if (this->Model == Wave)
  {
    gridfem::AddFieldNumber(output, "Energy", frame.energy);
  }
  else
  {
    output->GetFieldData()->RemoveArray("Energy"); // of earlier dynamics
  }
  gridfem::AddReport(frame.report, output);
}

void vtkSurfaceDynamics::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkSurfaceDynamics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Model: " << this->Model << "\n";
  os << indent << "PatternLength: " << this->PatternLength << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "TimeStep: " << this->TimeStep << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Feed: " << this->Feed << "\n";
  os << indent << "Kill: " << this->Kill << "\n";
  os << indent << "Damping: " << this->Damping << "\n";
  os << indent << "Diffusivity: " << this->Diffusivity << "\n";
  os << indent << "DiffusivityV: " << this->DiffusivityV << "\n";
  os << indent << "ReactionU: " << this->ReactionU << "\n";
  os << indent << "ReactionV: " << this->ReactionV << "\n";
}
