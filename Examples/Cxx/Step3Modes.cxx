// Step 3: modes, signatures of the points, and a long computation that reports its progress and can
// be stopped.
//
//   gridfem_step_3 MESH.vtp DEPTH SIGNATURES.vtp

#include <vtkLaplaceSpectrum.h>
#include <vtkSpectralSignatures.h>

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>
#include <iostream>

namespace
{

/// Prints every tenth of the progress. To stop the computation, call filter->SetAbortExecute(1)
/// here.
void Report(vtkObject* caller, unsigned long /*event*/, void* client, void* /*data*/)
{
  auto* filter = static_cast<vtkAlgorithm*>(caller);
  int& tenths = *static_cast<int*>(client);
  if (filter->GetProgress() * 10 >= tenths + 1)
  {
    tenths = static_cast<int>(filter->GetProgress() * 10);
    std::cout << tenths << "0 % " << std::flush;
  }
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 4)
  {
    std::cerr << "Usage: " << argv[0] << " MESH.vtp DEPTH SIGNATURES.vtp\n";
    return EXIT_FAILURE;
  }

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetInputConnection(reader->GetOutputPort());
  spectrum->SetDepth(std::atoi(argv[2]));
  spectrum->SetNumberOfModes(40);
  spectrum->AllModesOn(); // all of them on the output, for the next filter

  int tenths = 0;
  vtkNew<vtkCallbackCommand> report;
  report->SetCallback(Report);
  report->SetClientData(&tenths);
  spectrum->AddObserver(vtkCommand::ProgressEvent, report);

  // The second output is a table with a row for each mode.
  spectrum->Update();
  vtkTable* modes = vtkTable::SafeDownCast(spectrum->GetOutputDataObject(1));
  if (!modes || modes->GetNumberOfRows() < 2)
  {
    return EXIT_FAILURE;
  }
  std::cout << "\nThe first eigenvalue above 0 is "
            << modes->GetValueByName(1, "Eigenvalue").ToDouble() << ", known to a part of "
            << modes->GetValueByName(1, "EstimatedError").ToDouble() << ".\n";

  // The filter takes the modes of its input and adds arrays, such as the heat kernel signature and
  // the biharmonic distance from point 0.
  vtkNew<vtkSpectralSignatures> signatures;
  signatures->SetInputConnection(spectrum->GetOutputPort());
  signatures->AddSourcePointId(0);

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(signatures->GetOutputPort());
  writer->SetFileName(argv[3]);
  const bool written = writer->Write() != 0;
  return written && signatures->GetOutput()->GetNumberOfPoints() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
