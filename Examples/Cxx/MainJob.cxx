// The main job: a mesh goes in; its octree, basis, Poisson solution, Laplace spectrum and five
// steps of its mean-curvature flow come out. Examples/run.sh builds it, runs it and renders its
// output.
//
// The Poisson solution removes noise from a striped (or colored) surface. It minimizes ∫ w (u - f)²
// + |∇u|², so u stays near the noisy f over lengths above 1 / √w and is smooth below.
//
// Exit codes: 0: everything is written. 1: a step failed. 2: the command line is wrong. 3:
// everything is written, but a solver stopped before its tolerance.

#include "MeshInput.h"
#include "Report.h"
#include "TrefoilKnot.h"

#include <vtkClipToOctree.h>
#include <vtkConnectivityAwareBasis.h>
#include <vtkLaplaceSpectrum.h>
#include <vtkMeanCurvatureFlow.h>
#include <vtkScreenedPoisson.h>

#include <vtkDataArray.h>
#include <vtkDelimitedTextWriter.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace
{

namespace fs = std::filesystem;

enum ExitCode
{
  Done = 0,
  Failed = 1,
  WrongCommandLine = 2,
  NotConverged = 3
};

struct Options
{
  std::string mesh; // empty: the trefoil knot
  std::string output = "output";
  int depth = 6;
  int modes = 24;
};

/// 1 / √w is a fiftieth of the side of a square with the surface's area (units: UnitArea).
constexpr double ScreeningWeight = 2500;

/// The flow removes the noise of a scan and rounds sharp features.
constexpr int FlowSteps = 5;
constexpr double FlowTimeStep = 2e-4; // of the surface's area

struct Pipeline
{
  vtkNew<vtkClipToOctree> clip;
  vtkNew<vtkConnectivityAwareBasis> basis;
  vtkNew<vtkScreenedPoisson> poisson;
  vtkNew<vtkLaplaceSpectrum> spectrum;
  vtkNew<vtkMeanCurvatureFlow> flow;
};

vtkSmartPointer<vtkPolyData> ReadMesh(const Options& options, StepClock& clock)
{
  if (options.mesh.empty())
  {
    return TrefoilKnot();
  }
  vtkSmartPointer<vtkAlgorithm> reader = FindReader(options.mesh);
  if (!reader)
  {
    throw StepFailed(options.mesh +
                     ": this kind of file is not supported. Choose a file that ends in " +
                     MeshFileEndings + ".");
  }
  clock.Run("Read " + fs::path(options.mesh).filename().string(), reader);
  vtkPolyData* mesh = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
  if (!mesh || mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips() == 0)
  {
    throw StepFailed(options.mesh + ": the file has no polygons.");
  }
  return mesh;
}

void Connect(vtkPolyData* mesh, const std::string& array, const Options& options, Pipeline& p)
{
  p.clip->SetInputData(mesh);
  p.clip->SetDepth(options.depth);
  p.clip->GenerateQuadraturePointsOn();
  p.basis->SetInputConnection(p.clip->GetOutputPort());

  p.poisson->SetInputData(0, mesh);
  p.poisson->SetInputConnection(1, p.basis->GetOutputPort());
  p.poisson->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array.c_str());
  p.poisson->SetScreeningWeight(ScreeningWeight);

  p.spectrum->SetInputData(0, mesh);
  p.spectrum->SetInputConnection(1, p.basis->GetOutputPort());
  p.spectrum->SetNumberOfModes(options.modes);
  p.spectrum->SetAllModes(true);

  p.flow->SetInputData(0, mesh);
  p.flow->SetInputConnection(1, p.basis->GetOutputPort());
  p.flow->SetTimeStep(FlowTimeStep);
  p.flow->SetNumberOfSteps(FlowSteps);
}

void Run(Pipeline& p, StepClock& clock)
{
  clock.Run("Clip To Octree", p.clip);
  clock.Run("Connectivity-Aware Basis", p.basis);
  clock.Run("Screened Poisson", p.poisson);
  clock.AddPart("element matrices", p.poisson->GetStageSeconds("System"));
  clock.AddPart("hierarchy", p.poisson->GetStageSeconds("Hierarchy"));
  clock.AddPart("right-hand side", p.poisson->GetStageSeconds("RightHandSide"));
  clock.AddPart("solve", p.poisson->GetStageSeconds("Solve"));
  clock.Run("Laplace Spectrum", p.spectrum);
  clock.Run("Mean Curvature Flow", p.flow);
}

/// Tables have a line per row and a line for the names. VTK's files end with their outermost tag.
bool IsWhole(const fs::path& path, vtkDataObject* data)
{
  std::ifstream file(path, std::ios::binary);
  if (auto* table = vtkTable::SafeDownCast(data))
  {
    const std::istreambuf_iterator<char> begin(file), end;
    return std::count(begin, end, '\n') == table->GetNumberOfRows() + 1;
  }
  constexpr int Tail = 32;
  file.seekg(-Tail, std::ios::end);
  std::string tail(Tail, ' ');
  file.read(tail.data(), Tail);
  return tail.find("</VTKFile>") != std::string::npos;
}

/// On a full disk VTK's writers may report nothing, so this function looks at the written file.
template<class Writer>
void Run(Writer* writer, const fs::path& path, StepClock& clock)
{
  writer->SetFileName(path.c_str());
  clock.Run("Write", writer);
  if (writer->GetErrorCode() != vtkErrorCode::NoError ||
      !IsWhole(path, writer->GetInputDataObject(0, 0)))
  {
    throw StepFailed("The file " + path.string() + " is incomplete. Is the disk full?");
  }
}

