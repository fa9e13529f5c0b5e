// Support shared by the tests of spectra: eigenvalues of a filter, and surfaces that carry modes.
#ifndef GridFEM_Testing_Spectra_h
#define GridFEM_Testing_Spectra_h

#include "FilterSupport.h"

#include "vtkLaplaceSpectrum.h"

namespace gridfem::testing
{

inline std::vector<double> Eigenvalues(vtkLaplaceSpectrum* filter)
{
  filter->Update();
  return Values(filter->GetOutput()->GetFieldData()->GetArray("Eigenvalues"));
}

/// Returns the surface with its first modes and their eigenvalues, on a grid of the depth.
inline vtkSmartPointer<vtkPolyData> WithModes(vtkPolyData* surface, int modes, int depth = 5)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetInputData(surface);
  spectrum->SetDepth(depth);
  spectrum->SetNumberOfModes(modes);
  spectrum->AllModesOn();
  spectrum->Update();
  return spectrum->GetOutput();
}

} // namespace gridfem::testing

#endif
