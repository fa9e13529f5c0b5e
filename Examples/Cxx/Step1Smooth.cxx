// Step 1: applies one filter to a mesh. Smooths the shape, and prints the filter's report on its
// answer.
//
//   gridfem_step_1 MESH.vtp DEPTH SMOOTH.vtp

#include <vtkScreenedPoisson.h>

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  if (argc != 4)
  {
    std::cerr << "Usage: " << argv[0] << " MESH.vtp DEPTH SMOOTH.vtp\n";
    return EXIT_FAILURE;
  }

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(argv[1]);

  // The filter clips the mesh and builds its functions itself: 2^Depth cells lie along the longest
  // side. No array is chosen, so the filter smooths the coordinates, and the points move.
  vtkNew<vtkScreenedPoisson> poisson;
  poisson->SetInputConnection(reader->GetOutputPort());
  poisson->SetDepth(std::atoi(argv[2]));
  poisson->SetScreeningWeight(1000); // per area of the surface; larger keeps more

  // VTK prints errors on standard error. The output is then empty.
  poisson->Update();
  vtkPolyData* smooth = poisson->GetOutput();
  if (smooth->GetNumberOfPoints() == 0)
  {
    return EXIT_FAILURE;
  }

  // The field data has the filter's report on its answer.
  const auto said = [&](const char* name)
  { return smooth->GetFieldData()->GetArray(name)->GetTuple1(0); };
  std::cout << (said("Converged") != 0 ? "Converged" : "Stopped") << " after " << said("Iterations")
            << " iterations; the functions are about " << 100 * said("DiscretizationError")
            << " % off, the solver " << 100 * said("AlgebraicError") << " %.\n";

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(poisson->GetOutputPort());
  writer->SetFileName(argv[3]);
  return writer->Write() ? EXIT_SUCCESS : EXIT_FAILURE;
}