template<class Writer>
void Write(const fs::path& path, vtkAlgorithmOutput* port, StepClock& clock)
{
  vtkNew<Writer> writer;
  writer->SetInputConnection(port);
  Run(writer.Get(), path, clock);
}

/// Writes every step as a file. ParaView opens the files as one moving surface.
void WriteFlow(const fs::path& folder, vtkMeanCurvatureFlow* flow, StepClock& clock)
{
  for (int step = 0; step <= FlowSteps; ++step)
  {
    flow->UpdateTimeStep(step);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(flow->GetOutputDataObject(0));
    Run(writer.Get(), folder / ("flow_" + std::to_string(step) + ".vtp"), clock);
  }
}

void WriteAll(const fs::path& folder, Pipeline& p, StepClock& clock)
{
  using MeshWriter = vtkXMLPolyDataWriter;
  using GridWriter = vtkXMLUnstructuredGridWriter;
  Write<MeshWriter>(folder / "clipped.vtp", p.basis->GetOutputPort(0), clock);
  Write<MeshWriter>(folder / "quadrature.vtp", p.clip->GetOutputPort(1), clock);
  Write<GridWriter>(folder / "octree.vtu", p.clip->GetOutputPort(2), clock);
  Write<GridWriter>(folder / "basis.vtu", p.basis->GetOutputPort(1), clock);
  Write<MeshWriter>(folder / "poisson.vtp", p.poisson->GetOutputPort(0), clock);
  Write<MeshWriter>(folder / "modes.vtp", p.spectrum->GetOutputPort(0), clock);
  Write<vtkDelimitedTextWriter>(folder / "eigenvalues.csv", p.spectrum->GetOutputPort(1), clock);
  Write<vtkDelimitedTextWriter>(folder / "flow.csv", p.flow->GetOutputPort(1), clock);
  WriteFlow(folder, p.flow, clock);
}

std::vector<LevelSummary> SummarizeLevels(int depth, vtkConnectivityAwareBasis* basis)
{
  std::vector<LevelSummary> levels;
  for (int level = depth; level >= 0; --level)
  {
    basis->SetLevel(level);
    basis->Update();
    levels.push_back(
      SummarizeLevel(level, vtkUnstructuredGrid::SafeDownCast(basis->GetOutputDataObject(1))));
  }
  return levels;
}

bool Converged(vtkAlgorithm* solver)
{
  vtkFieldData* fields = solver->GetOutputDataObject(0)->GetFieldData();
  vtkDataArray* converged = fields->GetArray("Converged");
  return !converged || converged->GetTuple1(0) != 0;
}

void PrintResults(vtkPolyData* mesh, const std::string& array, Pipeline& p, const StepClock& clock)
{
  std::cout << "mesh               " << mesh->GetNumberOfPoints() << " points, "
            << mesh->GetNumberOfCells() << " cells\n"
            << "clipped triangles  " << p.clip->GetOutput()->GetNumberOfPolys() << "\n";
  PrintLevels(SummarizeLevels(p.clip->GetDepth(), p.basis), std::cout);
  std::cout << "\nPoisson, " << array << " smoothed: ";
  PrintConvergence(vtkTable::SafeDownCast(p.poisson->GetOutputDataObject(1)), std::cout);
  PrintEigenvalues(vtkTable::SafeDownCast(p.spectrum->GetOutputDataObject(1)), std::cout);
  clock.Print(std::cout);
  std::cout << "\nestimated memory of the grid, its matrices and their hierarchy, without outputs: "
            << std::lround(ExpectedMegabytes(mesh, p.clip->GetDepth())) << " MB\n";
}

void CreateFolder(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
  {
    throw StepFailed("The folder " + folder.string() + " cannot be created (" + error.message() +
                     "). Choose another folder with --output.");
  }
}

ExitCode DoMainJob(const Options& options)
{
  StepClock clock;
  CreateFolder(options.output);
  vtkSmartPointer<vtkPolyData> mesh = ReadMesh(options, clock);
  const std::string array = AddArrayToSmooth(mesh);
  Pipeline pipeline;
  Connect(mesh, array, options, pipeline);
  Run(pipeline, clock);
  WriteAll(options.output, pipeline, clock);
  PrintResults(mesh, array, pipeline, clock);
  std::cout << "\nwritten to " << options.output << std::endl;
  const bool converged =
    Converged(pipeline.poisson) && Converged(pipeline.spectrum) && Converged(pipeline.flow);
  return converged ? Done : NotConverged;
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  CLI::App app("Octree, basis, Poisson solution, Laplace spectrum and flow of a triangle mesh.");
  app
    .add_option("MESH", options.mesh,
      std::string("the mesh to work on (") + MeshFileEndings +
        "); by default a trefoil knot with strands that nearly touch")
    ->check(CLI::ExistingFile);
  app.add_option("--depth", options.depth, "2^DEPTH cells lie along the longest side")
    ->check(CLI::Range(2, 14))
    ->capture_default_str();
  app.add_option("--modes", options.modes, "the number of eigenfunctions")
    ->check(CLI::Range(1, 10000))
    ->capture_default_str();
  app.add_option("--output", options.output, "the folder to write to")->capture_default_str();
  try
  {
    app.parse(argc, argv);
    return DoMainJob(options);
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? Done : WrongCommandLine;
  }
  catch (const std::exception& error)
  {
    std::cerr << "gridfem_main_job: " << error.what() << std::endl;
    return Failed;
  }
}
