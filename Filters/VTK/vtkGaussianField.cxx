#include "vtkGaussianField.h"

#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Solvers/GaussianFieldSolver.h"

#include "vtkDataArray.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <iomanip>
#include <sstream>

vtkStandardNewMacro(vtkGaussianField);

namespace
{

std::string NameOfSample(gridfem::Id number)
{
  std::ostringstream name;
  name << "Sample" << std::setw(3) << std::setfill('0') << number;
  return name.str();
}

} // namespace

struct vtkGaussianField::Internals
{
  gridfem::GaussianFieldSolver Solver;
};

vtkGaussianField::vtkGaussianField() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  const gridfem::GaussianFieldSolver::Options defaults;
  this->Tolerance = defaults.equation.solve.tolerance;
  this->MaximumIterations = defaults.equation.solve.maximumIterations;
  this->NormalStabilization =
    gridfem::GaussianFieldSolver::SurfaceDefaults().choice.normalStabilization;
}

vtkGaussianField::~vtkGaussianField() = default;

void vtkGaussianField::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  gridfem::GaussianFieldSolver::Options options;
  options.equation = state.options;
  options.range = this->Range;
  options.smoothness = this->Smoothness;
  options.standardDeviation = this->StandardDeviation;
  options.seed = this->Seed;
  options.numberOfSamples = this->NumberOfSamples;
  options.statistics = this->Statistics;
  const gridfem::GaussianFieldSolver::Result& result =
    this->Data->Solver.Update(surface, options, { 0, state.GetProgress() });

  output->ShallowCopy(input);
  vtkPointData* points = output->GetPointData();
  for (gridfem::Id column = 0; column < result.atPoints.cols(); ++column)
  {
    const std::string name = !this->Statistics ? NameOfSample(column)
                             : column == 0     ? "SampleMean"
                                               : "SampleStandardDeviation";
    points->AddArray(
      gridfem::MakePointArray(name.c_str(), result.atPoints.col(column), VTK_DOUBLE));
  }
  points->SetActiveScalars(this->Statistics ? "SampleStandardDeviation" : "Sample000");
  gridfem::AddReport(result.report, output);
  this->Warn(result.warnings);
}

void vtkGaussianField::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
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
}
