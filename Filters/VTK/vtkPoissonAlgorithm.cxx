#include "vtkPoissonAlgorithm.h"

#include "Private/Ranks.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceSolverState.h"

vtkPoissonAlgorithm::vtkPoissonAlgorithm()
{
  this->Tolerance = 0.0;
  this->MaximumIterations = 200;
}

vtkPoissonAlgorithm::~vtkPoissonAlgorithm() = default;

void vtkPoissonAlgorithm::SetTolerance(double tolerance)
{
  if (!(tolerance <= 0.0)) // NaN is refused when the filter runs
  {
    this->Superclass::SetTolerance(tolerance);
  }
  else if (this->Tolerance != 0.0)
  {
    this->Tolerance = 0.0;
    this->Modified();
  }
}

void vtkPoissonAlgorithm::WriteReport(const gridfem::SolveReport& report,
  const gridfem::SolutionAccuracy& accuracy, vtkPolyData* output)
{
  gridfem::AddReport(report, output);
  gridfem::AddAccuracy(accuracy, output);
  const std::string warning =
    gridfem::WarningOf(report, accuracy, this->State->options.solve.tolerance);
  if (!warning.empty() && gridfem::Ranks().IsFirst())
  {
    vtkWarningMacro(<< warning);
  }
}

void vtkPoissonAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Accuracy: " << this->Accuracy << "\n";
}
