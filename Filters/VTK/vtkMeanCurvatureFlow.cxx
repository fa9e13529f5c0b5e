#include "vtkMeanCurvatureFlow.h"

#include "Output/ClippedMeshWriter.h"
#include "Output/MovedMeshWriter.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"
#include "Pipeline/PipelineTime.h"

#include "Integrals/QuadratureRule.h"
#include "Solvers/FlowSolver.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <numeric>

vtkStandardNewMacro(vtkMeanCurvatureFlow);

namespace
{

using Step = gridfem::FlowSolver::Step;

void WriteTable(const std::vector<Step>& steps, vtkTable* table)
{
  const auto numbers = [&](const char* name, const auto& numberOf)
  {
    std::vector<double> column(steps.size());
    std::transform(steps.begin(), steps.end(), column.begin(), numberOf);
    gridfem::AddColumn(table, name, column);
  };
  const auto counts = [&](const char* name, const auto& countOf)
  {
    std::vector<int> column(steps.size());
    std::transform(steps.begin(), steps.end(), column.begin(), countOf);
    gridfem::AddColumn(table, name, column);
  };
  counts("Step", [](const Step& step) { return step.step; });
  numbers("Time", [](const Step& step) { return step.time; });
  numbers("Area", [](const Step& step) { return step.area; });
  numbers("Volume", [](const Step& step) { return step.volume; });
  numbers("Sphericity", [](const Step& step) { return step.sphericity; });
  numbers("QuasiConformalError", [](const Step& step) { return step.quasiConformalError; });
  counts("Iterations", [](const Step& step) { return step.iterations; });
  counts("LockedSamples", [](const Step& step) { return static_cast<int>(step.lockedSamples); });
  numbers("DiscretizationError", [](const Step& step) { return step.accuracy.discretization; });
  numbers("Seconds", [](const Step& step) { return step.seconds; });
}

} // namespace

struct vtkMeanCurvatureFlow::Internals
{
  gridfem::FlowSolver Solver;
};

vtkMeanCurvatureFlow::vtkMeanCurvatureFlow() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  this->Tolerance = gridfem::FlowSolver::Options().equation.solve.tolerance;
}

vtkMeanCurvatureFlow::~vtkMeanCurvatureFlow() = default;

int vtkMeanCurvatureFlow::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkTable");
  return 1;
}

std::vector<double> vtkMeanCurvatureFlow::OwnTimeSteps()
{
  if (this->TimeFrom == Input)
  {
    return {};
  }
  std::vector<double> steps(static_cast<std::size_t>(this->NumberOfSteps) + 1);
  std::iota(steps.begin(), steps.end(), 0.0);
  return steps;
}

void vtkMeanCurvatureFlow::FreeStages()
{
  this->Superclass::FreeStages();
  this->Data = std::make_unique<Internals>();
}

void vtkMeanCurvatureFlow::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  gridfem::FlowSolver& solver = this->Data->Solver;
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));

  gridfem::FlowSolver::Options options;
  options.equation.solve = state.options.solve;
  options.equation.multigrid.device = state.options.multigrid.device;
  options.timeStep = this->TimeStep;
  options.numberOfSteps = this->NumberOfSteps;
  options.conformalized = this->Conformalized;
  options.trackMetric = this->TrackMetric;
  options.fixedBoundary = this->FixedBoundary;
  options.rescale = static_cast<gridfem::FlowSolver::Rescale>(this->Rescale);
  const gridfem::Progress progress = state.GetProgress();
  const gridfem::FlowSolver::Result& result =
    solver.Update(surface, options, { surface.Threads(), progress.Part(0.0, 0.9) });

  const int last = static_cast<int>(result.steps.size()) - 1;
  const int shown =
    this->TimeFrom == Input ? last : gridfem::ShownStep(outputs->GetInformationObject(0), 0, last);
  output->ShallowCopy(input);
  gridfem::MoveMesh(surface.Mesh(), solver.PointsAt(shown, surface, progress.Part(0.9, 0.98)),
    gridfem::OutputPrecision(input->GetPoints()), this->NumberOfThreads, output);
  gridfem::AddFieldInt(output, "Step", shown);
  gridfem::AddFieldNumber(output, "FlowTime", result.steps[shown].time);
  gridfem::AddFieldInt(output, "Converged", solver.HasConverged(shown) ? 1 : 0);
  gridfem::AddDevice(result.steps[shown].where, output);
  gridfem::AddAccuracy(result.steps[shown].accuracy, output);
  WriteTable(result.steps, vtkTable::GetData(outputs, 1));
  gridfem::WriteText("Step " + std::to_string(shown) + ", sphericity " +
                       gridfem::ShortNumber(result.steps[shown].sphericity),
    vtkTable::GetData(outputs, 2));
  this->Warn(result.warnings);
  progress.Check(1.0);
}

void vtkMeanCurvatureFlow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TimeStep: " << this->TimeStep << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "TimeFrom: " << this->TimeFrom << "\n";
  os << indent << "Conformalized: " << this->Conformalized << "\n";
  os << indent << "TrackMetric: " << this->TrackMetric << "\n";
  os << indent << "FixedBoundary: " << this->FixedBoundary << "\n";
  os << indent << "Rescale: " << this->Rescale << "\n";
}
