// Compares discretizations and solvers by their error in the conformalized flow of a folded surface
// within a given time. Each takes as many steps as the time allows. [T §6.2.3, Table 6.2, Figure
// 6.9]
#ifndef GridFEM_Benchmarks_FlowComparison_h
#define GridFEM_Benchmarks_FlowComparison_h

#include "Chart.h"

#include <string>
#include <vector>

namespace gridfem::benchmarks
{

struct FlowComparisonOptions
{
  const char* file = "brain_mni_LR.ply"; // in millimeters
  int subdivisions = 1;
  int depth = 7;
  /// Squared millimeters. The thesis' 50, for it steps by δ / 2.
  double time = 25.0;
  double budget = 12.0; // processor seconds of each contestant
  int truthSteps = 24;  // before extrapolation; even
  bool hasFinerTruth = false;
  double tolerance = 5e-4; // of iterative solvers
  /// One: processor time is the same measure for libraries with and without threads.
  int threads = 1;
};

/// The result of one contestant with its budget. Errors are distances of points from where a truth
/// has them: RMS over the points, in millimeters.
struct BudgetedFlow
{
  std::string space;
  std::string solver;
  double functions = 0.0;
  double nonZeros = 0.0;
  double secondsOfStep = 0.0;
  int steps = 0;
  double iterations = 0.0;        // mean per step
  std::vector<double> time;       // after each step
  std::vector<double> error;      // to hat functions of the mesh, as in the thesis
  std::vector<double> finerError; // to hat functions of the mesh cut once more
  std::vector<double> ownError;   // to the contestant's own functions
  double errorAtPartings = 0.0;   // of points with functions that part, to the thesis' truth
  double errorElsewhere = 0.0;
};

struct FlowComparison
{
  double points = 0.0;
  double partingPoints = 0.0; // share of all
  /// RMS at the end, from the truth of hat functions: of its steps before they are extrapolated,
  /// and of the truths of the other functions.
  double beforeExtrapolation = 0.0;
  double finerTruth = 0.0;
  double plainTruth = 0.0;
  double awareTruth = 0.0;
  std::vector<BudgetedFlow> flows;
};

/// Needs MessagePassing. Empty where the mesh is not there.
FlowComparison CompareFlows(const FlowComparisonOptions& options);

/// Table and RATIO lines.
void PrintComparison(const FlowComparisonOptions& options, const FlowComparison& comparison);

/// Figure 6.9.
Figure FigureOf(const FlowComparison& comparison);

} // namespace gridfem::benchmarks

#endif
