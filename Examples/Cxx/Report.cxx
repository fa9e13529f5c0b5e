#include "Report.h"

#include <Solvers/MemoryEstimate.h>

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

namespace
{

/// Collects errors until the step that caused them has ended.
class MessageWindow : public vtkOutputWindow
{
public:
  static MessageWindow* New();
  vtkTypeMacro(MessageWindow, vtkOutputWindow);

  void DisplayErrorText(const char* text) override
  {
    const std::string message = Message(text);
    // The pipeline only repeats that an algorithm failed. The message before gives the reason.
    if (message.rfind("Algorithm ", 0) != 0)
    {
      this->Errors += (this->Errors.empty() ? "" : "\n") + message;
    }
  }
  void DisplayWarningText(const char* text) override
  {
    std::cerr << "Warning: " << Message(text) << "\n";
  }
  void DisplayGenericWarningText(const char* text) override { this->DisplayWarningText(text); }

  std::string Errors;

protected:
  MessageWindow() = default;

private:
  /// Returns VTK's text without the file, the line, and the address of the object.
  static std::string Message(const std::string& text)
  {
    const std::size_t line = text.find('\n');
    std::string message = line == std::string::npos ? text : text.substr(line + 1);
    const std::size_t object = message.find("): ");
    if (message.rfind("vtk", 0) == 0 && object != std::string::npos)
    {
      message.erase(0, object + 3);
    }
    message.erase(message.find_last_not_of(" \n") + 1);
    return message;
  }
};
vtkStandardNewMacro(MessageWindow);

MessageWindow* Messages()
{
  return static_cast<MessageWindow*>(vtkOutputWindow::GetInstance());
}

double PeakMegabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return static_cast<double>(usage.ru_maxrss) / (1024 * 1024); // bytes there
#else
  return static_cast<double>(usage.ru_maxrss) / 1024;
#endif
}

/// Returns the memory that the process holds now, or 0 if the system does not tell. Only Linux
/// tells.
double ResidentMegabytes()
{
  long pages = 0;
  long residentPages = 0;
  std::ifstream("/proc/self/statm") >> pages >> residentPages;
  return static_cast<double>(residentPages) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         (1024 * 1024);
}

bool ShowsProgress()
{
  return isatty(STDERR_FILENO) != 0;
}

void ClearProgressLine()
{
  if (ShowsProgress())
  {
    std::cerr << "\r\033[K" << std::flush;
  }
}

void ShowProgress(vtkObject* caller, unsigned long, void* name, void*)
{
  const int percent = static_cast<int>(100 * vtkAlgorithm::SafeDownCast(caller)->GetProgress());
  std::cerr << "\r\033[K" << static_cast<const char*>(name) << " " << percent << " %" << std::flush;
}

unsigned long ObserveProgress(const std::string& name, vtkAlgorithm* algorithm)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(ShowProgress);
  command->SetClientData(const_cast<char*>(name.c_str()));
  return algorithm->AddObserver(vtkCommand::ProgressEvent, command);
}

} // namespace

StepClock::StepClock()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // would print all of it twice
  vtkNew<MessageWindow> window;
  vtkOutputWindow::SetInstance(window);
}

void StepClock::Run(const std::string& name, vtkAlgorithm* algorithm)
{
  const unsigned long observer = ShowsProgress() ? ObserveProgress(name, algorithm) : 0;
  const auto start = std::chrono::steady_clock::now();
  algorithm->Update();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  algorithm->RemoveObserver(observer);
  ClearProgressLine();
  if (!Messages()->Errors.empty())
  {
    throw StepFailed(name + ": " + Messages()->Errors);
  }
  if (this->steps_.empty() || this->steps_.back().name != name)
  {
    this->steps_.push_back({ name, 0, 0, 0 });
  }
  this->steps_.back().seconds += seconds.count();
  this->steps_.back().megabytes = PeakMegabytes();
  this->steps_.back().held = ResidentMegabytes();
}

void StepClock::AddPart(const std::string& name, double seconds)
{
  this->steps_.push_back({ "  " + name, seconds, -1, 0 });
}

