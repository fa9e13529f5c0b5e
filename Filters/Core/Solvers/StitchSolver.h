// Makes one coloring of the colors of several scans.
#ifndef GridFEM_StitchSolver_h
#define GridFEM_StitchSolver_h

#include "Shape/Stitching.h"
#include "Solvers/OptionFields.h"
#include "Solvers/SurfaceFields.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// Keeps the gradients of the colors within each scan and removes the jumps between scans
/// (StitchColors). One process holds the surface.
class StitchSolver
{
public:
  static constexpr int WholeSurface = -1;

  struct Options
  {
    EquationOptions equation = EndedByAccuracy();
    int referenceLabel = WholeSurface; // the scan that keeps its mean
    bool keepDetails = true;           // details finer than the functions stay
    double blendWidth = 0.0;           // part of the longest side of the surface

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      constexpr double Largest = std::numeric_limits<int>::max();
      visit(self.equation);
      visit("ReferenceLabel", self.referenceLabel, Within(-Largest, Largest));
      visit("KeepDetails", self.keepDetails, AnyValue());
      visit("BlendWidth", self.blendWidth, Within(0.0, 1.0));
    }
  };

  struct Input
  {
    GivenField colors; // 1 to 4 components
    GivenField labels; // integers: the scan of each point or cell
  };

  struct Result
  {
    MultiVector values;          // rows as the colors: points or triangles
    std::vector<char> isReached; // per point: a function reaches it
    SolveReport report;
    SolutionAccuracy accuracy;
    std::vector<std::string> warnings;
  };

  /// The default options of the surface.
  static SurfaceOptions SurfaceDefaults();

  /// The largest number of functions per point of the grid below hat functions.
  static double FunctionsPerPoint(const Options& options);

  /// Throws InvalidInput and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job);

  /// Runs all steps at once, on a mesh of this process.
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void UpdateCut(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  std::optional<Index> Reference(int label) const;

  std::vector<double> labels_; // distinct ones, ascending. A scan is the place of its label here
  ScanCut cut_;
  std::unique_ptr<FiniteElementSpace> details_;
  Result result_;
};

} // namespace gridfem

#endif
