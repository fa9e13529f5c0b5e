// The messages of the main job, while it works and at its end.
#ifndef GridFEM_Examples_Report_h
#define GridFEM_Examples_Report_h

#include <vtkAlgorithm.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

/// A step of the pipeline failed. what() is a message for the user.
class StepFailed : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Runs pipeline steps one after the other and records the time and memory of each. If standard
/// error is a terminal, a line shows the progress of the current step.
class StepClock
{
public:
  /// Sends VTK's warnings through this class: each becomes one line on standard error.
  StepClock();

  /// Updates an algorithm. Consecutive runs with the same name count as one step. Throws StepFailed
  /// with the messages of the algorithm.
  void Run(const std::string& name, vtkAlgorithm* algorithm);

  /// Adds a part of a step that has already run. A part has no memory of its own.
  void AddPart(const std::string& name, double seconds);

  /// Prints a table: the seconds of every step, the largest memory of the process until its end,
  /// and the memory at its end. All filters keep their results for the next change.
  void Print(std::ostream& out) const;

private:
  struct Step
  {
    std::string name;
    double seconds;
    double megabytes; // negative for a part
    double held;
  };
  std::vector<Step> steps_;
};

/// Estimates the memory of clip, function space, matrices and hierarchy of a mesh with one
/// right-hand side, without the outputs of filters. The filters refuse a mesh that exceeds the
/// memory of the machine.
double ExpectedMegabytes(vtkPolyData* mesh, int depth);

/// One level of the function space.
struct LevelSummary
{
  int level;
  vtkIdType patches;
  vtkIdType functions;
  vtkIdType nonZeros; // of the level's matrices
};

/// Counts on the second output of vtkConnectivityAwareBasis.
LevelSummary SummarizeLevel(int level, vtkUnstructuredGrid* basis);

void PrintLevels(const std::vector<LevelSummary>& levels, std::ostream& out);

/// The last row of the Poisson solver's table.
void PrintConvergence(vtkTable* history, std::ostream& out);

/// The first rows of the spectrum's table, at most ten.
void PrintEigenvalues(vtkTable* spectrum, std::ostream& out);

#endif
