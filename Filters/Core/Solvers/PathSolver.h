// Shortest paths along a surface between some of its points.
#ifndef GridFEM_PathSolver_h
#define GridFEM_PathSolver_h

#include "Distance/SurfacePath.h"
#include "Distance/WindowSearch.h"
#include "Solvers/DistanceSolver.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

enum class PathType
{
  ToNearestSource, // a path from the nearest source to each target
  InOrder,         // from each point to the next: sources first, then targets
  Closed,          // also from the last point to the first
  AllPairs         // from each point to all that come later in this order
};

/// Computes shortest paths between points of the mesh, exactly on its triangles. PathSearch finds a
/// way, which is pulled tight. WindowSearch then looks for a shorter one everywhere. It needs no
/// functions, only the mesh, which one process has to hold.
class PathSolver
{
public:
  static constexpr const char* GraphStage = "Graph";

  /// Windows (WindowSearch) of one search, 290 MB in all. The longest paths on scans of 100,000
  /// triangles take up to a million.
  static constexpr std::size_t MostWindows = 4000000;

  struct Options
  {
    PathType pathType = PathType::ToNearestSource;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit("PathType", self.pathType, Within(0, static_cast<double>(PathType::AllPairs)));
    }
  };

  /// Points, in the order in which they are given: ids, then a mask, then found points.
  struct GivenPoints
  {
    std::vector<Id> ids;
    GivenField mask; // points are where it is not 0
    std::vector<DistanceSolver::FoundPoints> points;

    bool AreGiven() const { return !ids.empty() || mask || !points.empty(); }
  };

  /// Points that are not given are chosen. Several targets without a source take the first of them
  /// as the source. Without any point, the first point that a triangle uses is the source. A point
  /// that is still missing is the farthest from the others.
  struct Input
  {
    GivenPoints sources;
    GivenPoints targets;
  };

  struct Path
  {
    Id source;
    Id target;
    SurfacePath path; // from the source to the target
    /// No path is shorter. Otherwise the search had too many windows, and no path nearby is
    /// shorter.
    bool isShortest;
  };

  struct Result
  {
    std::vector<Path> paths;
    std::vector<Id> unreached; // targets without a path, ascending
    std::vector<std::string> warnings;
  };

  static SurfaceOptions SurfaceDefaults() { return {}; }

  PathSolver() = default;

  /// @param mostWindows  of one search; a smaller number gives up sooner
  explicit PathSolver(std::size_t mostWindows) : mostWindows_(mostWindows) {}

  /// Throws InvalidInput if a point is not on the surface, and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job = {});

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  struct Ends
  {
    std::vector<Id> sources;
    std::vector<Id> targets;
  };

  std::vector<Index> PlacesOf(const std::vector<Id>& points) const;
  void Choose(Ends& ends, bool isInOrder, const Job& job);
  Id FarthestFrom(const std::vector<Id>& points, const Job& job);
  void FindPaths(const Ends& ends, const Job& job);
  void Connect(const std::vector<Id>& points, PathType type, const Job& job);

  std::size_t mostWindows_ = MostWindows;
  std::unique_ptr<PathGraph> graph_;
  std::unique_ptr<PathSearch> search_;
  std::unique_ptr<WindowSearch> windows_;
  Result result_;
};

} // namespace gridfem

#endif
