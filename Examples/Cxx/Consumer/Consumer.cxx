// Smooths the coordinates of a sphere with the installed filters and looks whether that converged.
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkScreenedPoisson.h>
#include <vtkSphereSource.h>

#include <iostream>

int main()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(20);

  vtkNew<vtkScreenedPoisson> poisson;
  poisson->SetInputConnection(sphere->GetOutputPort());
  poisson->SetDepth(5);
  poisson->Update();

  vtkPolyData* result = poisson->GetOutput();
  vtkDataArray* converged = result->GetFieldData()->GetArray("Converged");
  if (!result->GetPointData()->HasArray("Solution") || !converged || converged->GetTuple1(0) != 1)
  {
    std::cerr << "The screened Poisson equation was not solved.\n";
    return 1;
  }
  std::cout << "Solved at " << result->GetNumberOfPoints() << " points.\n";
  return 0;
}
