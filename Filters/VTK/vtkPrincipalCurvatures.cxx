#include "vtkPrincipalCurvatures.h"

#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Solvers/CurvatureSolver.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkPrincipalCurvatures);

struct vtkPrincipalCurvatures::Internals
{
  gridfem::CurvatureSolver Solver;
};

vtkPrincipalCurvatures::vtkPrincipalCurvatures() : Data(std::make_unique<Internals>())
{
  const gridfem::SolveOptions solve = gridfem::CurvatureSolver::Options().equation.solve;
  this->Tolerance = solve.tolerance;
  this->MaximumIterations = solve.maximumIterations;
  this->NormalStabilization =
    gridfem::CurvatureSolver::SurfaceDefaults().choice.normalStabilization;
}

vtkPrincipalCurvatures::~vtkPrincipalCurvatures() = default;

void vtkPrincipalCurvatures::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, nullptr);
  gridfem::CurvatureSolver::Options options;
  options.equation = state.options;
  options.smoothingScale = this->SmoothingScale;
  const gridfem::Progress progress = state.GetProgress();
  const gridfem::CurvatureSolver::Result& result =
    this->Data->Solver.Update(surface, options, { surface.Threads(), progress.Part(0.0, 0.95) });

  output->ShallowCopy(input);
  vtkPointData* points = output->GetPointData();
  const auto add = [&](const char* name, const gridfem::MultiVector& values)
  { points->AddArray(gridfem::MakePointArray(name, values, VTK_DOUBLE)); };
  for (std::size_t k = 0; k < gridfem::CurvatureSolver::Numbers.size(); ++k)
  {
    add(gridfem::CurvatureSolver::Numbers[k], result.numbers.col(static_cast<gridfem::Id>(k)));
  }
  add("MinimumCurvatureDirection", result.minimumDirection);
  add("MaximumCurvatureDirection", result.maximumDirection);
  points->SetActiveScalars("Bending");
  gridfem::AddFieldInt(output, "TurnedTriangles", static_cast<int>(result.turned));
  if (result.isSmoothed)
  {
    gridfem::AddReport(result.report, output);
  }
  this->Warn(result.warnings);
  progress.Check(1.0);
}

void vtkPrincipalCurvatures::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkPrincipalCurvatures::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SmoothingScale: " << this->SmoothingScale << "\n";
}
