// Step 4: time. A surface flows by its mean curvature; each step of the flow is a time step of the
// pipeline.
//
//   gridfem_step_4 MESH.vtp DEPTH LAST.vtp

#include <vtkMeanCurvatureFlow.h>

#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>
#include <iostream>
#include <vector>

int main(int argc, char* argv[])
{
  if (argc != 4)
  {
    std::cerr << "Usage: " << argv[0] << " MESH.vtp DEPTH LAST.vtp\n";
    return EXIT_FAILURE;
  }

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(argv[1]);

  // The conformalized flow turns a closed surface without handles into a sphere. For any other
  // surface the filter warns that it will not become a sphere.
  vtkNew<vtkMeanCurvatureFlow> flow;
  flow->SetInputConnection(reader->GetOutputPort());
  flow->SetDepth(std::atoi(argv[2]));
  flow->ConformalizedOn();
  flow->SetTimeStep(1e-3); // per area of the surface
  flow->SetNumberOfSteps(4);

  // The steps are known before any is computed.
  flow->UpdateInformation();
  vtkInformation* information = flow->GetOutputInformation(0);
  const double* first = information->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  const std::vector<double> times( // a copy, because an update may replace them
    first, first + information->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));

  for (const double time : times)
  {
    flow->UpdateTimeStep(time); // continues from the step before, which is kept
    if (flow->GetOutput()->GetNumberOfPoints() == 0)
    {
      return EXIT_FAILURE;
    }
  }

  // The second output is a table with a row for each step.
  auto* steps = vtkTable::SafeDownCast(flow->GetOutputDataObject(1));
  for (vtkIdType row = 0; row < steps->GetNumberOfRows(); ++row)
  {
    std::cout << "step " << row << ": area " << steps->GetValueByName(row, "Area").ToDouble()
              << ", volume " << steps->GetValueByName(row, "Volume").ToDouble() << ", sphericity "
              << steps->GetValueByName(row, "Sphericity").ToDouble() << "\n";
  }

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(flow->GetOutput());
  writer->SetFileName(argv[3]);
  return writer->Write() ? EXIT_SUCCESS : EXIT_FAILURE;
}
