// Finds the globally shortest paths along a surface.
#ifndef GridFEM_WindowSearch_h
#define GridFEM_WindowSearch_h

#include "Base/Job.h"
#include "Distance/PathGraph.h"
#include "Distance/TriangleStrip.h"

#include <utility>
#include <vector>

namespace gridfem
{

/// Exact geodesics by windows. [Chen and Han 1990, Xin and Wang 2009] A window is a part of an edge
/// that straight lines from a place reach through unfolded triangles. Windows move from triangle to
/// triangle, the nearest first. A window that meets the corner of a triangle splits, unless another
/// window has reached the corner on a shorter way. Shortest paths bend at the border of the surface
/// and at places with more than the full angle. These places therefore send windows of their own.
class WindowSearch
{
public:
  /// Keeps a reference.
  explicit WindowSearch(const PathGraph& graph);

  /// Searches from the nearest of the sources until no shorter path to any target can be left.
  /// @param bound  the length of a known path to every target. Windows that can only lead to
  ///   longer paths are dropped.
  /// @param most   number of windows at which the search gives up, 72 bytes each
  /// @return whether the search came to its end. Throws Aborted.
  bool From(const std::vector<Index>& sources, const std::vector<Index>& targets, double bound,
    std::size_t most, const Job& job);

  /// The length of the shortest path to a place. Infinite if no window has reached it.
  double LengthTo(Index place) const { return ways_[place].length; }

  /// The strips of the path to a place that was reached, from its source on. The path bends where
  /// a strip ends.
  std::vector<TriangleStrip> StripsTo(Index place) const;

private:
  using Vec2 = Eigen::Vector2d;

  /// The edge lies on the x axis, from its low end at 0. Lines come from below.
  struct Window
  {
    Vec2 source; // unfolded
    double begin;
    double end;
    double before; // length of the path to the source
    Id parent;     // -1: the source is a corner of the triangle before the edge
    Index edge;
    Index triangle; // beyond the edge
    Index root;     // the place of the source
    Index first;    // the triangle at the source
  };

  /// How the search has reached a place.
  struct Way
  {
    double length;
    Id window;      // the last one; -1: along an edge, or the place is a source
    Index previous; // the source of the window, or the other end of the edge; -1: a source
    Index triangle; // that holds the edge
  };

  /// The shortest way to the apex of a triangle through its opposite edge.
  struct Split
  {
    double length;
    double at; // where it crosses the edge
  };

  struct Event
  {
    double key; // least length of a path to a target through it
    Id number;  // of a window, or ~place
    bool operator<(const Event& other) const
    {
      return key != other.key ? key > other.key : number > other.number;
    }
  };

  void FindBendingPlaces();
  void Push(const Event& event);
  void Reach(Index place, const Way& way);
  void SendFrom(Index place);
  bool IsUseless(const Window& window) const;
  void Add(Window window);
  void PassOn(
    Id number, const Window& window, Index near, double begin, double end, const Vec2& apex);
  void Move(Id number);
  double LeastThrough(double length, const Vec3& a, const Vec3& b) const;

  const PathGraph& graph_;
  std::vector<char> bends_; // per place: shortest paths may bend there
  std::vector<Way> ways_;
  std::vector<double> sent_;  // per place: the length with which it has sent windows
  std::vector<Split> splits_; // three per triangle, by the corner before the edge
  std::vector<Window> windows_;
  std::vector<Event> queue_; // a heap
  double bound_ = 0.0;
  const Vec3* goal_ = nullptr; // the only target
};

} // namespace gridfem

#endif
