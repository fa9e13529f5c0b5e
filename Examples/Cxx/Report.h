// What the main job says while it works and when it is done.
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

/// A step of the pipeline could not do its work; what() is fit for the user.
class StepFailed : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Runs pipeline steps one after the other and keeps what each took. While a step runs, a line
/// shows how far it is, when standard error is a terminal.
class StepClock
{
public:
  /// Sends VTK's warnings through this class: each becomes one line on standard error.
  StepClock();

  /// Updates an algorithm; runs of one name in a row count as one step. Throws StepFailed with what
  /// the algorithm reported.
  void Run(const std::string& name, vtkAlgorithm* algorithm);

  /// Adds a part of a step that ran already; it has no memory of its own.
  void AddPart(const std::string& name, double seconds);

  /// A table: seconds of every step, the largest memory the process had used when it ended, and
  /// what it held then: all filters keep what they made, for the next change.
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

/// What clip, function space, matrices and hierarchy of a mesh with one right-hand side are
/// expected to take, without the outputs of filters: they refuse what does not fit the memory of
/// the machine.
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
