#include "Problem.h"

#include "Base/Errors.h"
#include "Problems/GeodesicDistance.h"
#include "Problems/SolveWarnings.h"

#include <algorithm>
#include <limits>

namespace gridfem
{
namespace
{

class DistanceProblem : public Problem
{
public:
  explicit DistanceProblem(Properties& properties)
    : options_(properties, { 1e-4, 200, 0.1 }),
      smoothing_(properties.Number("Smoothing", 1.75, 0.5, 1000.0)),
      isSigned_(properties.Switch("Signed", false)),
      insideLabel_(properties.Integer("InsideLabel", 1, -Largest, Largest))
  {
    options_.functions.joinAtPoints = true;      // paths lead through points where sheets touch
    options_.functionsPerPoint = AsManyAsWanted; // heat flows on the grid
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    const EngineSurface surface(given, options_, progress.Part(0.0, 0.3));
    const GeodesicDistance method(surface.space, surface.mesh,
      DistanceOptions{ smoothing_, options_.multigrid }, surface.MakeJob(progress.Part(0.3, 0.4)));
    const DistanceField field =
      this->Measure(given, method, surface.MakeJob(progress.Part(0.4, 0.98)));
    Results results;
    MultiVector& distance = results.arrays["Distance"];
    distance.resize(static_cast<Id>(field.atPoints.size()), 1);
    std::copy(field.atPoints.begin(), field.atPoints.end(), distance.data());
    results.warnings = WarningsOf(field, options_.solve.tolerance);
    return results;
  }

private:
  static constexpr int Largest = std::numeric_limits<int>::max();

  DistanceField Measure(const Given& given, const GeodesicDistance& method, const Job& job) const
  {
    if (!isSigned_)
    {
      return method.From(SourcesOf(given), options_.solve, job);
    }
    if (!given.sources.empty() || !given.Find("labels"))
    {
      throw InvalidInput("Signed distances are from the border of labels, not from points.");
    }
    if (given.Find("labels")->values.cols() != 1)
    {
      throw InvalidInput("LabelArray 'labels' must have one component.");
    }
    const SurfaceCurve curve = BorderOfLabel(
      *given.mesh, given.FieldOf("labels"), insideLabel_, options_.functions.weldCoincidentPoints);
    return method.FromCurve(curve, options_.solve, job);
  }

  static std::vector<Id> SourcesOf(const Given& given)
  {
    const std::vector<char> used = UsedPoints(*given.mesh);
    std::vector<Id> sources = given.sources;
    for (const Id id : sources)
    {
      if (id < 0 || id >= static_cast<Id>(used.size()) || !used[id])
      {
        throw InvalidInput(
          "SourcePointIds: " + std::to_string(id) + " is not a point of a polygon of the mesh.");
      }
    }
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    return sources;
  }

  EngineOptions options_;
  double smoothing_;
  bool isSigned_;
  int insideLabel_;
};

} // namespace

std::unique_ptr<Problem> MakeDistance(Properties& properties)
{
  return std::make_unique<DistanceProblem>(properties);
}

} // namespace gridfem
