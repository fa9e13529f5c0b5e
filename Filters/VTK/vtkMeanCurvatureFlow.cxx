#include "vtkMeanCurvatureFlow.h"

#include "Private/ClippedMeshWriter.h"
#include "Private/InputValidation.h"
#include "Private/MovedMeshWriter.h"
#include "Private/PipelineTime.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceFlow.h"

#include "Base/Errors.h"
#include "Integrals/QuadratureRule.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <numeric>
#include <string>

vtkStandardNewMacro(vtkMeanCurvatureFlow);

namespace
{

gridfem::Rescaling RescalingOf(int rescale, bool conformalized)
{
  switch (rescale)
  {
    case vtkMeanCurvatureFlow::NoRescale:
      return gridfem::Rescaling::None;
    case vtkMeanCurvatureFlow::ConstantArea:
      return gridfem::Rescaling::ConstantArea;
    case vtkMeanCurvatureFlow::ConstantVolume:
      return gridfem::Rescaling::ConstantVolume;
    default:
      return conformalized ? gridfem::Rescaling::ConstantArea : gridfem::Rescaling::None;
  }
}

} // namespace

struct vtkMeanCurvatureFlow::Internals : gridfem::SurfaceFlow
{
};

vtkMeanCurvatureFlow::vtkMeanCurvatureFlow() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  this->Tolerance = 5e-4;
  this->State->options.multigrid.cycle = gridfem::CycleType::V;
}

vtkMeanCurvatureFlow::~vtkMeanCurvatureFlow() = default;

int vtkMeanCurvatureFlow::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

std::vector<double> vtkMeanCurvatureFlow::OwnTimeSteps()
{
  std::vector<double> steps(static_cast<std::size_t>(this->NumberOfSteps) + 1);
  std::iota(steps.begin(), steps.end(), 0.0);
  return steps;
}

void vtkMeanCurvatureFlow::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkMeanCurvatureFlow::WriteTable(vtkTable* table)
{
  const std::vector<gridfem::FlowRow> rows = this->Data->Rows();
  const gridfem::SurfaceSolverState& state = *this->State;
  const double unit = state.space->UnitLength();
  const auto numbers = [&](const char* name, const auto& numberOf)
  {
    std::vector<double> column(rows.size());
    std::transform(rows.begin(), rows.end(), column.begin(), numberOf);
    gridfem::AddColumn(table, name, column);
  };
  const auto counts = [&](const char* name, const auto& countOf)
  {
    std::vector<int> column(rows.size());
    std::transform(rows.begin(), rows.end(), column.begin(), countOf);
    gridfem::AddColumn(table, name, column);
  };
  using Row = gridfem::FlowRow;
  counts("Step", [](const Row& row) { return row.step; });
  numbers("Time", [=](const Row& row) { return row.time * unit * unit; });
  numbers("Area", [](const Row& row) { return row.area; });
  numbers("Volume", [](const Row& row) { return row.volume; });
  numbers("Sphericity", [](const Row& row) { return row.sphericity; });
  numbers("QuasiConformalError", [](const Row& row) { return row.quasiConformalError; });
  counts("Iterations", [](const Row& row) { return row.iterations; });
  counts("LockedSamples", [](const Row& row) { return static_cast<int>(row.lockedSamples); });
  numbers("DiscretizationError", [](const Row& row) { return row.accuracy.discretization; });
  numbers("Seconds", [](const Row& row) { return row.seconds; });
}

void vtkMeanCurvatureFlow::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::TriangleRule(this->QuadratureDegree); // refuses a wrong degree before the long work
  gridfem::RequireNumber("TimeStep", this->TimeStep);
  if (!(this->TimeStep > 0.0) || std::isinf(this->TimeStep))
  {
    throw gridfem::InvalidInput("TimeStep must be above 0 and finite.");
  }
  if (this->Conformalized && !this->TrackMetric)
  {
    throw gridfem::InvalidInput("Conformalized keeps the stiffness of the input on its functions, "
                                "so TrackMetric has to be on.");
  }
  const gridfem::Rescaling rescaling = RescalingOf(this->Rescale, this->Conformalized);
  if (this->FixedBoundary && (this->Conformalized || rescaling != gridfem::Rescaling::None))
  {
    throw gridfem::InvalidInput("FixedBoundary holds the boundary where it is, but Conformalized "
                                "and Rescale move all of the surface.");
  }
  state.UpdateSpace(input, vtkPolyData::GetData(inputs[1]), progress.Part(0.0, 0.1));
  state.UpdateSystem(progress.Part(0.1, 0.2));

  gridfem::FlowRequest request;
  request.timeStep = this->TimeStep;
  request.numberOfSteps = this->NumberOfSteps;
  request.conformalized = this->Conformalized;
  request.trackMetric = this->TrackMetric;
  request.fixedBoundary = this->FixedBoundary;
  request.rescaling = rescaling;
  request.keptBytes = this->KeptBytes;
  const bool isNew = this->Data->Update(state, request, progress.Part(0.2, 0.9));

  const std::vector<gridfem::FlowRow> rows = this->Data->Rows();
  vtkInformation* info = outputs->GetInformationObject(0);
  const int shown = gridfem::ShownStep(info, 0, static_cast<int>(rows.size()) - 1);
  const std::vector<gridfem::Vec3> points =
    this->Data->PointsAt(shown, state, progress.Part(0.9, 0.98));
  output->ShallowCopy(input);
  gridfem::MoveMesh(*state.mesh.triangles, points, gridfem::OutputPrecision(input->GetPoints()),
    this->NumberOfThreads, output);
  const double unit = state.space->UnitLength();
  const bool converged = static_cast<int>(rows.size()) > this->NumberOfSteps &&
                         std::all_of(rows.begin(), rows.begin() + shown + 1,
                           [](const gridfem::FlowRow& row) { return row.converged; });
  gridfem::AddFieldInt(output, "Step", shown);
  gridfem::AddFieldNumber(output, "FlowTime", rows[shown].time * unit * unit);
  gridfem::AddFieldInt(output, "Converged", converged ? 1 : 0);
  gridfem::AddAccuracy(rows[shown].accuracy, output);
  this->WriteTable(vtkTable::GetData(outputs, 1));
  const std::string warning = isNew ? this->Data->Warning(state) : std::string();
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  progress.Check(1.0);
}

void vtkMeanCurvatureFlow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TimeStep: " << this->TimeStep << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "Conformalized: " << this->Conformalized << "\n";
  os << indent << "TrackMetric: " << this->TrackMetric << "\n";
  os << indent << "FixedBoundary: " << this->FixedBoundary << "\n";
  os << indent << "Rescale: " << this->Rescale << "\n";
}