void StepClock::Print(std::ostream& out) const
{
  out << "\n"
      << std::left << std::setw(30) << "step" << std::right << std::setw(10) << "seconds"
      << std::setw(20) << "peak memory / MB" << std::setw(12) << "held / MB"
      << "\n";
  double total = 0;
  for (const Step& step : this->steps_)
  {
    out << std::left << std::setw(30) << step.name << std::right << std::fixed
        << std::setprecision(2) << std::setw(10) << step.seconds;
    if (step.megabytes >= 0)
    {
      total += step.seconds;
      out << std::setprecision(0) << std::setw(20) << step.megabytes << std::setw(12) << step.held;
    }
    out << "\n";
  }
  out << std::left << std::setw(30) << "all" << std::right << std::setprecision(2) << std::setw(10)
      << total << std::defaultfloat << "\n";
}

double ExpectedMegabytes(vtkPolyData* mesh, int depth)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  vtkPolyData* const simple = triangles->GetOutput();
  gridfem::TriangleMesh surface;
  for (vtkIdType point = 0; point < simple->GetNumberOfPoints(); ++point)
  {
    surface.points.emplace_back(simple->GetPoint(point));
  }
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  vtkCellArray* const polygons = simple->GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(size, corners);)
  {
    surface.triangles.push_back({ corners[0], corners[1], corners[2] });
  }
  return gridfem::EstimateMemory(surface, depth).bytes / (1024 * 1024);
}

LevelSummary SummarizeLevel(int level, vtkUnstructuredGrid* basis)
{
  LevelSummary summary{ level, basis->GetNumberOfCells(), basis->GetNumberOfPoints(), 0 };
  basis->BuildLinks();
  std::vector<vtkIdType> neighbors;
  for (vtkIdType function = 0; function < summary.functions; ++function)
  {
    // Two functions share a matrix entry when they share a patch.
    vtkIdType numberOfPatches;
    vtkIdType* patches;
    basis->GetPointCells(function, numberOfPatches, patches);
    neighbors.clear();
    for (vtkIdType i = 0; i < numberOfPatches; ++i)
    {
      vtkIdType numberOfFunctions;
      const vtkIdType* functions;
      basis->GetCellPoints(patches[i], numberOfFunctions, functions);
      neighbors.insert(neighbors.end(), functions, functions + numberOfFunctions);
    }
    std::sort(neighbors.begin(), neighbors.end());
    summary.nonZeros += std::unique(neighbors.begin(), neighbors.end()) - neighbors.begin();
  }
  return summary;
}

void PrintLevels(const std::vector<LevelSummary>& levels, std::ostream& out)
{
  out << "\nlevel     patches   functions   non-zeros   per row\n";
  for (const LevelSummary& level : levels)
  {
    const double perRow =
      static_cast<double>(level.nonZeros) / static_cast<double>(level.functions);
    out << std::setw(5) << level.level << std::setw(12) << level.patches << std::setw(12)
        << level.functions << std::setw(12) << level.nonZeros << std::fixed << std::setprecision(1)
        << std::setw(10) << perRow << std::defaultfloat << "\n";
  }
}

void PrintConvergence(vtkTable* history, std::ostream& out)
{
  const vtkIdType last = history->GetNumberOfRows() - 1;
  if (last < 0)
  {
    return;
  }
  out << history->GetValueByName(last, "Iteration").ToInt()
      << " iterations; estimated error of the solver " << std::setprecision(2)
      << history->GetValueByName(last, "AlgebraicError").ToDouble() << ", of the function space "
      << history->GetValueByName(last, "DiscretizationError").ToDouble()
      << ", relative to the solution\n";
}

void PrintEigenvalues(vtkTable* spectrum, std::ostream& out)
{
  constexpr vtkIdType shown = 10;
  out << "\n mode   eigenvalue     residual\n";
  for (vtkIdType i = 0; i < std::min(shown, spectrum->GetNumberOfRows()); ++i)
  {
    out << std::setw(5) << spectrum->GetValueByName(i, "Mode").ToInt() << std::setprecision(6)
        << std::setw(13) << spectrum->GetValueByName(i, "Eigenvalue").ToDouble()
        << std::setprecision(2) << std::setw(13)
        << spectrum->GetValueByName(i, "Residual").ToDouble() << "\n";
  }
}
