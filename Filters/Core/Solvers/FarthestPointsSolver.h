// Spreads points evenly over a surface: each is the farthest from the points before it.
#ifndef GridFEM_FarthestPointsSolver_h
#define GridFEM_FarthestPointsSolver_h

#include "Distance/GeodesicDistance.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

namespace gridfem
{

/// Samples the farthest points by geodesic distance. [Moenning and Dodgson 2003]
/// With exact distances, the largest remaining distance is at most twice the largest distance of
/// the best choice of equally many points. [Gonzalez 1985] Each point takes one solution. More
/// points continue from the existing ones. One process has to hold the surface.
class FarthestPointsSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByTolerance(1e-4); // of each distance
    int numberOfPoints = 10;
    int firstPointId = -1; // -1: the first point of the first triangle

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("NumberOfPoints", self.numberOfPoints, Within(1, 100000));
      visit("FirstPointId", self.firstPointId, Within(-1, std::numeric_limits<int>::max()));
    }
  };

  struct Result
  {
    std::vector<Id> points;  // in the order in which they were found
    MultiVector atPoints;    // distance from the nearest of them, world units; NaN: there is none
    std::vector<Id> nearest; // nearest found point, per mesh point; -1: none is reachable
    double radius = 0.0;     // the largest distance
    SolveReport report;      // of the worst distance
    std::vector<std::string> warnings;
  };

  static SurfaceOptions SurfaceDefaults();

  /// Finds the points that are missing. Throws InvalidInput if no triangle uses the first point.
  /// Throws Aborted, and keeps the points found so far.
  const Result& Update(Surface& surface, const Options& options, const Job& job = {});

  /// The result of the last update.
  const Result& GetResult() const { return result_; }

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Options& options,
    const SurfaceOptions& surfaceOptions = SurfaceDefaults(), const Job& job = {});

private:
  void Restart(const Surface& surface, const Options& options);
  void AddPoint(const Surface& surface, const SolveOptions& solve, const Progress& progress);
  void FindNext(double side);
  void AddPoints(const Surface& surface, const Options& options, const Progress& progress);
  void Finish();

  std::unique_ptr<DistanceMethod> method_;
  Id next_ = -1; // the point to add; -1: there is no other
  int restarts_ = 0;
  MultiVector distance_; // infinite where no found point is reachable, NaN where no function is
  std::vector<std::string> solveWarnings_;
  Result result_;
};

} // namespace gridfem

#endif
