#include "vtkPoissonAlgorithm.h"

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

void vtkPoissonAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Accuracy: " << this->Accuracy << "\n";
}
