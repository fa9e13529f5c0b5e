// Step 2: one basis for several solvers. Reads a mesh, clips it, builds the basis, and lets two
// solvers share it.
//
//   gridfem_step_2 MESH.vtp DEPTH SMOOTH.vtp MODES.vtp

#include <vtkClipToOctree.h>
#include <vtkConnectivityAwareBasis.h>
#include <vtkLaplaceSpectrum.h>
#include <vtkScreenedPoisson.h>

#include <vtkNew.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  if (argc != 5)
  {
    std::cerr << "Usage: " << argv[0] << " MESH.vtp DEPTH SMOOTH.vtp MODES.vtp\n";
    return EXIT_FAILURE;
  }

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(argv[1]);

  // 2^Depth cells lie along the longest side of the mesh.
  vtkNew<vtkClipToOctree> clip;
  clip->SetInputConnection(reader->GetOutputPort());
  clip->SetDepth(std::atoi(argv[2]));

  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputConnection(clip->GetOutputPort());

  // A solver takes the mesh on port 0 and the basis on port 1; its output has the mesh's own points
  // and cells. No array is chosen here, so the filter smooths the coordinates.
  vtkNew<vtkScreenedPoisson> poisson;
  poisson->SetInputConnection(0, reader->GetOutputPort());
  poisson->SetInputConnection(1, basis->GetOutputPort());
  poisson->SetScreeningWeight(1000);

  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetInputConnection(0, reader->GetOutputPort());
  spectrum->SetInputConnection(1, basis->GetOutputPort());
  spectrum->SetNumberOfModes(10);
  spectrum->AllModesOn(); // Mode000 to Mode009; else the array Mode, one mode per time step

  vtkNew<vtkXMLPolyDataWriter> smoothWriter;
  smoothWriter->SetInputConnection(poisson->GetOutputPort());
  smoothWriter->SetFileName(argv[3]);

  vtkNew<vtkXMLPolyDataWriter> modesWriter;
  modesWriter->SetInputConnection(spectrum->GetOutputPort());
  modesWriter->SetFileName(argv[4]);

  // The clip and the basis run once, for both. VTK prints errors on standard error. The output is
  // then empty.
  const bool written = smoothWriter->Write() && modesWriter->Write();
  const bool solved =
    poisson->GetOutput()->GetNumberOfPoints() > 0 && spectrum->GetOutput()->GetNumberOfPoints() > 0;
  return written && solved ? EXIT_SUCCESS : EXIT_FAILURE;
}
