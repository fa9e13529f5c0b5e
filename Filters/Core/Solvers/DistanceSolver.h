// The distance along a surface from points, or from curves that divide it.
#ifndef GridFEM_DistanceSolver_h
#define GridFEM_DistanceSolver_h

#include "Distance/GeodesicDistance.h"
#include "Solvers/GivenField.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

namespace gridfem
{

/// Computes distances. Its stages are the stages of Surface, CurveStage and NearestStage.
class DistanceSolver
{
public:
  static constexpr const char* CurveStage = "Curve";
  static constexpr const char* NearestStage = "NearestSource";

  struct Options
  {
    EquationOptions equation = EndedByTolerance(1e-4); // of the distance from its gradient
    double smoothing = DistanceOptions().smoothing;
    bool nearestSource = false;
    bool isSigned = false; // from curves, negative inside
    int insideLabel = 1;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      constexpr double Largest = std::numeric_limits<int>::max();
      visit(self.equation);
      visit("Smoothing", self.smoothing, Within(DistanceOptions::LeastSmoothing, 1000.0));
      visit("NearestSource", self.nearestSource, AnyValue());
      visit("Signed", self.isSigned, AnyValue());
      visit("InsideLabel", self.insideLabel, Within(-Largest, Largest));
    }
  };

  /// Points of this process, to be found on the mesh.
  struct FoundPoints
  {
    std::string property; // for messages: "the Selection"
    std::string none;     // for messages: "The Selection takes no point of a polygon"
    std::function<std::vector<Id>()> find; // throws InvalidInput
  };

  struct GivenCurve
  {
    StageKey version;
    std::function<SurfaceCurve()> divide; // may find no segments; throws InvalidInput
  };

  /// All given points together are the sources. Without any, the first point that a triangle uses
  /// is the source.
  struct Input
  {
    std::vector<Id> ids;
    GivenField mask; // sources are where it is not 0
    std::vector<FoundPoints> points;
    GivenField labels; // curves are the border of a label; none: `curve`
    GivenCurve curve;
  };

  struct Result
  {
    MultiVector atPoints;    // world units; NaN where nothing leads to a source
    std::vector<Id> nearest; // the source of each point, or -1; empty unless asked for
    SolveReport report;
    SolutionAccuracy accuracy;
    double heatSweeps = 0.0;
    std::vector<std::string> warnings;
  };

  /// Heat flows on the grid, through points where sheets touch.
  static SurfaceOptions SurfaceDefaults();

  /// Signed distances and nearest sources need a surface that one process holds.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job = {});

  /// The result of the last update.
  const Result& GetResult() const { return result_; }

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void UpdateCurve(const Surface& surface, const Input& input, const Options& options);
  void UpdateDistance(const Surface& surface, const std::vector<Id>& sources,
    const Options& options, const Progress& progress);
  void UpdateNearest(const Surface& surface, const std::vector<Id>& sources, const Options& options,
    const Progress& progress);

  std::unique_ptr<DistanceMethod> method_;
  SurfaceCurve curve_;
  std::vector<std::string> solveWarnings_;
  double shareWithout_ = 0.0; // of the points: those without a distance
  Result result_;
};

} // namespace gridfem

#endif
