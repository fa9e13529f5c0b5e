#include "vtkPoissonAlgorithm.h"

vtkPoissonAlgorithm::vtkPoissonAlgorithm()
{
  this->Tolerance = 0.0;
  this->MaximumIterations = 200;
}

vtkPoissonAlgorithm::~vtkPoissonAlgorithm() = default;

void vtkPoissonAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Accuracy: " << this->Accuracy << "\n";
}
