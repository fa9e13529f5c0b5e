// Finds short ways along a surface, as a first guess of its shortest paths.
#ifndef GridFEM_PathSearch_h
#define GridFEM_PathSearch_h

#include "Base/Job.h"
#include "Distance/PathGraph.h"

#include <utility>
#include <vector>

namespace gridfem
{

/// Searches for the shortest ways through places and midpoints of edges (Dijkstra 1959). Steps lead
/// along edges and straight across triangles. Such a way is some percent longer than the shortest
/// path on the surface.
class PathSearch
{
public:
  /// A place is the node of its own number. The midpoint of an edge is the node of the edge's
  /// number, counted from the number of places on.
  using Node = Id;

  /// Keeps a reference.
  explicit PathSearch(const PathGraph& graph);

  /// Searches from the nearest of the sources until all targets are reached. Without targets, it
  /// covers the whole surface. With one target, it searches only toward the target (A*, Hart,
  /// Nilsson and Raphael 1968). Throws Aborted.
  void From(const std::vector<Index>& sources, const std::vector<Index>& targets, const Job& job);

  /// The length of the way to a place that the last search has reached; otherwise infinite.
  double LengthTo(Index place) const { return length_[place]; }

  /// The nodes of the way to a place, from its source on. Empty if the place was not reached.
  std::vector<Node> WayTo(Index place) const;

  /// The place that the last search found farthest from the sources. Equally far places up to
  /// rounding give the first of them.
  Index Farthest() const;

private:
  Vec3 At(Node node) const;
  void Reach(Node node, Node from, double length);
  void ReachAround(Node node);

  using Waiting = std::pair<double, Node>; // least length of a way through the node

  const PathGraph& graph_;
  std::vector<double> length_;
  std::vector<Node> from_; // -1: a source
  std::vector<char> isDone_;
  std::vector<Waiting> queue_; // a heap
  const Vec3* goal_ = nullptr;
};

} // namespace gridfem

#endif
